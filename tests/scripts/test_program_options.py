# SPDX-License-Identifier: Apache-2.0
"""scripts/program_options reads every form of a help text, and finds tables that are not current, missing or elsewhere."""
import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "program_options"
loader = importlib.machinery.SourceFileLoader("program_options", str(SCRIPT))
program_options = importlib.util.module_from_spec(importlib.util.spec_from_loader("program_options", loader))
loader.exec_module(program_options)

HELP = """Draws.
Usage: matc [OPTIONS] FILE

Positionals:
  FILE TEXT REQUIRED          a file

Options:
  -h,--help                   Print this help message and exit
  --fit,--no-fit{false}       fits | fills (on)
  -j,--jobs INT:INT in [1 - 256]
                              threads
  --api TEXT:{opengl,vulkan}  language
  --fps TEXT=30               as --jobs of docs/quality.md

Exit status: 0
  --none                      this is no option
"""
ROWS = ("| option | meaning |\n|---|---|\n"
        "| `FILE` | a file |\n"
        "| `--fit`, `--no-fit` | fits \\| fills (on) |\n"
        "| `-j`, `--jobs` | threads; 1 to 256 |\n"
        "| `--api` | language; opengl, vulkan |\n"
        "| `--fps` | as `--jobs` of [quality.md](quality.md); initially 30 |\n")
PAGE = f"<!-- options of matc -->\n{ROWS}<!-- end of options of matc -->\n"


class Tree:
    """A repository with one program, a page, and other documents."""

    def __init__(self, page, documents=(), programs=("matc",)):
        self.folder = tempfile.TemporaryDirectory()
        root = self.root = pathlib.Path(self.folder.name)
        (root / "bin").mkdir()
        (root / "docs").mkdir()
        (root / "docs/programs.md").write_text(page, encoding="utf-8")
        for name, text in dict(documents).items():
            (root / name).write_text(text, encoding="utf-8")
        for name in programs:
            (root / "bin" / name).write_text(f"#!/bin/sh\ncat <<'END'\n{HELP}END\n", encoding="utf-8")
            (root / "bin" / name).chmod(0o755)
        subprocess.run(["git", "init", "-q", root], check=True)

    def run(self, *words):
        done = subprocess.run([sys.executable, SCRIPT, "--root", self.root, "--bin", self.root / "bin", *words],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def page(self):
        return (self.root / "docs/programs.md").read_text(encoding="utf-8")


class Tables(unittest.TestCase):
    def tree(self, *words, **names):
        tree = Tree(*words, **names)
        self.addCleanup(tree.folder.cleanup)
        return tree

    def test_that_are_current_are_left_alone(self):
        self.assertEqual(self.tree(PAGE).run(), (0, ""))

    def test_are_written_from_the_help(self):
        tree = self.tree("a\n<!-- options of matc -->\nold\n<!-- end of options of matc -->\nb\n")
        status, output = tree.run()
        self.assertEqual(status, 1)
        self.assertIn("its tables are not current", output)
        self.assertEqual(tree.run("--write"), (0, ""))
        self.assertEqual(tree.page(), f"a\n{PAGE}b\n")

    def test_of_every_program_are_asked_for(self):
        status, output = self.tree(PAGE, programs=("matc", "filament-new", "a_tests")).run()
        self.assertEqual((status, output), (1, "docs/programs.md: there is no table of filament-new\n"))

    def test_in_other_documents_are_found(self):
        status, output = self.tree(PAGE, {"README.md": "x\n| `--size` | y |\n", "docs/a.md": "| `a` | `--size` |\n"}).run()
        self.assertEqual(status, 1)
        self.assertEqual(output.count("\n"), 1, output)
        self.assertIn("README.md:2: options belong into docs/programs.md", output)


if __name__ == "__main__":
    unittest.main()
