#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/cluster without a cluster: shards are drawn once and appear complete or not at all, failures are counted, and the
merge names what is missing. The programs are small shell scripts."""
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts/cluster"
# Writes which shard it was, and as often as wanted fails instead: FAIL has a file SHARD for each failure that is left.
TOOL = """#!/bin/bash
out=x shard=""
while (($#)); do case $1 in
    --out) out=$2; shift ;; --shard) shard=${2%%/*}; shift ;;
    --merge) shift; merged=(); while [[ $1 != --out ]]; do merged+=("$1"); shift; done; continue ;;
    --note) echo "$2" > '%(work)s/noted'; shift ;;
    --slow) sleep 30 & echo $! > '%(work)s/sleeping'; wait ;;
esac; shift; done
mkdir -p "$out"
if [[ -n $shard ]]; then
    echo "$shard" >> '%(work)s/begun'
    if [[ -f '%(work)s/fail-'$shard ]]; then
        status=$(head -n 1 '%(work)s/fail-'$shard); sed -i 1d '%(work)s/fail-'$shard
        [[ -s '%(work)s/fail-'$shard ]] || rm -f '%(work)s/fail-'$shard
        echo "out of luck" >&2; exit "$status"
    fi
    echo "shard $shard" > "$out/%(file)s"; mkdir "$out/work"; echo cache > "$out/work/cache"
else
    for part in "${merged[@]}"; do cat "$part/%(file)s"; done > "$out/results.json"
fi
exit %(status)s
"""


class Run(unittest.TestCase):
    def setUp(self):
        self.work = pathlib.Path(tempfile.mkdtemp(prefix="cluster-"))
        self.addCleanup(shutil.rmtree, self.work)
        self.out = self.work / "a run"  # with a space
        self.tool("reference", "part.film")

    def tool(self, name, file, status=0):
        program = self.work / "bin" / f"filament-{name}"
        program.parent.mkdir(exist_ok=True)
        program.write_text(TOOL % {"work": self.work, "file": file, "status": status})
        program.chmod(0o755)

    def script(self, name, *words, index=None, **variables):
        environment = {name: value for name, value in os.environ.items() if not name.startswith(("SLURM", "JOB_COMPLETION"))}
        if index is not None:
            words = ("--index", index, *words)
        done = subprocess.run([SCRIPTS / name, "--out", self.out, *map(str, words)], capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, env={**environment, **variables})
        return done.returncode, done.stdout + done.stderr

    def shard(self, index, *words, shards=3, tool="reference", **variables):
        return self.script("shard", "--tool", tool, "--shards", shards, "--bin", self.work / "bin", *words, index=index,
                           **variables)

    def fails(self, shard, *statuses):
        (self.work / f"fail-{shard}").write_text("".join(f"{status}\n" for status in statuses))

    def begun(self):
        path = self.work / "begun"
        return path.read_text().split() if path.exists() else []

    def test_shards_merge_in_order(self):
        for index in (2, 0, 1):
            self.assertEqual(self.shard(index), (0, ""))
        self.assertEqual(sorted(path.name for path in (self.out / "shards").iterdir()), ["0", "1", "2"])
        self.assertFalse((self.out / "shards/0/work").exists(), "caches are not kept")
        status, text = self.script("merge")
        self.assertEqual((status, text), (0, "3 of 3 shards of filament-reference are complete\n"))
        self.assertEqual((self.out / "report/results.json").read_text(), "shard 0\nshard 1\nshard 2\n")
        self.assertEqual(self.script("merge")[0], 0, "again")

    def test_a_complete_shard_is_not_drawn_again(self):
        self.shard(1)
        self.assertEqual(self.shard(1), (0, ""))
        self.assertEqual(self.begun(), ["1"])

    def test_the_index_comes_from_the_scheduler(self):
        self.assertEqual(self.shard(None, SLURM_ARRAY_TASK_ID="2")[0], 0)
        self.assertEqual(self.shard(None, JOB_COMPLETION_INDEX="1")[0], 0)
        self.assertEqual(self.begun(), ["2", "1"])
        self.assertIn("no Slurm array", self.shard(None)[1])

    def test_a_failure_may_be_tried_again_until_no_attempt_is_left(self):
        self.fails(1, 7, 8, 9)
        status, text = self.shard(1)
        self.assertEqual(status, 1)
        self.assertIn("shard 1/3: attempt 1 of 3 ended with status 7: out of luck", text)
        self.assertEqual(self.shard(1)[0], 1)
        self.assertEqual(self.shard(1)[0], 2, "for good")
        self.assertEqual(list((self.out / "shards").iterdir()), [], "nothing that looks complete")
        self.shard(0)
        status, text = self.script("merge")
        self.assertEqual(status, 1)
        self.assertIn("1 of 3 shards of filament-reference are complete", text)
        self.assertIn("shard 1/3 failed: attempt 3 of 3 ended with status 9: out of luck", text)
        self.assertIn("shard 2/3 is not complete: it was begun 0 times", text)
        self.assertIn("2 of 3 shards are missing", text)
        self.assertFalse((self.out / "report").exists())
        self.assertEqual((self.out / "summary.txt").read_text().count("\n"), 4)

    def test_machines_that_die_use_attempts_up(self):
        attempts = self.out / "attempts"
        attempts.mkdir(parents=True)
        (attempts / "0").write_text("1 a\n2 b\n3 c\n")
        status, text = self.shard(0)
        self.assertEqual(status, 2)
        self.assertIn("3 attempts were begun and none ended; did its machines die?", text)
        self.assertIn("begun 3 times, on a b c", self.script("merge")[1])

    def test_a_killed_shard_leaves_nothing_that_looks_complete(self):
        child = subprocess.Popen([SCRIPTS / "shard", "--out", self.out, "--tool", "reference", "--shards", "3", "--bin",
                                  self.work / "bin", "--index", "0", "--", "--slow"], start_new_session=True)
        end = time.monotonic() + 60
        while not (self.work / "sleeping").exists() and time.monotonic() < end:
            time.sleep(0.02)
        os.killpg(child.pid, signal.SIGKILL)
        child.wait()
        self.assertFalse((self.out / "shards/0").exists())

    def test_cases_that_fail_are_a_result_but_a_crash_is_none(self):
        self.tool("conformance", "results.json", status=1)
        self.assertEqual(self.shard(0, tool="conformance", shards=1), (0, ""))
        status, text = self.script("merge")
        self.assertEqual(status, 1, "as one run would end")
        self.assertTrue((self.out / "report/results.json").exists(), text)
        self.out = self.work / "interrupted"
        self.tool("conformance", "results.json", status=130)
        self.assertEqual(self.shard(0, tool="conformance", shards=1)[0], 1)

    def test_a_bake_merges_with_the_options_of_its_shards(self):
        self.tool("bake", "bake.part")
        for index in range(3):
            self.assertEqual(self.shard(index, "--", "--note", "a model", tool="bake"), (0, ""))
        (self.work / "noted").unlink()
        self.assertEqual(self.script("merge")[0], 0)
        self.assertEqual((self.work / "noted").read_text(), "a model\n")

    def test_a_folder_has_one_run(self):
        self.shard(0, "--", "--spp", "4 or 5")
        status, text = self.shard(1, "--", "--spp", "4")
        self.assertEqual(status, 1)
        self.assertIn("has the shards of another run", text)
        self.assertEqual(self.shard(1, "--", "--spp", "4 or 5")[0], 0)
        self.assertEqual(self.script("shard", index=2)[0], 0, "the plan is known")

    def test_waiting_ends_when_nothing_is_left_to_wait_for(self):
        self.fails(0, 1)
        self.assertEqual(self.shard(0, "--attempts", "1", shards=1)[0], 2)
        begin = time.monotonic()
        self.assertEqual(self.script("merge", "--wait", "500")[0], 1)
        self.assertLess(time.monotonic() - begin, 400)

    def test_what_is_wrong_is_said_in_one_line(self):
        for words, said in ((("--index", "3"), "from 0 to 2"), (("--index", "x"), "--index"), (("--nonsense", "1"), "--help"),
                            (("--attempts", "0"), "--attempts"), (("--shards", "0"), "--shards"), (("--tool", "x"), "--tool"),
                            (("--bin", "/nowhere"), "/nowhere/filament-reference"), (("--index",), "needs a value")):
            status, text = self.shard(None, *words)
            self.assertEqual((status, text.count("\n")), (1, 1), text)
            self.assertIn(said, text)
            self.assertTrue(text.startswith("shard: error: "), text)
        self.assertIn("has no plan", self.script("merge")[1])

    def test_help_is_the_comment_of_each_script(self):
        for name in ("shard", "merge", "submit"):
            done = subprocess.run([SCRIPTS / name, "--help"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0)
            self.assertTrue(done.stdout.startswith(f"{name} --"), done.stdout)
            self.assertNotIn("set -euo", done.stdout)

    def test_shellcheck_is_content(self):
        if not shutil.which("shellcheck"):
            self.skipTest("shellcheck is not installed")
        done = subprocess.run(["shellcheck", "-x", *sorted(path for path in SCRIPTS.iterdir() if path.is_file() and
                                                           path.suffix in ("", ".sh"))],
                              capture_output=True, text=True, cwd=ROOT)
        self.assertEqual(done.stdout, "")


if __name__ == "__main__":
    unittest.main()
