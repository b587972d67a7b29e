#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scripts/cluster on a real Slurm, which this test starts for itself (private_slurm.py): four machines, of which one dies
while it draws a shard, and a shard that fails once. The merged reports must have the bytes of one run, those of bakes with 1,
2 and 4 workers too. Also measures an image of the path tracer with as many.

test_slurm.py --bin BIN --out DIR: programs; the folder of report.json. Skipped (77) where Slurm is not installed."""
import argparse
import filecmp
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

import private_slurm

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts/cluster"
CONFORMANCE = ["--only", "lines", "unlit", "mask", "--threads", "off", "--mutations", "off"]
REFERENCE = ["triangle.gltf", "--environment", "none", "--size", "160x90", "--eye", "0", "0", "2", "--sun", "100000", "-1",
             "-1", "-1", "--threads", "1", "--spp"]
BAKE = ["gallery.glb", "--environment", "gallery.hdr", "--samples", "32", "--density", "2", "--threads", "1"]
# One lit triangle, facing +z.
MODEL = """{ "asset": { "version": "2.0" }, "buffers": [ { "byteLength": 36, "uri":
"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA" } ],
"bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
"accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1,-1,0], "max": [1,1,0] } ],
"materials": [ { "pbrMetallicRoughness": { "roughnessFactor": 0.5 } } ],
"meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 }, "material": 0 } ] } ],
"nodes": [ { "mesh": 0 } ], "scenes": [ { "nodes": [ 0 ] } ], "scene": 0 }"""
# Fails when shard 1 is begun for the first time.
FLAKY = """#!/bin/sh
case "$*" in *"--shard 1/4"*) if mkdir '{mark}' 2>/dev/null; then echo 'the disk is full' >&2; exit 7; fi ;; esac
exec '{program}' "$@"
"""


class Test:
    def __init__(self, slurm, binaries, out):
        self.slurm, self.bin, self.out = slurm, binaries, out
        self.work = slurm.folder / "work"
        self.work.mkdir()
        (self.work / "triangle.gltf").write_text(MODEL)
        self.report = {"workers": []}
        self.merges = {}  # the job that merges each run

    def submit(self, name, tool, shards, options, binaries=None, **more):
        words = [SCRIPTS / "submit", "--tool", tool, "--shards", shards, "--out", self.work / name, "--bin",
                 binaries or self.bin]
        for option, value in more.items():
            words += [f"--{option}", value]
        text = self.slurm.run(*(str(word) for word in [*words, "--", *options]), cwd=self.work)
        self.merges[name] = text.split()[-1]

    def wait_for_summary(self, name):
        """The exit of the merge: DIR/report, or a summary that says what is missing."""
        folder = self.work / name
        self.slurm.wait_for(lambda: not self.slurm.run("squeue", "-h", "-j", self.merges[name], check=False), name, 240)
        return (folder / "summary.txt").read_text()

    def draw_whole(self, name, tool, options):
        subprocess.run([self.bin / f"filament-{tool}", *options, "--out", self.work / name], check=True, cwd=self.work,
                       stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL)

    def expect_same(self, name, whole, files):
        merged = self.work / name / "report"
        _, different, unreadable = filecmp.cmpfiles(merged, self.work / whole, files, shallow=False)
        assert not different and not unreadable, f"{name}: {different + unreadable} differ from those of one run"

    def stop_a_running_shard(self, name):
        """Freezes the first process of a tool that draws a shard of a run. Returns its shard and node."""
        found = []

        def look():
            for pid, node in self.slurm.processes():
                words = command_of(pid)
                if node is None or "--shard" not in words or f"{self.work / name}/" not in words[-1]:
                    continue
                if not words[0].endswith("filament-conformance"):
                    continue
                os.kill(pid, signal.SIGSTOP)
                if state_of(pid) == "T":
                    found.append((words[words.index("--shard") + 1].split("/")[0], node))
                    return True
            return False

        self.slurm.wait_for(look, "a running shard")
        return found[0]

    def survives_a_dead_machine(self):
        """Also a shard that fails once, at the same time."""
        self.submit("conformance", "conformance", 6, CONFORMANCE)
        shard, node = self.stop_a_running_shard("conformance")
        self.slurm.kill_node(node)
        assert not (self.work / "conformance/shards" / shard).exists(), "it was not complete"
        flaky = self.work / "flaky"
        flaky.mkdir()
        script = flaky / "filament-reference"
        script.write_text(FLAKY.format(mark=self.work / "failed-once", program=self.bin / "filament-reference"))
        script.chmod(0o755)
        self.submit("flaky-run", "reference", 4, self.model("16"), binaries=flaky)
        self.draw_whole("whole", "conformance", CONFORMANCE)  # meanwhile
        self.draw_whole("whole-reference", "reference", self.model("16"))
        summary = self.wait_for_summary("conformance")
        print(summary)
        assert summary.startswith("6 of 6 shards"), summary
        again = f"shard {shard}/6 was begun 2 times, on {node} "
        assert again in summary and not summary.split(again)[1].startswith(node), "it was drawn again elsewhere"
        images = [f"images/{path.name}" for path in (self.work / "whole/images").iterdir()]
        self.expect_same("conformance", "whole", ["results.json", "report.html", *images])
        assert len(json.loads((self.work / "conformance/report/results.json").read_text())["cases"]) >= 6
        self.report.update(killed=node, shard=int(shard))
        summary = self.wait_for_summary("flaky-run")
        print(summary)
        assert "4 of 4 shards" in summary and "shard 1/4 was begun 2 times" in summary, summary
        self.expect_same("flaky-run", "whole-reference", ["reference.exr", "reference.png", "report.json"])
        self.draws_only_what_is_missing("flaky-run", flaky)

    def draws_only_what_is_missing(self, name, binaries):
        """A run that is submitted again."""
        folder = self.work / name
        shutil.rmtree(folder / "shards/2")
        shutil.rmtree(folder / "report")
        before = (folder / "shards/1/part.film").stat().st_mtime_ns
        self.submit(name, "reference", 4, self.model("16"), binaries=binaries)
        summary = self.wait_for_summary(name)
        assert "4 of 4 shards" in summary, summary
        assert (folder / "shards/1/part.film").stat().st_mtime_ns == before, "a complete shard was drawn again"
        self.expect_same(name, "whole-reference", ["reference.exr", "reference.png", "report.json"])

    @staticmethod
    def model(samples):
        return [*REFERENCE, samples]

    def bakes_with_any_number_of_workers(self):
        subprocess.run([self.bin / "filament-accuracy", "--rooms", self.work], check=True, stdout=subprocess.DEVNULL)
        self.draw_whole("whole-bake", "bake", BAKE)
        for workers in (1, 2, 4):
            name = f"bake-{workers}"
            self.submit(name, "bake", 4, BAKE, workers=workers)
            summary = self.wait_for_summary(name)
            assert "4 of 4 shards" in summary, summary
            self.expect_same(name, "whole-bake", ["baked.glb", "report.json", "report.md", "lightmap.png", "error.png"])

    def measure_workers(self, samples, shards):
        options = self.model(str(samples))
        for workers in (1, 2, 4):
            name = f"workers-{workers}"
            begin = time.monotonic()
            self.submit(name, "reference", shards, options, workers=workers)
            self.wait_for_summary(name)
            seconds = time.monotonic() - begin
            self.report["workers"].append({"workers": workers, "seconds": round(seconds, 2)})
            if workers > 1:
                self.expect_same(name, "workers-1/report", ["reference.exr", "reference.png", "report.json"])
            print(f"{workers} workers: {seconds:.1f} s")
        self.report.update(samples=samples, shards=shards, cores=os.cpu_count())


def command_of(pid):
    try:
        return [word.decode(errors="replace") for word in pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0")[:-1]]
    except OSError:  # it ended
        return []


def state_of(pid):
    """T: stopped. A signal takes effect when the process is scheduled."""
    for _ in range(100):
        try:
            state = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
        except OSError:
            return ""
        if state in "TZX":
            return state
        time.sleep(0.01)
    return ""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--samples", type=int, default=64, help="of the measurement with 1, 2 and 4 workers")
    parser.add_argument("--shards", type=int, default=4)
    arguments = parser.parse_args()
    reason = private_slurm.why_not()
    if reason:
        print(f"skipped: {reason}")
        return 77
    for number in (signal.SIGTERM, signal.SIGHUP):  # ctest's time limit, a closed terminal: end the daemons, too
        signal.signal(number, lambda *_: sys.exit(1))
    begin = time.monotonic()
    with private_slurm.PrivateSlurm(4) as slurm:
        test = Test(slurm, arguments.bin.resolve(), arguments.out)
        try:
            test.measure_workers(arguments.samples, arguments.shards)
            test.bakes_with_any_number_of_workers()
            test.survives_a_dead_machine()
        except BaseException:
            print(slurm.logs())
            shutil.copytree(test.work, arguments.out / "failed", dirs_exist_ok=True)
            raise
    test.report["seconds"] = round(time.monotonic() - begin, 1)
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "report.json").write_text(json.dumps(test.report, indent=2) + "\n")
    print(f"passed in {test.report['seconds']} s; {arguments.out / 'report.json'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
