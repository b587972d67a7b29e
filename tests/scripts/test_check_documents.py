# SPDX-License-Identifier: Apache-2.0
"""The document checker finds broken links, missing images, images that no document shows, sources without a licence, and
banned phrases."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_documents.py"


def check(files):
    """Exit status and output of the checker over a tree of {path: text or bytes}."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
        done = subprocess.run([sys.executable, SCRIPT, "--root", folder], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


class Documents(unittest.TestCase):
    def assert_broken(self, files, words):
        status, output = check(files)
        self.assertEqual(status, 1, output)
        self.assertIn(words, output)
        self.assertIn(" 1 wrong", output)

    def test_links_and_pictures_that_are_there_are_fine(self):
        status, output = check({
            "README.md": "[a](docs/a.md#part) ![b](docs/b.png \"title\") [c](https://example.org/x.md) [d](#here) `[e](no.md)`\n"
                         "```\n[f](no.md)\n```\n<img src=\"docs/my%20c.svg\">",
            "docs/a.md": "[up](../README.md) [folder](.)", "docs/b.png": "", "docs/my c.svg": "",
            "docs/page.html": '<a href="a.md#x"></a><img alt="&amp;" src="page/1&amp;2.png"><img src="data:image/png;base64,AA">',
            "docs/page/1&2.png": "",
        })
        self.assertEqual(status, 0, output)
        self.assertIn("documents: 3 files, 0 wrong", output)

    def test_what_is_missing_is_reported_with_file_and_line(self):
        self.assert_broken({"a.md": "\n\n[x](b/c.md)"}, "a.md:3: there is no b/c.md")
        self.assert_broken({"docs/p.html": '<img src="p/x.png">'}, "docs/p.html:1: there is no p/x.png")
        self.assert_broken({"a.md": "![x](<x.svg>)"}, "a.md:1: there is no x.svg")
        self.assert_broken({"docs/a.md": "[x](/nowhere/x.md)"}, "docs/a.md:1: there is no /nowhere/x.md")
        self.assert_broken({"docs/a.md": "[x](../y.md)"}, "docs/a.md:1: there is no ../y.md")

    def test_a_picture_as_a_program_wrote_it_is_reported(self):
        picture = lambda color: b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08" + bytes([color])
        for color in (4, 6):  # grey or colours, with alpha
            self.assert_broken({"a.md": "![a](docs/a.png)", "docs/a.png": picture(color)}, "docs/a.png:1: is larger than it must be")
        for color in (0, 2, 3):
            self.assertEqual(check({"a.md": "![a](docs/a.png)", "docs/a.png": picture(color)})[0], 0)
        self.assertEqual(check({"a.md": "![a](b/a.png)", "b/a.png": picture(6)})[0], 0)

    def test_ranges_of_options_are_those_of_the_headers(self):
        page = "| `fog.density` | 1/m from 0 to 10000 | `0.1` | x |\n| `shBands` | 1, 2 or 3 | `3` | x |\n| `fog` | off or on | `off` | x |\n"
        header = ("struct Fog {{\n    bool enabled = false;\n    float density = 0.1f; ///< at a height,\n                          ///< [0, {}] 1/m\n}};\n"
                  "struct Quality {{\n    /// [1, 3]: 1, 4 or 9 coefficients\n    uint8_t shBands = 3;\n}};\n")
        files = lambda text: {"docs/options.md": page, "filament_core/include/filament_core/Effects.h":
                              "// SPDX-License-Identifier: Apache-2.0\n" + text}
        status, output = check(files(header.format("1e4")))
        self.assertEqual(status, 0, output)
        self.assert_broken(files(header.format("10 001")), "Effects.h:4: density is in [0.0, 10001.0] here and in [0.0, 10000.0]")
        self.assert_broken(files(header.format("1e4").replace("[1, 3]", "few")), "docs/options.md: shBands: no header states its range")

    def test_the_lists_of_what_a_change_touches_are_those_of_the_tree(self):
        page = "#### A number, `\\bhalo\\b`: {} files\n\n- `toolkit/a.h`: the member,\n  with a unit\n- `tools/b.cpp`: its use\n"
        code = lambda words: "// SPDX-License-Identifier: Apache-2.0\n" + words
        files = {"CONTRIBUTING.md": page.format(2), "tools/b.cpp": code("halo"), "tools/c.cpp": code("haloes"),
                 "docs/d.cpp": code("halo"), "toolkit/a.h": code("int halo;")}
        status, output = check(files)
        self.assertEqual(status, 0, output)
        self.assert_broken(files | {"tools/c.cpp": code("a halo")}, "`\\bhalo\\b`: tools/c.cpp is not in its list")
        self.assert_broken(files | {"tools/b.cpp": code("haloes")}, "`\\bhalo\\b`: tools/b.cpp does not name it")
        self.assert_broken(files | {"CONTRIBUTING.md": page.format(3)}, "`\\bhalo\\b`: 2 files are listed, not 3")

    def test_a_fragment_has_its_pictures_beside_it_and_its_links_above(self):
        fragment = '<a href="a.md">a</a><img src="x.png">'
        status, output = check({"docs/a.md": "a", "docs/p/1.fragment.html": fragment, "docs/p/x.png": ""})
        self.assertEqual(status, 0, output)
        self.assert_broken({"docs/p/a.md": "a", "docs/p/1.fragment.html": fragment, "docs/p/x.png": ""}, "1.fragment.html:1: there is no")
        self.assert_broken({"docs/a.md": "a", "docs/p/1.fragment.html": fragment}, "docs/p/1.fragment.html:1: there is no x.png")

    def test_a_picture_that_no_document_shows_is_reported(self):
        self.assert_broken({"a.md": "text", "docs/p/x.png": ""}, "docs/p/x.png:1: no document shows this picture")

    def test_sources_without_a_licence_are_reported(self):
        licence = "SPDX-License-Identifier: Apache-2.0\n"
        for name, text in {"a.cpp": "int a;\n", "a.mat": "material {}\n", "CMakeLists.txt": "project(a)\n", "x.cmake": "",
                           ".gitignore": "/build/\n", "a.cpp.in": "int @a@;\n", "tool": "#!/bin/sh\nexit 0\n",
                           "late.py": "\n\n\n# " + licence, "other.py": "# SPDX-License-Identifier: MIT\n"}.items():
            with self.subTest(name):
                self.assert_broken({"a.md": "a", name: text}, f"{name}:1: names no licence")
        status, output = check({"a.md": "a", "a.h": "// " + licence, "tool": "#!/bin/sh\n# " + licence, "data.json": "{}",
                                "server.in": "1", "LICENSE": "x", "tests/fuzz/corpus/a/b.mat": "material {}"})
        self.assertEqual(status, 0, output)

    def test_banned_phrases_are_found_in_documents_and_comments_across_lines(self):
        licence = "SPDX-License-Identifier: Apache-2.0\n"
        for name, text, line in [
                ("b.md", "Text.\nIt is there,\nif nobody\nasks.", 3),
                ("b.h", f"// {licence}/// Of what\n///   blends.\nint a;", 2),
                ("b.cpp", f"// {licence}int a; ///< the same\n", 2),
                ("b.mat", f"// {licence}material {{}} /* a\n wish */", 3),
                ("b.py", f"# {licence}def f():\n    \"\"\"Returns\n    it, as\n    ever.\"\"\"\n", 4),
                ("b.py", f"# {licence}a = 1  # a Wish\n", 2),
                ("CMakeLists.txt", f"# {licence}# goes on\n", 2),
                ("tool", f"#!/bin/sh\n# {licence}exit 0 # what is\n# opaque\n", 3),
        ]:
            with self.subTest(name):
                self.assert_broken({"a.md": "a", name: text}, f"{name}:{line}: '")
                self.assertIn("write ", check({"a.md": "a", name: text})[1])

    def test_identifiers_strings_and_code_are_not_prose(self):
        licence = "SPDX-License-Identifier: Apache-2.0\n"
        status, output = check({
            "a.md": "`nobody asks` wishing\n```\nwhat blends\n```\n", "a.py": f"# {licence}wish = 'nobody asks'\n",
            "a.cpp": f"// {licence}Wish wish; // of what\nint blends; // an if\nauto s = \"// as ever\", t = R\"(// wish)\";\n",
        })
        self.assertEqual(status, 0, output)

    def test_a_tree_without_documents_is_an_error(self):
        self.assertEqual(check({"a.txt": ""})[0], 1)


if __name__ == "__main__":
    unittest.main()
