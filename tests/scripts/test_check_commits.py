# SPDX-License-Identifier: Apache-2.0
"""The check of commits finds subjects without an area, with two purposes, or too long, in a range and in a message."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts/check_commits"


def check_message(text):
    """Exit status and output for one message."""
    with tempfile.NamedTemporaryFile("w", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        done = subprocess.run([sys.executable, SCRIPT, "--message", file.name], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


class Subjects(unittest.TestCase):
    def test_what_keeps_the_rule_is_fine(self):
        for subject in ("framegraph: Name the resource of a cycle", "tools/view: Draw handles of lights and nodes", "base: Embed tables",
                        "docs: Compare lines, points and handles of both APIs", "x" * 20 + ": Add " + "y" * 46,
                        "Revert \"Add a thing\"", "fixup! base: Add a thing"):
            with self.subTest(subject):
                self.assertEqual(check_message(subject + "\n\nand more; much more\n"), (0, "commits: 1 subjects, 0 wrong\n"))

    def test_each_broken_rule_is_named(self):
        for subject, words in {
                "Add a thing": "does not begin with an area",
                "base: add a thing": "no verb with a capital letter",
                "base: Added a thing": "use the imperative",
                "base: Adding a thing": "use the imperative",
                "base: Add a thing.": "full stop",
                "base: Read tiles and write strips": "two purposes ('and write')",
                "base: Read tiles, and strips of other files": "two purposes (', and')",
                "base: Read tiles; mend strips": "two purposes (';')",
                "base: Read tiles and do not trust them": "two purposes ('and do')",
                "x" * 20 + ": Add " + "y" * 47: "73 columns",
                "": "does not begin with an area",
        }.items():
            with self.subTest(subject):
                status, output = check_message("# a comment of git\n" + subject + "\n\nbody\n" if subject else "\n")
                self.assertEqual(status, 1, output)
                self.assertIn(words, output)

    def test_a_range_has_a_line_for_each_wrong_commit(self):
        with tempfile.TemporaryDirectory() as folder:
            git = lambda *words: subprocess.run(["git", "-C", folder, "-c", "user.name=a", "-c", "user.email=a@b", *words], check=True,
                                                capture_output=True, text=True).stdout.strip()
            git("init", "-q")
            for subject in ("Old and without an area", "base: Add a thing", "base: Add a thing and remove another"):
                git("commit", "-q", "--allow-empty", "-m", subject)
            run = lambda *words: subprocess.run([sys.executable, SCRIPT, *words], cwd=folder, capture_output=True, text=True, check=False)
            done = run("HEAD~2..HEAD")
            self.assertEqual(done.returncode, 1)
            self.assertEqual(done.stdout, git("log", "-1", "--format=%h") + ": joins two purposes ('and remove'): make it two commits: "
                                          "base: Add a thing and remove another\ncommits: 2 subjects, 1 wrong\n")
            self.assertEqual(run("HEAD~2..HEAD~1").returncode, 0)
            done = run("no-such-range")
            self.assertNotEqual(done.returncode, 0)
            self.assertIn("no-such-range", done.stderr)


if __name__ == "__main__":
    unittest.main()
