# SPDX-License-Identifier: Apache-2.0
"""The list of slowest units counts every command of a ninja log once, under the name of its source."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "slowest_units"


def run(log, *arguments, tests=None):
    """Exit status and output over a build folder with this log; %B stands for the folder."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        if log is not None:
            (folder / ".ninja_log").write_text(log.replace("%B", str(folder)), encoding="utf-8")
        if tests is not None:
            (folder / "Testing/Temporary").mkdir(parents=True)
            (folder / "Testing/Temporary/CTestCostData.txt").write_text(tests, encoding="utf-8")
        done = subprocess.run([sys.executable, SCRIPT, *arguments, "--build", folder], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr


LOG = """# ninja log v5
0\t1500\t7\tCMakeFiles/base.dir/base/Arena.cpp.o\taa
0\t900\t7\ttests/CMakeFiles/scene_tests.dir/scene/SkinsTest.cpp.o\tbb
1500\t1700\t7\tlibbase.a\tcc
0\t4000\t7\tmaterials/lit.fmat\tdd
0\t4000\t7\t%B/materials/lit.fmat\tdd
2000\t5000\t9\tCMakeFiles/base.dir/base/Arena.cpp.o\taa
"""


class SlowestUnits(unittest.TestCase):
    def test_units_are_listed_by_time_and_counted_once(self):
        status, output = run(LOG)
        self.assertEqual(status, 0, output)
        lines = output.split("\n")
        self.assertEqual(lines[0].split(), ["8.1", "s", "in", "4", "units"])
        self.assertEqual([line.split() for line in lines[1:5]], [
            ["4.0", "s", "custom", "materials/lit.fmat"],
            ["3.0", "s", "compile", "base/Arena.cpp"],
            ["0.9", "s", "compile", "tests/scene/SkinsTest.cpp"],
            ["0.2", "s", "link", "libbase.a"],
        ])

    def test_a_unity_batch_has_the_name_of_its_target(self):
        output = run(LOG + "0\t700\t7\ttests/CMakeFiles/scene_tests.dir/Unity/unity_2_cxx.cxx.o\tee\n")[1]
        self.assertIn("0.7 s  compile  tests/scene_tests batch 2", output)

    def test_totals_are_by_folder(self):
        self.assertIn("     3.0 s     1 units  compile base\n", run(LOG)[1])

    def test_n_limits_the_lists(self):
        self.assertNotIn("SkinsTest", run(LOG, "2")[1])
        self.assertEqual(run(LOG, "0")[0], 2)

    def test_tests_of_the_last_ctest_follow(self):
        self.assertIn("\n    12.0 s in 2 tests\n    11.5 s  engine\n     0.5 s  base\n",
                      run(LOG, tests="base 1 0.5\nengine 3 11.5\n---\nengine\n")[1])

    def test_a_folder_without_a_log_is_an_error_with_its_cure(self):
        status, output = run(None)
        self.assertEqual(status, 1)
        self.assertIn("build first", output)


if __name__ == "__main__":
    unittest.main()
