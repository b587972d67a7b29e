# SPDX-License-Identifier: Apache-2.0
"""scripts/shrink_pictures takes the bytes of opaque alpha away, keeps every pixel, and leaves what it cannot read."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import matplotlib.image
import numpy

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts/shrink_pictures"
SKIPPED = 77


def shrink(*files):
    return subprocess.run([SCRIPT, *files], capture_output=True, text=True, check=False)


class Pictures(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def test_a_picture_has_fewer_bytes_and_the_same_pixels(self):
        picture = self.folder / "-a b.png"
        x, y = numpy.meshgrid(numpy.arange(64), numpy.arange(48))
        pixels = numpy.stack([x * 4, y * 5, (x * y) % 251, numpy.full_like(x, 255)], axis=2).astype(numpy.uint8)
        matplotlib.image.imsave(picture, pixels)
        before = picture.stat().st_size
        done = shrink(picture)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(picture.stat().st_size, before)
        self.assertEqual(done.stdout, f"{picture}: {before} bytes, {picture.stat().st_size} now\n")
        after = matplotlib.image.imread(picture)
        self.assertEqual(after.shape, (48, 64, 3), "no alpha channel")
        self.assertTrue(numpy.array_equal(numpy.round(after * 255).astype(numpy.uint8), pixels[:, :, :3]))
        size = picture.stat().st_size
        self.assertEqual(shrink(picture).stdout, f"{picture}: {size} bytes, {size} now\n")

    def test_what_is_no_picture_stays_as_it_is(self):
        file = self.folder / "a.png"
        file.write_text("text")
        for name, words in ((file, "is it a PNG?"), (self.folder / "none.png", "there is no")):
            done = shrink(name)
            self.assertEqual(done.returncode, 1)
            self.assertIn(words, done.stderr)
        self.assertEqual(file.read_text(), "text")


if __name__ == "__main__":
    if not shutil.which("zopflipng"):
        print("there is no zopflipng: install the packages of scripts/packages-check.txt")
        sys.exit(SKIPPED)
    unittest.main()
