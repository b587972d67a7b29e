# SPDX-License-Identifier: Apache-2.0
"""Reports of the other programs are read as they are, or refused with the place that is wrong."""
import copy
import json
import os
import pathlib
import subprocess
import tempfile

from support import fc, np, unittest

CONFORMANCE = os.environ.get("FILAMENT_CONFORMANCE", "")

CASES = {
    "build": "Release", "reference": "gles", "devices": {"gles": "llvmpipe"},
    "summary": {"passed": 1, "failed": 1},
    "cases": [
        {"name": "a", "status": "passed", "hash": "12", "baseline": "12", "image": "a.png", "kills": [],
         "comparisons": [{"configuration": "vulkan", "passed": True, "differing": 0, "maxDifference": 0}]},
        {"name": "b", "status": "failed", "reasons": ["12 pixels differ"], "hash": "13",
         "comparisons": [{"configuration": "vulkan", "passed": False, "differing": 12, "maxDifference": 3,
                          "fault": "all black"}]},
        {"name": "c", "status": "skipped", "reasons": ["no such file"]}]}
EFFECTS = {
    "program": "filament-accuracy", "version": 1, "machine": "a box", "commit": "abc", "date": "today", "size": [320, 180],
    "effects": [{"name": "shadows", "title": "Shadows", "standard": "pcf3", "best": "pcss", "values": [
        {"value": "pcf3", "set": ["shadows=pcf3"], "error": 0.1, "ownError": 0.2, "ownFlip": 0.05, "totalError": None,
         "milliseconds": {"gles": 2.5}},
        {"value": "hard", "set": [], "error": 1, "ownError": 0.4, "ownFlip": 0.1, "totalError": 0.5}]}]}


class Reports(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "results.json"

    def write(self, value):
        self.path.write_text(json.dumps(value), encoding="utf-8")
        return self.path

    def test_of_conformance(self):
        report = fc.reports.load_conformance(self.write(CASES).parent)
        self.assertEqual([case.name for case in report.cases], ["a", "b", "c"])
        self.assertEqual([case.name for case in report.failed], ["b"])
        self.assertEqual(report.failed[0].reasons, ("12 pixels differ",))
        self.assertEqual(report.case("b").comparisons[0].fault, "all black")
        self.assertEqual((report.case("a").comparisons[0].differing, report.devices), (0, {"gles": "llvmpipe"}))
        with self.assertRaises(fc.NotFoundError) as caught:
            report.case("d")
        self.assertIn("it has a, b, c", str(caught.exception))

    def test_of_accuracy(self):
        report = fc.reports.load_accuracy(self.write(EFFECTS))
        self.assertEqual((report.size, report.machine), ((320, 180), "a box"))
        value = report.effect("shadows").value("pcf3")
        self.assertEqual((value.own_error, value.milliseconds, value.set), (0.2, {"gles": 2.5}, ("shadows=pcf3",)))
        self.assertTrue(np.isnan(value.total_error))
        self.assertEqual(report.effect("shadows").value("hard").milliseconds, {})
        self.assertRaises(fc.NotFoundError, report.effect, "fog")

    def test_that_are_none_are_refused(self):
        for load in (fc.reports.load_conformance, fc.reports.load_accuracy):
            for text in (b"", b"{", b"[]", b"null", b"\xff\xfe", b"{}", b"[" * 100_000, b'{"program": 1}'):
                self.path.write_bytes(text)
                with self.assertRaises(fc.CorruptError) as caught:
                    load(self.path)
                self.assertIn("results.json", str(caught.exception))
            self.assertRaises(fc.NotFoundError, load, self.path.parent / "other.json")
        self.assertRaises(fc.CorruptError, fc.reports.load_accuracy, self.write(CASES))

    def test_with_anything_missing_or_of_another_type_are_read_or_refused(self):
        def places(node):
            if isinstance(node, (dict, list)):
                for key in list(node) if isinstance(node, dict) else range(len(node)):
                    yield node, key
                    yield from places(node[key])

        for load, original in ((fc.reports.load_conformance, CASES), (fc.reports.load_accuracy, EFFECTS)):
            refused = 0
            for index in range(len(list(places(original)))):
                for value in (None, 1, -1.5, "text", [], [1], {}, {"x": {}}, True, 10 ** 400):
                    changed = copy.deepcopy(original)
                    node, key = list(places(changed))[index]
                    node[key] = value
                    try:
                        load(self.write(changed))
                    except fc.CorruptError:
                        refused += 1
            self.assertGreater(refused, 50)

    @unittest.skipUnless(CONFORMANCE, "FILAMENT_CONFORMANCE names the program")
    def test_that_the_program_writes_are_read(self):
        out = self.path.parent / "out"
        subprocess.run([CONFORMANCE, "--threads", "off", "--mutations", "off", "--only", "materials-lighting/unlit", "--out",
                        out], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        report = fc.reports.load_conformance(out)
        self.assertTrue(report.cases)
        self.assertFalse(report.failed)
        self.assertTrue(all(case.comparisons for case in report.cases if case.status == "passed"))


if __name__ == "__main__":
    unittest.main()
