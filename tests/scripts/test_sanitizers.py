# SPDX-License-Identifier: Apache-2.0
"""What ./check --asan, --tsan and --fuzz count and note, and the fuzzer that they run: here one of a few lines of shell."""
import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_sanitizers"
sys.dont_write_bytecode = True  # the script has no .py, and Python would put its file beside it
LOADER = importlib.machinery.SourceFileLoader("check_sanitizers", str(SCRIPT))
check_sanitizers = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_sanitizers", LOADER))
LOADER.exec_module(check_sanitizers)


class Runs(unittest.TestCase):
    def test_a_run_replaces_the_last_one_of_its_name(self):
        text = f"a\n{check_sanitizers.BEGIN}{check_sanitizers.END}b\n"
        text = check_sanitizers.noted(text, "tsan", ["1", "d", "2", "c", "none"])
        text = check_sanitizers.noted(text, "asan", ["1", "d", "2", "c", "none"])
        text = check_sanitizers.noted(text, "tsan", ["2", "d", "2", "c", "none"])
        self.assertEqual(text, f"a\n{check_sanitizers.BEGIN}{check_sanitizers.HEAD}| asan | 1 | d | 2 | c | none |\n"
                               f"| tsan | 2 | d | 2 | c | none |\n{check_sanitizers.END}b\n")

    def test_tests_cases_and_reports_are_counted(self):
        log = ("1/3 Test #1: base .....   Passed    0.12 sec\n 2/3 Test #24: engine .....***Failed  338.24 sec\n"
               " 3/3 Test  #3: site .....***Skipped   0.10 sec\n")
        outputs = ("[  PASSED  ] 12 tests.\n[  PASSED  ] 1 test.\n==7==ERROR: AddressSanitizer: heap-use-after-free\n"
                   "A.cpp:3:4: runtime error: signed integer overflow\nWARNING: ThreadSanitizer: data race (pid=1)\n")
        self.assertEqual(check_sanitizers.counts_of(log, outputs), (3, 1, 13, 3))


FUZZER = """#!/bin/sh
echo 'stat::number_of_executed_units: 1234' >&2
for argument; do case $argument in -artifact_prefix=*) prefix=${argument#*=} ;; esac; done
if [ "$FAILS" ]; then echo bad > "${prefix}crash-1"; exit 77; fi
"""
# Writes two units that were slow; "slow-unit-bad" still fails when it is run again. Another fuzzer found something meanwhile.
SLOW_FUZZER = """#!/bin/sh
case $1 in *slow-unit-bad) exit 1 ;; *slow-unit-good) exit 0 ;; esac
for argument; do case $argument in -artifact_prefix=*) prefix=${argument#*=} ;; esac; done
echo bad > "${prefix}slow-unit-bad"; echo good > "${prefix}slow-unit-good"; echo > "${prefix%PackageFuzz-}OtherFuzz-crash-1"
echo 'stat::number_of_executed_units: 5' >&2
"""


class Fuzzers(unittest.TestCase):
    def run_one(self, text):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "bin", "PackageFuzz")
            program.parent.mkdir()
            program.write_text(text, encoding="utf-8")
            program.chmod(0o755)
            return check_sanitizers.run_fuzzer(program, 1)

    def test_runs_are_counted(self):
        self.assertEqual(self.run_one(FUZZER), (1234, []))

    def test_what_is_found_is_named(self):
        self.assertEqual(self.run_one(FUZZER.replace('"$FAILS"', "1")), (1234, ["PackageFuzz-crash-1"]))

    def test_units_are_no_findings_if_only_the_machine_was_slow_nor_are_those_of_others(self):
        self.assertEqual(self.run_one(SLOW_FUZZER), (5, ["PackageFuzz-slow-unit-bad"]))

    def test_a_fuzzer_that_ends_badly_without_an_input_is_a_finding(self):
        self.assertEqual(self.run_one("#!/bin/sh\nexit 3\n"), (0, ["PackageFuzz ended with 3"]))

    def test_seeds_have_the_name_of_the_fuzzer_in_small_letters(self):
        self.assertEqual([path.name for path in check_sanitizers.seeds_of("MaterialTextFuzz")], ["material_text"])
        self.assertEqual(check_sanitizers.seeds_of("NoSuchFuzz"), [])

    def test_the_note_sums_the_last_run_of_each(self):
        with tempfile.TemporaryDirectory() as folder:
            def keep(name, time, commit, seconds, runs, findings):
                return check_sanitizers.keep_run(pathlib.Path(folder), name, {"commit": commit, "time": time, "seconds": seconds,
                                                                              "runs": runs, "findings": findings})
            keep("AFuzz", "2026-01-02T10:00:00", "1", 600, 50, 3)
            runs = keep("GoneFuzz", "2026-01-02T10:00:00", "0", 600, 50, 3)
            self.assertIsNone(check_sanitizers.sum_of(runs, {"AFuzz", "BFuzz"}))
            keep("BFuzz", "2026-01-03T10:00:00", "1", 600, 7, 0)
            runs = keep("CFuzz", "2026-01-03T09:00:00", "1", 600, 100, 0)
            self.assertEqual(check_sanitizers.sum_of(runs, {"AFuzz", "BFuzz", "CFuzz"}),
                             ["1", "2026-01-03", 30, "3 fuzzers, 600 s each, 157 runs", "3 inputs"])
            runs = keep("AFuzz", "2026-01-04T10:00:00", "2", 1200, 60, 0)
            self.assertEqual(check_sanitizers.sum_of(runs, {"AFuzz", "BFuzz", "CFuzz"}),
                             ["1, 2", "2026-01-04", 40, "3 fuzzers, 600 to 1200 s each, 167 runs", "none"])


class Arguments(unittest.TestCase):
    def test_what_is_not_valid_is_an_error(self):
        for arguments in ([], ["--msan"], ["--fuzz"], ["--fuzz", "0"], ["--fuzz", "long"], ["--fuzz", "1", "NoSuchFuzz"]):
            done = subprocess.run([sys.executable, SCRIPT, *arguments], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn("check_sanitizers: error: ", done.stderr)


if __name__ == "__main__":
    unittest.main()
