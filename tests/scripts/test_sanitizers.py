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

    def test_the_tests_of_a_run_are_told_apart(self):
        runs = check_sanitizers.tests_of(LAST_TEST)
        self.assertEqual(runs, {"base": {"seconds": 3.54, "runs": 13, "failed": 0, "findings": 0},
                                "engine": {"seconds": 60, "runs": 0, "failed": 1, "findings": 3},
                                "site": {"seconds": 0.1, "runs": 0, "failed": 0, "findings": 0}})
        self.assertEqual(check_sanitizers.sum_of_tests(runs, list(runs)), ("3 tests, 13 cases passed", "3 reports, 1 tests failed"))
        self.assertEqual(check_sanitizers.sum_of_tests(runs, ["base"]), ("1 tests, 13 cases passed", "none"))

    def test_the_last_run_of_each_counts(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            check_sanitizers.keep_runs(folder, "1", {"a": {"seconds": 60, "runs": 5, "failed": 1, "findings": 3}})
            check_sanitizers.keep_runs(folder, "1", {"b": {"seconds": 600, "runs": 7, "failed": 0, "findings": 0}})
            runs = check_sanitizers.keep_runs(folder, "2", {"a": {"seconds": 120, "runs": 6, "failed": 0, "findings": 0}})
            self.assertEqual(check_sanitizers.sum_of_tests(runs, ["a", "b"]), ("2 tests, 13 cases passed", "none"))
            commits, date, minutes = check_sanitizers.origin_of(runs, ["a", "b"])
            self.assertEqual((commits, minutes), ("1, 2", "12"))
            self.assertRegex(date, r"^\d{4}-\d\d-\d\d$")
            self.assertEqual(check_sanitizers.sum_of_fuzzers(runs, ["a", "b"]), ("2 fuzzers, 120 to 600 s each, 13 runs", "none"))
            self.assertEqual(check_sanitizers.sum_of_fuzzers(runs, ["b"]), ("1 fuzzers, 600 s each, 7 runs", "none"))


LAST_TEST = """Start testing: Nov 28 09:35 UTC
1/120 Testing: base
[  PASSED  ] 12 tests.
[  PASSED  ] 1 test.
Test time =   3.54 sec
Test Passed.
24/120 Testing: engine
==7==ERROR: AddressSanitizer: heap-use-after-free
A.cpp:3:4: runtime error: signed integer overflow
WARNING: ThreadSanitizer: data race (pid=1)
Test time =  60.00 sec
Test Failed.
3/120 Testing: site
Test time =   0.10 sec
Test Skipped.
"""

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


class Arguments(unittest.TestCase):
    def test_what_is_not_valid_is_an_error(self):
        for arguments in ([], ["--msan"], ["--fuzz"], ["--fuzz", "0"], ["--fuzz", "long"], ["--fuzz", "1", "NoSuchFuzz"]):
            done = subprocess.run([sys.executable, SCRIPT, *arguments], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn("check_sanitizers: error: ", done.stderr)


if __name__ == "__main__":
    unittest.main()
