# SPDX-License-Identifier: Apache-2.0
"""scripts/check_drivers counts what a release draws otherwise, and notes it in the document and in the stored images."""
import importlib.machinery
import importlib.util
import json
import pathlib
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_drivers"


def load():
    loader = importlib.machinery.SourceFileLoader("check_drivers", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    sys.modules[loader.name] = module  # dataclasses look there
    sys.dont_write_bytecode = True
    loader.exec_module(module)
    return module


check_drivers = load()
STORED = {"machine": {"device": "d", "driver": "Mesa 22.3.6", "cpuFeatures": "avx fma"},
          "cases": {"a": {"hash": "1", "thumbnail": ""}, "b": {"hash": "2", "thumbnail": ""}}}
DOCUMENT = f"before\n{check_drivers.BEGIN}{check_drivers.HEAD}{check_drivers.END}after\n"


def case(name, hash, passed=True, status="passed"):
    return {"name": name, "hash": hash, "status": status, "comparisons": [{"configuration": "gles", "passed": passed}]}


def drawn(*cases, mesa="25.0.7"):
    return {"devices": {"vulkan": f"llvmpipe (LLVM 19.1.7, 256 bits), Mesa {mesa}-2 (LLVM 19.1.7), Vulkan 1.4"}, "cases": list(cases)}


class Tables(unittest.TestCase):
    def setUp(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        check_drivers.DOCUMENT, check_drivers.BASELINES = folder / "drivers.md", folder / "baselines.json"
        check_drivers.DOCUMENT.write_text(DOCUMENT)
        check_drivers.BASELINES.write_text(json.dumps(STORED))

    def write(self, **results):
        """Writes the rows of these releases; an underscore stands for a hyphen."""
        rows = {}
        for name, result in results.items():
            name = name.replace("_", "-")
            rows[name] = check_drivers.row_of(name, result, "2.41")
        check_drivers.write(rows)
        return rows

    def versions(self):
        return json.loads(check_drivers.BASELINES.read_text())["versions"]

    def lines(self):
        return [line for line in check_drivers.DOCUMENT.read_text().splitlines() if line.startswith("| ") and "Mesa" not in line]

    def test_counts_what_the_apis_draw_otherwise_and_what_is_not_stored(self):
        rows = self.write(debian_13=drawn(case("a", "1", passed=False), case("b", "9"), case("c", "", status="skipped")))
        self.assertEqual(rows["debian-13"].apart, ["a"])
        self.assertEqual(rows["debian-13"].other, {"b": "9"})
        self.assertEqual(self.lines(), ["| debian-13 | 25.0.7 | 19.1.7 | 2.41 | 2 | 1 | 1 | `b` |"])
        self.assertEqual(self.versions(), {"25.0.7": {"b": "9"}})

    def test_a_case_without_a_comparison_counts_as_different(self):
        result = drawn(case("a", "1"))
        result["cases"][0]["comparisons"] = []
        self.assertEqual(self.write(debian_13=result)["debian-13"].apart, ["a"])

    def test_a_later_run_replaces_its_rows_and_keeps_the_others(self):
        self.write(debian_13=drawn(case("a", "9")))
        self.write(debian_12=drawn(case("a", "1"), mesa="22.3.6"))
        self.write(debian_13=drawn(case("a", "1")))
        self.assertEqual([line.split(" | ")[0] for line in self.lines()], ["| debian-12", "| debian-13"])
        self.assertEqual(self.versions(), {"22.3.6": {}, "25.0.7": {}})

    def test_two_releases_with_one_version_share_what_differs(self):
        rows = self.write(**{"debian-12-backports": drawn(case("a", "9")), "debian-13": drawn(case("b", "9"))})
        self.assertEqual(len(rows), 2)
        self.assertEqual(self.versions(), {"25.0.7": {"a": "9", "b": "9"}})
        self.write(debian_13=drawn(case("b", "2")))
        self.assertEqual(self.versions(), {"25.0.7": {"a": "9", "b": "9"}}, "the other release was not drawn again")
        self.write(**{"debian-12-backports": drawn(case("a", "1")), "debian-13": drawn(case("b", "2"))})
        self.assertEqual(self.versions(), {"25.0.7": {}})

    def test_the_text_around_the_table_stays(self):
        self.write(debian_13=drawn(case("a", "1")))
        text = check_drivers.DOCUMENT.read_text()
        self.assertTrue(text.startswith("before\n") and text.endswith("after\n"))

    def test_a_document_without_a_place_for_the_table_is_an_error(self):
        check_drivers.DOCUMENT.write_text("nothing")
        with self.assertRaisesRegex(SystemExit, "lacks the lines"):
            self.write(debian_13=drawn(case("a", "1")))


class Arguments(unittest.TestCase):
    def refused(self, *arguments):
        sys.argv = ["check_drivers", *arguments]
        with self.assertRaises(SystemExit) as ended:
            check_drivers.read_arguments()
        return str(ended.exception)

    def test_unknown_drivers_are_named(self):
        self.assertIn("'slackware'", self.refused("slackware"))

    def test_a_table_needs_every_case(self):
        self.assertIn("leave out --cases", self.refused("--write", "--cases", "a"))

    def test_all_releases_are_drawn_unless_some_are_named(self):
        sys.argv = ["check_drivers", "debian-13"]
        self.assertEqual(check_drivers.read_arguments()[1], ["debian-13"])
        sys.argv = ["check_drivers"]
        self.assertEqual(check_drivers.read_arguments()[1], list(check_drivers.RELEASES))


if __name__ == "__main__":
    unittest.main()
