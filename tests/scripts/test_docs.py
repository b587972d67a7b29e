# SPDX-License-Identifier: Apache-2.0
"""The documentation site: its checker finds broken links and foreign files, and pages reach it as GitHub shows them."""
import importlib.machinery
import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True


def module(path):
    loader = importlib.machinery.SourceFileLoader(path.name.replace(".", "_"), str(path))
    found = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(found)
    return found


DOCS = module(ROOT / "scripts/docs")
HOOKS = module(ROOT / "docs/site/hooks.py")
FILTER = module(ROOT / "docs/site/doxygen_filter.py")


def check(files):
    """Exit status and output of the checker over a folder of {path: text}."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, ROOT / "scripts/check_site.py", folder], capture_output=True, text=True,
                              check=False)
        return done.returncode, done.stdout


class Checker(unittest.TestCase):
    def assert_wrong(self, text, words):
        status, output = check({"a.html": text, "b.html": '<h1 id="here">b</h1>'})
        self.assertEqual(status, 1, output)
        self.assertIn(words, output)
        self.assertIn(" 1 wrong", output)

    def test_links_that_hold_are_fine(self):
        status, output = check({
            "a.html": '<a href="b/c.html#x%20y">c</a><a href="#top"></a><p id="top"><a href="https://example.org/">e</a>'
                      '<img src="b/d.png"><a href="mailto:a@b">m</a>',
            "b/c.html": '<h2 id="x y">x</h2>', "b/d.png": ""})
        self.assertEqual(status, 0, output)

    def test_what_is_missing_is_reported(self):
        self.assert_wrong('<a href="no.html">n</a>', "a.html: there is no no.html")
        self.assert_wrong('<a href="b.html#there">n</a>', "b.html has no place 'there'")
        self.assert_wrong('<a href="#there">n</a>', "a.html has no place 'there'")
        self.assert_wrong('<img src="no.png"/>', "there is no no.png")

    def test_pages_load_nothing_from_elsewhere(self):
        self.assert_wrong('<script src="https://cdn.example.org/x.js"></script>', "from another host")
        self.assert_wrong('<link rel="stylesheet" href="//example.org/x.css">', "from another host")

    def test_a_folder_without_pages_is_an_error(self):
        self.assertEqual(check({"a.txt": ""})[0], 1)


class Pages(unittest.TestCase):
    def test_lists_and_tables_begin_after_a_blank_line(self):
        self.assertEqual(DOCS.with_blank_lines("text\n- a\n  more\n- b\n\ntext\n| a |\n|---|"),
                         "text\n\n- a\n  more\n- b\n\ntext\n\n| a |\n|---|")
        self.assertEqual(DOCS.with_blank_lines("- a\n  - b"), "- a\n    - b")

    def test_code_stays_as_it_is(self):
        code = "```\ntext\n- a\n  - b\n```"
        self.assertEqual(DOCS.with_blank_lines(code), code)

    def test_anchors_are_those_of_github(self):
        self.assertEqual(HOOKS.github_anchor("What a *frame* & `it` needs (now)"), "what-a-frame--it-needs-now")

    def test_links_become_those_of_the_site(self):
        with tempfile.TemporaryDirectory() as folder:
            pages = DOCS.Pages(pathlib.Path(folder))
            place = lambda name: str(pages.target_of(ROOT / name))
            self.assertEqual(place("docs/quality.md"), "quality.md")
            self.assertEqual(place("README.md"), "repository/README.md")
            self.assertEqual(place("framegraph"), "repository/framegraph/README.md")
            self.assertEqual(place("filament_core/include/filament_core/View.h"), "api/View_8h.html")
            self.assertEqual(place("samples/hello/main.cpp"), "repository/samples/hello/main.cpp.md")
            self.assertTrue(pathlib.Path(folder, "repository/samples/hello/main.cpp.md").exists())
            self.assertEqual(place("docs/accuracy.md"), "accuracy.html")

    def test_the_report_of_accuracy_is_made_with_its_pictures(self):
        with tempfile.TemporaryDirectory() as folder:
            DOCS.Pages(pathlib.Path(folder)).add_report()
            text = pathlib.Path(folder, "accuracy.html").read_text(encoding="utf-8")
            self.assertIn('href="conformance.html"', text)
            pictures = re.findall(r'src="([^"]+)"', text)
            self.assertTrue(pictures)
            for picture in pictures:
                self.assertTrue(pathlib.Path(folder, picture).exists(), picture)


class Charters(unittest.TestCase):
    def test_the_charter_of_a_header_describes_the_file(self):
        text = "// SPDX\n/// View: a camera.\n///   Thread  any.\n///           Not two.\n#pragma once\n/// A.\nstruct A;\n"
        self.assertEqual(FILTER.described("View.h", text),
                         "// SPDX\n/// \\file View.h\n/// View: a camera.\n/// \\par Thread:\n/// any.\n"
                         "///           Not two.\n#pragma once\n/// A.\nstruct A;\n")

    def test_other_texts_stay_as_they_are(self):
        self.assertEqual(FILTER.described("A.h", "#pragma once\n/// A.\nstruct A;\n"), "#pragma once\n/// A.\nstruct A;\n")


if __name__ == "__main__":
    unittest.main()
