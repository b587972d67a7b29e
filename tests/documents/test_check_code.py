# SPDX-License-Identifier: Apache-2.0
"""The check of code blocks finds what does not parse, and names document and line."""
import pathlib
import sys
import tempfile
import types
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_code  # noqa: E402


def check(text):
    """The errors in a document that has this text from its third line on."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "docs/sub").mkdir(parents=True)
        (root / "docs/sub/a.md").write_text("# a\n\n" + text, encoding="utf-8")
        (root / "tests/documents").mkdir(parents=True)
        (root / "tests/documents/Context.h").write_text("namespace example { struct Engine; struct Device; int known(); }\n")
        options = types.SimpleNamespace(root=root, compiler="c++", matc="false", include=[])
        return check_code.check(options, root)


class Code(unittest.TestCase):
    def assert_wrong(self, text, words):
        wrong, _ = check(text)
        self.assertEqual(len(wrong), 1, wrong)
        self.assertIn(words, wrong[0])

    def test_what_is_right_is_fine(self):
        wrong, count = check("```cpp\n#include <vector>\nstd::vector<int> a{ known() };\nint engine = 1;\n```\n```json\n[1]\n```\n"
                             "```sh\nls | wc\n```\n```cmake\nadd_thing(a b)\n```\n```\nany text (\n```\n")
        self.assertEqual((wrong, count), ([], 5))

    def test_what_is_wrong_is_named(self):
        self.assert_wrong("```cpp\nint a;\nunknown();\n```\n", "docs/sub/a.md:5:")
        self.assert_wrong("```json\n[1\n```\n", "docs/sub/a.md:4:")
        self.assert_wrong("```sh\nif\n```\n", "docs/sub/a.md:4:")
        self.assert_wrong("```python\na = 1\nif\n```\n", "docs/sub/a.md:5:")
        self.assert_wrong("```cmake\nadd_thing(\n```\n", "docs/sub/a.md:4:")
        self.assert_wrong("```material\nmaterial {}\n```\n", "docs/sub/a.md:4:")

    def test_other_languages_are_an_error(self):
        self.assert_wrong("```rust\nfn main() {}\n```\n", "docs/sub/a.md:4: nothing checks code of the language 'rust'")


if __name__ == "__main__":
    unittest.main()
