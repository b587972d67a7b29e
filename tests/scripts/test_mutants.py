# SPDX-License-Identifier: Apache-2.0
"""Mutants are switched on one by one in a program of one build, and measure_tiers finds the tests that notice them."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"

SOURCE = """// first line
#include <cstdio>

namespace {

constexpr int kConstant = 3 + 4;
static_assert(kConstant == 7);
enum class Kind { A = 1 + 1 };

constexpr int atCompileTime(int value) {
    return value + 1;
}

struct Data {
    int member[2 + 1] = {};
};

bool isBetween(int value, int low, int high) { // value < low
    return value > low && value < high;
}

void count(int& counter, const char* text) {
    if (text[0] == '<') {
        counter += 2;
    } else
        ++counter;
}

} // namespace

int main() {
    int counter = 0;
    count(counter, "< && >");
    count(counter, "b");
    for (int i = 0; i < 3; ++i) {
        count(counter, "c");
    }
    switch (counter) {
        case 3 + 3:
            counter += 100;
    }
    std::printf("%d %d %d %d\\n", counter, int(isBetween(2, 1, 3)), int(isBetween(1, 1, 3)), int(isBetween(3, 1, 3)));
    std::printf("%d\\n", atCompileTime(0) - 1);
}
"""
EXPECTED = "106 1 0 0\n0\n"
REFUSED = "// first line\n#include <string>\nstd::string joined(std::string text) {\n    text += \"a\";\n    return text;\n}\n"


def run(*command, environment=None, check=True):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, check=check,
                          env={**os.environ, **(environment or {})})


def make_tree(folder, **files):
    root = pathlib.Path(folder, "tree")
    texts = {"cmake/Rooms.cmake": "x LINK ${ARG_LINK} tool_paths GTest::gmock y\n", "tests/CMakeLists.txt": "# tests\n"} | files
    for name, text in texts.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    run("git", "-C", root, "init", "-q")
    run("git", "-C", root, "add", "-A")
    return root


def mutate(root, *arguments, check=True):
    return run(sys.executable, SCRIPTS / "mutate_sources", "--root", root, *arguments, check=check)


def mutants_of(copy):
    return json.loads((copy / "mutants.json").read_text(encoding="utf-8"))["mutants"]


class Mutants(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = make_tree(cls.folder.name, **{"base/Program.cpp": SOURCE})
        cls.copy = pathlib.Path(cls.folder.name, "copy")
        mutate(cls.root, cls.copy, "--count", "100")
        cls.program = cls.copy / "program"
        run("c++", "-std=c++20", "-o", cls.program, cls.copy / "base/Program.cpp", cls.copy / "base/Mutants.cpp")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def output(self, number=None, **environment):
        variables = environment | ({"FILAMENT_MUTANT": str(number)} if number else {})
        return run("timeout", "5", self.program, environment=variables, check=False).stdout

    def test_without_a_number_the_program_does_what_it_did(self):
        self.assertEqual(self.output(), EXPECTED)

    def test_each_mutant_changes_what_the_program_does(self):
        mutants = mutants_of(self.copy)
        self.assertGreater(len(mutants), 4)
        for mutant in mutants:
            with self.subTest(mutant=mutant):
                self.assertNotEqual(self.output(mutant["number"]), EXPECTED)

    def test_what_is_computed_at_compile_time_is_left_alone(self):
        text = (self.copy / "base/Program.cpp").read_text(encoding="utf-8")
        for line in ("constexpr int kConstant = 3 + 4;", "enum class Kind { A = 1 + 1 };", "    return value + 1;",
                     "    int member[2 + 1] = {};", "        case 3 + 3:", "// value < low"):
            self.assertIn(line, text)

    def test_lines_keep_their_numbers(self):
        text = (self.copy / "base/Program.cpp").read_text(encoding="utf-8")
        lines = text[text.index("#line 1\n") + len("#line 1\n"):].splitlines()
        for mutant in mutants_of(self.copy):
            self.assertIn(f"filamentMutant({mutant['number']})", lines[mutant["line"] - 1])

    def test_reached_mutants_are_noted_also_by_several_programs(self):
        with tempfile.TemporaryDirectory() as work:
            file = pathlib.Path(work, "reached")
            self.output(FILAMENT_MUTANTS_REACHED=str(file))
            reached = {number for number, byte in enumerate(file.read_bytes()) if byte}
            self.assertEqual(reached, {mutant["number"] for mutant in mutants_of(self.copy)})

    def test_the_same_seed_draws_the_same_and_another_draws_others(self):
        keys = {}
        for name, seed in (("same", "1"), ("other", "2")):
            mutate(self.root, pathlib.Path(self.folder.name, name), "--count", "3", "--seed", seed)
            keys[name] = [mutant["key"] for mutant in mutants_of(pathlib.Path(self.folder.name, name))]
        mutate(self.root, pathlib.Path(self.folder.name, "again"), "--count", "3")
        again = [mutant["key"] for mutant in mutants_of(pathlib.Path(self.folder.name, "again"))]
        self.assertEqual(keys["same"], again)
        self.assertNotEqual(keys["same"], keys["other"])

    def test_a_folder_in_use_is_refused(self):
        done = mutate(self.root, self.copy, check=False)
        self.assertIn("is not empty", done.stderr)
        self.assertNotEqual(done.returncode, 0)


class Refused(unittest.TestCase):
    def test_what_does_not_compile_is_replaced_and_others_keep_their_numbers(self):
        with tempfile.TemporaryDirectory() as folder:
            root = make_tree(folder, **{"base/Text.cpp": REFUSED, "jobsystem/Program.cpp": SOURCE})
            copy = pathlib.Path(folder, "copy")
            for seed in map(str, range(20)):  # until a draw has `text -= "a"`
                target = pathlib.Path(folder, seed)
                mutate(root, target, "--count", "4", "--seed", seed)
                if any(mutant["now"] == "-=" and mutant["file"] == "base/Text.cpp" for mutant in mutants_of(target)):
                    copy = target
                    break
            before = mutants_of(copy)
            compiled = run("c++", "-std=c++20", "-c", "-o", copy / "text.o", copy / "base/Text.cpp", check=False)
            self.assertNotEqual(compiled.returncode, 0)
            log = pathlib.Path(folder, "log")
            log.write_text(compiled.stderr, encoding="utf-8")
            mutate(root, copy, "--drop", log)
            run("c++", "-std=c++20", "-c", "-o", copy / "text.o", copy / "base/Text.cpp")
            kept = {mutant["key"]: mutant["number"] for mutant in mutants_of(copy)}
            for mutant in before:
                if mutant["file"] != "base/Text.cpp":
                    self.assertEqual(kept[mutant["key"]], mutant["number"])

    def test_lines_with_the_same_text_keep_numbers_of_their_own(self):
        same = "int f{0}(int a) {{\n    return a + 7;\n}}\n"
        with tempfile.TemporaryDirectory() as folder:
            root = make_tree(folder, **{"base/Same.cpp": "".join(map(same.format, range(4))), "jobsystem/Program.cpp": SOURCE})
            copy = pathlib.Path(folder, "copy")
            mutate(root, copy, "--count", "8")
            before = mutants_of(copy)
            self.assertGreater(len([mutant for mutant in before if mutant["file"] == "base/Same.cpp"]), 1)
            log = pathlib.Path(folder, "log")
            log.write_text(f"{copy}/jobsystem/Program.cpp:{before[-1]['line']}:1: error: no\n", encoding="utf-8")
            mutate(root, copy, "--drop", log)
            numbers = [mutant["number"] for mutant in mutants_of(copy)]
            self.assertEqual(len(numbers), len(set(numbers)))

    def test_a_log_without_errors_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            root = make_tree(folder, **{"base/Program.cpp": SOURCE})
            copy = pathlib.Path(folder, "copy")
            mutate(root, copy, "--count", "2")
            log = pathlib.Path(folder, "log")
            log.write_text("all is well\n", encoding="utf-8")
            self.assertIn("has no error in a line with a mutant", mutate(root, copy, "--drop", log, check=False).stderr)


if __name__ == "__main__":
    unittest.main()
