# SPDX-License-Identifier: Apache-2.0
"""What failed is found in a log of ctest, however long the output around it is."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "what_failed"


def what_failed(*lines):
    with tempfile.NamedTemporaryFile("w", suffix=".log") as log:
        log.write("\n".join(lines) + "\n")
        log.flush()
        return subprocess.run([sys.executable, SCRIPT, log.name], capture_output=True, text=True, check=True).stdout


PASSED = ["      Start  1: units", " 1/3 Test  #1: units ......   Passed    0.12 sec"]
ENGINE = ["      Start 24: engine", "      Start 25: faults", " 2/3 Test #24: engine .....***Failed  338.24 sec",
          "[ RUN      ] Fog.IsThin", "[       OK ] Fog.IsThin (3 ms)", "[ RUN      ] Fog.IsThick", "FogTest.cpp:7: Failure",
          "Expected: 1", "[  FAILED  ] Fog.IsThick (5 ms)", "[ RUN      ] Sun.Shines", "[       OK ] Sun.Shines (1 ms)",
          "[  FAILED  ] 1 test, listed below:", "[  FAILED  ] Fog.IsThick"]


class WhatFailed(unittest.TestCase):
    def test_nothing_is_said_if_nothing_failed(self):
        self.assertEqual(what_failed(*PASSED), "")

    def test_a_failed_case_is_shown_with_its_message_and_without_its_neighbours(self):
        self.assertEqual(what_failed(*PASSED, *ENGINE), "\nengine failed:\n[ RUN      ] Fog.IsThick\nFogTest.cpp:7: Failure\n"
                                                        "Expected: 1\n[  FAILED  ] Fog.IsThick (5 ms)\n")

    def test_a_case_that_crashed_is_shown_from_its_start(self):
        output = what_failed(" 2/3 Test #24: engine .....***Exception: SegFault  3.2 sec", "[ RUN      ] Fog.IsThin",
                             "[       OK ] Fog.IsThin (3 ms)", "[ RUN      ] Fog.IsThick", "base: at the edge", *PASSED)
        self.assertEqual(output, "\nengine failed:\n[ RUN      ] Fog.IsThick\nbase: at the edge\n")

    def test_of_other_tests_the_last_lines_are_shown(self):
        lines = [f"line {number}" for number in range(100)]
        output = what_failed(" 2/3 Test #24: format .....***Failed  1.2 sec", *lines, *PASSED)
        self.assertNotIn("line 39\n", output)
        self.assertIn("line 40\n", output)
        self.assertIn("line 99\n", output)

    def test_of_a_long_case_the_first_lines_are_shown(self):
        lines = [f"line {number}" for number in range(100)]
        output = what_failed(" 2/3 Test #24: engine .....***Timeout  1.2 sec", "[ RUN      ] Fog.IsThick", *lines)
        self.assertIn("line 58\n", output)
        self.assertNotIn("line 59\n", output)
        self.assertIn("... 41 more lines\n", output)

    def test_a_log_that_is_not_there_is_an_error(self):
        done = subprocess.run([sys.executable, SCRIPT, "/no/such.log"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("what_failed: error: ", done.stderr)


if __name__ == "__main__":
    unittest.main()
