# SPDX-License-Identifier: Apache-2.0
"""Following a tutorial finds commands that fail, images that differ, and blocks that nobody would know what to do with."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).with_name("run_tutorial.py")
IMGDIFF = '#!/bin/sh\ncmp "$1" "$2"\n'


def follow(text, pictures=()):
    """Exit status and output; `pictures` are those that are stored."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "a.md").write_text(text, encoding="utf-8")
        (root / "bin").mkdir()
        (root / "bin/imgdiff").write_text(IMGDIFF)
        (root / "bin/imgdiff").chmod(0o755)
        for name, content in pictures:
            (root / name).write_text(content)
        done = subprocess.run([sys.executable, SCRIPT, root / "a.md", "--bin", root / "bin"], capture_output=True, text=True,
                              check=False)
        return done.returncode, done.stdout + done.stderr


class Tutorial(unittest.TestCase):
    def test_a_tutorial_that_works(self):
        status, output = follow("Save as `d/a.txt`:\n\n```cpp\nhello\n```\n\nThen\n\n```sh\ncat d/a.txt > b.txt\n```\n\n"
                                "<!-- shows: b.txt -->\n![b](b.png)\n", [("b.png", "hello\n")])
        self.assertEqual((status, output), (0, "a.md: 3 steps\n"))

    def test_what_fails_is_named_with_its_line(self):
        status, output = follow("a\n\n```sh\ntrue\nfalse | cat\ntrue\n```\n")
        self.assertEqual(status, 1)
        self.assertIn("a.md:3: 'true\nfalse | cat\ntrue' ended with 1", output)

    def test_pictures_must_be_those_of_the_commands(self):
        text = "```sh\necho 1 > b.txt\n```\n\n<!-- shows: b.txt -->\n![b](b.png)\n"
        self.assertIn("b.txt is not b.png", follow(text, [("b.png", "2\n")])[1])
        self.assertIn("no command has made c.txt", follow(text.replace("shows: b", "shows: c"), [("b.png", "1\n")])[1])

    def test_every_block_is_a_file_or_a_command(self):
        self.assertIn("a.md:3: this block is neither", follow("Look at this:\n\n```\nx\n```\n")[1])

    def test_a_text_without_steps_is_an_error(self):
        self.assertEqual(follow("nothing")[0], 1)


if __name__ == "__main__":
    unittest.main()
