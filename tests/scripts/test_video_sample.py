# SPDX-License-Identifier: Apache-2.0
"""samples/video: what it says of bad files, and how it calls ffmpeg, which is a script here.

    test_video_sample.py PROGRAM
"""
import os
import stat
import subprocess
import sys
import tempfile
import unittest

BARS = os.path.join(os.path.dirname(__file__), "..", "..", "samples", "video", "bars.y4m")
HEADER = b"YUV4MPEG2 W2 H2 C420\n"
FRAME = b"FRAME\n" + bytes(6)
CONVERT = "convert the video: ffmpeg -i IN -pix_fmt yuv420p OUT.y4m"


class VideoSample(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def play(self, name, content, *words, path=""):
        with open(os.path.join(self.folder.name, name), "wb") as file:
            file.write(content)
        return subprocess.run([PROGRAM, name, "gles", "out.png", *words], cwd=self.folder.name, capture_output=True,
                              text=True, check=False, env=os.environ | {"PATH": path})

    def fails_with(self, text, name, content, *words, path=""):
        done = self.play(name, content, *words, path=path)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stderr, text)

    def ffmpeg(self, commands):
        """A folder with a command ffmpeg that writes its words into a file, and then runs the commands."""
        program = os.path.join(self.folder.name, "bin", "ffmpeg")
        os.makedirs(os.path.dirname(program), exist_ok=True)
        with open(program, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\nfor word; do echo \"$word\"; done > words\n" + commands + "\n")
        os.chmod(program, stat.S_IRWXU)
        return os.path.dirname(program)

    def test_bad_files_are_named_with_the_place_and_the_cure(self):
        for text, content in (
                ("line 1: does not begin with YUV4MPEG2", b"RIFF"),
                ("line 1: does not begin with YUV4MPEG2", b""),
                ("line 1: lacks the width .W. or the height .H.", b"YUV4MPEG2 W2\n"),
                ("line 1: 'W0' is not a size from 1 to", b"YUV4MPEG2 W0 H2\n"),
                ("line 1: 'H2x' is not a size from 1 to", b"YUV4MPEG2 W2 H2x\n"),
                ("line 1: 'W99999999999' is not a size", b"YUV4MPEG2 W99999999999 H2\n"),
                ("line 1: the colours are 'C444'; C420 with 8 bits can be read", b"YUV4MPEG2 W2 H2 C444\n"),
                ("line 1: the colours are 'C420p10'", b"YUV4MPEG2 W2 H2 C420p10\n"),
                ("frame 2: does not begin with FRAME", HEADER + FRAME + b"FRAMES\n")):
            self.fails_with(f"'a.y4m', {text}.*; {CONVERT}", "a.y4m", content)
        self.fails_with("frame 2: ends after 5 of 6 bytes: the file was cut short; copy or convert it again", "a.y4m",
                        HEADER + FRAME + FRAME[:-1])
        self.fails_with("the video has no frames", "a.y4m", HEADER)
        self.fails_with("FRAMES is a whole number from 1 on", "a.y4m", HEADER + FRAME, "0")

    def test_odd_sizes_have_a_chroma_sample_more(self):
        self.assertEqual(self.play("a.y4m", b"YUV4MPEG2 W3 H1\nFRAME\n" + bytes(3 + 2 * 2)).returncode, 0)

    def test_without_ffmpeg_it_says_how_to_get_it(self):
        self.fails_with("'a.mp4': needs the command ffmpeg, which is not in PATH: install it .apt-get install ffmpeg., "
                        "or give a .y4m file", "a.mp4", b"")

    def test_ffmpeg_gets_the_name_as_a_word(self):
        name = "-y $(touch hurt).mp4"
        done = self.play(name, b"", path=self.ffmpeg("exec /bin/cat " + os.path.abspath(BARS)))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(self.folder.name, "words"), encoding="utf-8") as file:
            words = file.read().splitlines()
        self.assertEqual(words[words.index("-i") + 1], "file:" + os.path.join(os.path.realpath(self.folder.name), name))
        self.assertFalse(os.path.exists(os.path.join(self.folder.name, "hurt")))

    def test_what_ffmpeg_cannot_decode_is_an_error(self):
        self.fails_with("'a.mp4': ffmpeg found no video in it", "a.mp4", b"", path=self.ffmpeg("exit 1"))
        self.fails_with("'a.mp4', frame 7: ffmpeg could not decode it", "a.mp4", b"",
                        path=self.ffmpeg("/bin/cat " + os.path.abspath(BARS) + "; exit 1"))

    def test_it_ends_before_the_video_does(self):
        endless = "/bin/cat " + os.path.abspath(BARS) + "; while :; do echo FRAME; done"
        self.assertEqual(self.play("a.mp4", b"", "2", path=self.ffmpeg(endless)).returncode, 0)


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
