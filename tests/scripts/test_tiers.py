# SPDX-License-Identifier: Apache-2.0
"""The scripts of the two tiers: what notices a mutant is found, the choice covers it, the table tells what is out of date."""
import importlib.machinery
import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"


def load(name):
    loader = importlib.machinery.SourceFileLoader(name, str(SCRIPTS / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


sys.dont_write_bytecode = True  # the scripts have no .py, and Python would put its files beside them
choose_tiers, test_table = load("choose_tiers"), load("test_table")

# Behaves like a program of googletest with cases that notice the mutants of their names.
FAKE = """#!{python}
import os, pathlib, signal, sys
CASES = {cases}  # case -> (milliseconds, reached, noticed)
wanted = None
for argument in sys.argv[1:]:
    if argument.startswith("--gtest_flagfile="):
        argument = pathlib.Path(argument.split("=", 1)[1]).read_text().splitlines()[0]
    if argument.startswith("--gtest_filter="):
        wanted = argument.split("=", 1)[1].split(":")
mutant = int(os.environ.get("FILAMENT_MUTANT", 0))
with open(pathlib.Path(__file__).with_name("asked"), "a") as asked:
    asked.write(f"{{pathlib.Path(__file__).stem}} {{mutant}} {{wanted}}\\n")
for case, (milliseconds, reached, noticed) in CASES.items():
    if wanted is not None and case not in wanted:
        continue
    print(f"[ RUN      ] {{case}}", flush=True)
    if "FILAMENT_MUTANTS_CASES" in os.environ:
        with open(os.environ["FILAMENT_MUTANTS_CASES"], "a") as file:
            file.write(f"{{case}}\\t{{milliseconds}}\\tpassed\\t{{''.join(f'{{number}},' for number in reached)}}\\n")
    if mutant and -mutant in noticed:
        os.kill(os.getpid(), signal.SIGKILL)
    if mutant in noticed or mutant and "unsteady" in noticed or "unsteady" in noticed and wanted == [case]:
        print(f"[  FAILED  ] {{case}} (1 ms)", flush=True)
        sys.exit(1)
    print(f"[       OK ] {{case}} (1 ms)", flush=True)
"""


class Measured(unittest.TestCase):
    """A tree with two programs of unit tests and one of device tests."""

    def setUp(self):
        self.work = tempfile.TemporaryDirectory()
        self.addCleanup(self.work.cleanup)
        self.folder = pathlib.Path(self.work.name)
        self.build = self.folder / "build" / "release"
        self.build.mkdir(parents=True)
        self.tests = []
        mutants = [{"number": number, "key": str(number), "file": "base/A.cpp", "line": number, "operator": "operator", "was": "<",
                    "now": "<="} for number in range(1, 6)]
        (self.folder / "mutants.json").write_text(json.dumps({"seed": "1", "mutants": mutants}), encoding="utf-8")

    def add(self, name, label, **cases):
        program = self.build / f"{name}_tests"
        program.write_text(FAKE.format(python=sys.executable, cases={f"A.{case}": of for case, of in cases.items()}), encoding="utf-8")
        program.chmod(0o755)
        self.tests.append(f'add_test({name} "{program}")\nset_tests_properties({name} PROPERTIES LABELS {label})\n')
        (self.build / "CTestTestfile.cmake").write_text("".join(self.tests), encoding="utf-8")

    def measure(self, *arguments):
        done = subprocess.run([sys.executable, SCRIPTS / "measure_tiers", self.folder, *arguments], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.folder / "notices.json").read_text(encoding="utf-8"))

    def asked(self):
        return (self.build / "asked").read_text(encoding="utf-8")

    def test_unit_tests_are_asked_before_device_tests(self):
        self.add("unit", "unit", Sees=(5, [1], [1]))
        self.add("device", "gpu", SeesToo=(1, [1, 2], [1, 2]))
        self.measure("reach")
        notices = self.measure("notice")["notices"]
        self.assertEqual(notices["1"]["by"], ["unit", "A.Sees"])
        self.assertEqual(notices["2"]["by"], ["device", "A.SeesToo"])
        self.assertNotIn("device_tests 1 ", self.asked())

    def test_only_cases_that_reach_a_mutant_are_asked(self):
        self.add("unit", "unit", Reaches=(1, [1], [1]), Other=(1, [2], [1, 2]))
        self.measure("reach")
        self.measure("notice")
        self.assertIn("unit_tests 1 ['A.Reaches']", self.asked())
        self.assertNotIn("unit_tests 3", self.asked())

    def test_a_case_that_noticed_another_mutant_is_asked_first(self):
        self.add("device", "gpu", Cheap=(1, [2], []), Killer=(5000, [1, 2], [1, 2]))
        self.measure("reach")
        notices = self.measure("notice", "--budget", "5")["notices"]
        self.assertEqual([notices[number]["by"] for number in "12"], [["device", "A.Killer"]] * 2)

    def test_a_crash_notices_and_an_unsteady_case_does_not(self):
        self.add("unit", "unit", Crashes=(1, [1], [-1]))
        self.add("shaky", "unit", Shakes=(1, [2], ["unsteady"]))
        self.measure("reach")
        data = self.measure("notice")
        self.assertEqual(data["notices"]["1"]["by"], ["unit", "A.Crashes"])
        self.assertIsNone(data["notices"]["2"]["by"])
        self.assertEqual(data["unsteady"], [["shaky", "A.Shakes"]])

    def test_the_budget_leaves_out_and_a_larger_one_goes_on(self):
        self.add("device", "gpu", Dear=(9000, [1], [1]))
        self.measure("reach")
        notice = self.measure("notice", "--budget", "5")["notices"]["1"]
        self.assertEqual((notice["by"], notice["untried"]), (None, 1))
        self.assertEqual(self.measure("notice", "--budget", "10")["notices"]["1"]["by"], ["device", "A.Dear"])

    def test_what_is_known_is_not_asked_again(self):
        self.add("unit", "unit", Sees=(1, [1], [1]))
        self.measure("reach")
        self.measure("notice")
        asked = self.asked()
        self.measure("reach")
        self.measure("notice")
        self.assertEqual(self.asked(), asked)

    def test_the_report_has_what_the_choice_needs(self):
        self.add("device", "gpu", Sees=(1500, [1], [1]))
        self.measure("reach")
        self.measure("notice")
        file = self.folder / "measured.json"
        self.measure("report", str(file), "--commit", "c0ffee")
        data = json.loads(file.read_text(encoding="utf-8"))
        self.assertEqual(data["commit"], "c0ffee")
        self.assertEqual(data["notices"][0], {"mutant": "base/A.cpp:1", "operator": "operator", "was": "<", "now": "<=", "cases": 1,
                                              "suite": "device", "case": "A.Sees", "seconds": 1.5})

    def test_what_another_tree_gave_is_not_asked_again_and_stays_in_the_report(self):
        row = {"mutant": "base/A.cpp:1", "operator": "operator", "was": "<", "now": "<=", "cases": 3}
        counts = {"seconds": 2, "cases": 3, "skipped": 0, "reached": 5}
        before = {"commit": "c0ffee",
                  "suites": {"device": {"label": "gpu", "part": 0.25} | counts, "unit": {"label": "unit", "part": 1} | counts},
                  "notices": [row | {"suite": "device", "case": "A.Saw", "seconds": 0.5}, row | {"mutant": "base/A.cpp:2", "untried": 1},
                              row | {"mutant": "base/A.cpp:4"}, row | {"mutant": "base/B.cpp:1"}]}
        known = self.folder / "known.json"
        known.write_text(json.dumps(before), encoding="utf-8")
        self.add("device", "gpu", Sees=(1500, [1, 2, 3], [1, 3]))
        self.measure("reach", "--shard", "0/4")
        self.measure("notice", "--known", str(known))
        self.assertNotIn("device_tests 1 ", self.asked())
        file = self.folder / "measured.json"
        self.measure("report", str(file), "--known", str(known), "--commit", "c0ffee")
        data = json.loads(file.read_text(encoding="utf-8"))
        rows = {row["mutant"]: row for row in data["notices"]}
        self.assertEqual(rows["base/A.cpp:1"]["case"], "A.Saw")
        self.assertEqual((rows["base/A.cpp:2"]["cases"], rows["base/A.cpp:2"]["untried"]), (4, 1))
        self.assertEqual(rows["base/A.cpp:3"]["case"], "A.Sees")
        self.assertNotIn("base/B.cpp:1", rows)
        self.assertEqual(data["suites"]["unit"]["cases"], 3)
        self.assertEqual((data["suites"]["device"]["cases"], data["suites"]["device"]["part"]), (4, 0.5))


RULES = {"rooms": ["room"], "cheapSeconds": 1, "longestSeconds": 10, "divided": {"large": "takes long"},
         "wholeSeconds": 20, "missed": {}, "always": {"format": ""}}


def notice(mutant, suite, case, seconds):
    return {"mutant": mutant, "operator": "operator", "was": "<", "now": "<=", "cases": 1, "suite": suite, "case": case, "seconds": seconds}


class Choice(unittest.TestCase):
    def test_the_cover_takes_what_notices_most_per_second(self):
        notices = {1: ["dear", "cheap"], 2: ["dear", "other"], 3: ["dear"]}
        self.assertEqual(choose_tiers.cover({"dear": 3, "cheap": 3, "other": 3}, notices), ["dear"])
        self.assertEqual(choose_tiers.cover({"cheap": 1, "dear": 9, "other": 1}, {1: ["cheap", "dear"], 2: ["other", "dear"]}),
                         ["cheap", "other"])

    def test_a_program_that_takes_long_to_build_is_taken_last(self):
        once = {"a": ("large", 50), "b": ("small", 1)}.get
        self.assertEqual(choose_tiers.cover({"a": 1, "b": 3}, {1: ["a", "b"]}, once), ["b"])
        self.assertEqual(choose_tiers.cover({"a": 1, "b": 3}, {1: ["a", "b"], 2: ["a"]}, once), ["b", "a"])

    def test_the_log_of_a_build_tells_what_a_program_takes(self):
        with tempfile.TemporaryDirectory() as folder:
            units = ["tests/CMakeFiles/base_tests.dir/Unity/unity_0_cxx.cxx.o", "tests/CMakeFiles/base_tests.dir/Unity/unity_1_cxx.cxx.o",
                     "bin/base_tests", "CMakeFiles/base.dir/Log.cpp.o"]
            lines = [f"{1000 * at}\t{1000 * at + 500}\t0\t{unit}\t{at:x}" for at, unit in enumerate(units)]
            pathlib.Path(folder, ".ninja_log").write_text("# ninja log v5\n" + "\n".join(lines) + "\n", encoding="utf-8")
            self.assertEqual(choose_tiers.read_build(pathlib.Path(folder))["seconds"], {"base": 1.5})

    def test_rooms_run_whole_and_others_if_they_are_cheap(self):
        suites = {name: {"label": label, "seconds": seconds, "part": 1} for name, label, seconds in
                  [("room", "unit", 50), ("tool", "unit", 0.5), ("slow", "unit", 5), ("large", "unit", 0.1), ("device", "gpu", 0.1)]}
        self.assertEqual(choose_tiers.whole_suites({"suites": suites}, RULES), ["format", "room", "tool"])

    def test_a_device_program_runs_whole_if_that_is_cheap(self):
        with tempfile.TemporaryDirectory() as folder:
            suites = {"small": {"label": "gpu", "seconds": 15, "part": 1}, "large": {"label": "gpu", "seconds": 90, "part": 1}}
            notices = [notice("A.cpp:1", "small", "B.One", 2), notice("A.cpp:2", "large", "C.Two", 2)]
            files = {"measured": {"suites": suites, "notices": notices}, "conformance": {"cases": {}}, "build": {"seconds": {}},
                     "rules": RULES}
            for name, data in files.items():
                pathlib.Path(folder, f"{name}.json").write_text(json.dumps(data), encoding="utf-8")
            chosen = choose_tiers.choose(pathlib.Path(folder))
            self.assertEqual((chosen["tests"], chosen["cases"]), (["format", "room", "small"], {"large": ["C.Two"]}))

    def test_a_case_that_takes_too_long_is_listed_with_its_reason(self):
        measured = {"notices": [notice("A.cpp:1", "device", "B.Fast", 2), notice("A.cpp:2", "device", "B.Slow", 20),
                                notice("A.cpp:3", "room", "C.Whole", 1)]}
        cases, missed = choose_tiers.choose_cases(measured, {}, RULES, {"room"}, [])
        self.assertEqual(cases, {"device": ["B.Fast"]})
        self.assertEqual([entry["mutant"] for entry in missed], ["A.cpp:2"])
        self.assertIn("20 s", missed[0]["reason"])

    def test_what_a_chosen_case_of_the_runner_notices_needs_no_other(self):
        measured = {"notices": [notice("A.cpp:1", "conformance", "mask", 2), notice("A.cpp:2", "conformance", "fog", 2)]}
        self.assertEqual(choose_tiers.choose_cases(measured, {}, RULES, set(), ["mask"]), ({"conformance": ["fog"]}, []))

    def test_every_defect_of_the_runner_is_covered_or_listed(self):
        conformance = {"cases": {"a": {"seconds": 1, "kills": ["x"]}, "b": {"seconds": 1.5, "kills": ["x", "y"]},
                                 "c": {"seconds": 30, "kills": ["x", "z"]}}}
        chosen, missed = choose_tiers.choose_conformance(conformance, RULES)
        self.assertEqual(chosen, ["b"])
        self.assertEqual([entry["defect"] for entry in missed], ["z"])

    def test_every_defect_that_a_scene_lists_is_covered_or_missed_with_a_reason(self):
        claimed = set()
        for file in (SCRIPTS.parent / "tests/conformance/scenes").glob("*.json"):
            scene = json.loads(file.read_text(encoding="utf-8"))
            for case in (scene, *scene.get("features", {}).values()):
                claimed |= set(case.get("kills", []))
        tiers = SCRIPTS.parent / "tests/tiers"
        fast, noticed = (json.loads((tiers / name).read_text(encoding="utf-8")) for name in ("fast.json", "conformance.json"))
        covered = {defect for name in fast["conformance"] for defect in noticed["cases"].get(name, {"kills": []})["kills"]}
        missed = {entry["defect"] for entry in fast["missed"] if "defect" in entry}
        self.assertEqual(claimed - {"none", "oneList"} - covered - missed, set())

    def test_the_stored_choice_is_that_of_the_measurements(self):
        done = subprocess.run([sys.executable, SCRIPTS / "choose_tiers", "--check"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)


SENTENCES = [("base", "files"), ("engine", "pictures"), ("sample_*", "a sample")]


class Table(unittest.TestCase):
    def test_what_does_not_fit_is_named(self):
        tests = {"base": True, "engine": False, "engine_fast": True, "sample_a": False, "new": False}
        fast = {"tests": ["base", "gone"], "cases": {"engine": ["A.B"]}}
        self.assertEqual(list(test_table.wrong_with(tests, SENTENCES, fast)),
                         ["tests/tiers/suites.txt has no line for the test 'new'", "tests/tiers/fast.json: there is no test 'gone'"])
        del tests["sample_a"]
        self.assertIn("tests/tiers/suites.txt: there is no test 'sample_*'", list(test_table.wrong_with(tests, SENTENCES, fast)))

    def test_seconds_of_shards_and_of_a_pattern_are_added(self):
        seconds = {"engine_0": 2, "engine_1": 3.5, "sample_a": 1, "sample_b": 2}
        self.assertEqual([test_table.seconds_of(name, seconds, SENTENCES) for name, _ in SENTENCES], ["-", "5.5", "3.0"])

    def test_the_fate_of_each_mutant_is_counted_once(self):
        suites = {"room": {"label": "unit", "cases": 5, "part": 1}, "device": {"label": "gpu", "cases": 7, "part": 0.25}}
        notices = [notice("A:1", "room", "B.One", 1), notice("A:2", "device", "C.Two", 1), notice("A:3", "device", "C.Slow", 50),
                   {"mutant": "A:4", "cases": 0}, {"mutant": "A:5", "cases": 3}, {"mutant": "A:6", "cases": 3, "untried": 1}]
        text = test_table.fate_of_mutants({"commit": "c0ffee", "count": 6, "suites": suites, "notices": notices},
                                          {"tests": ["room"], "missed": [{"mutant": "A:3"}]}).replace("\n", " ")
        for part in ("6 mutants of commit c0ffee, asked of 12 cases of 2 suites", "the fast tier notices 2, 1 of them by unit tests",
                     "1 are noticed by `--full` alone", "asked noticed 3: 1 although", "1 of which some cases", "1 that no measured",
                     "`device` (25% of its cases)"):
            self.assertIn(part, text)

    def test_only_the_part_between_the_marks_is_written(self):
        text = f"a\n{test_table.BEGIN}old\n{test_table.END}b\n"
        self.assertEqual(test_table.with_table(text, "new\n"), f"a\n{test_table.BEGIN}new\n{test_table.END}b\n")


if __name__ == "__main__":
    unittest.main()
