# SPDX-License-Identifier: Apache-2.0
"""Comparisons agree with their definitions, and with the programs that have them."""
import os
import pathlib
import re
import subprocess
import tempfile

from support import fc, np, unittest

IMGDIFF = os.environ.get("FILAMENT_IMGDIFF", "")


def noise(seed, dtype=np.uint8):
    values = np.random.default_rng(seed).integers(0, 256, (24, 32, 4), dtype=np.uint8)
    values[..., 3] = 255
    return values if dtype == np.uint8 else values.astype(dtype) / 64


class Comparisons(unittest.TestCase):
    def test_of_equal_pictures_find_nothing(self):
        for dtype in (np.uint8, np.float16, np.float32, np.float64):
            result = fc.compare(noise(1, dtype), noise(1, dtype))
            self.assertTrue(result.identical)
            self.assertEqual((result.pixels, result.identical_pixels), (768, 768))
            self.assertEqual((result.max_difference, result.rms, result.relative_rms, result.flip_mean), (0, 0, 0, 0))

    def test_count_pixels_and_measure_components(self):
        a = noise(1)
        a[5, 7] = 100, 100, 100, 255
        b = a.copy()
        b[5, 7] = 103, 100, 96, 255
        result = fc.compare(a, b)
        self.assertFalse(result.identical)
        self.assertEqual((result.identical_pixels, result.max_difference), (767, 4))
        self.assertAlmostEqual(result.rms, ((9 + 16) / (768 * 4)) ** 0.5)
        self.assertIn("767 of 768", repr(result))

    def test_of_light_are_relative(self):
        a = np.ones((4, 4, 3), np.float32)
        b = a * 3
        # |test - reference| over the longer of the two and 1 % of the mean, for each pixel
        self.assertAlmostEqual(fc.compare(a, b).relative_rms, 2 / 3.01, places=5)
        self.assertAlmostEqual(fc.compare(a, b).relative_max, 2 / 3.01, places=5)
        self.assertEqual((fc.compare(a, b).rms, fc.compare(a, b).max_difference), ((4 * 3 / 4) ** 0.5, 2))

    def test_see_what_is_not_a_number(self):
        a = np.ones((4, 4, 4), np.float32)
        b = a.copy()
        b[0, 0, 0] = np.nan
        self.assertTrue(fc.compare(b, b).identical)
        self.assertFalse(fc.compare(a, b).identical)
        self.assertEqual(fc.compare(a, b).max_difference, np.inf)

    def test_see_the_sign_of_zero(self):
        a = np.zeros((4, 4, 4), np.float32)
        self.assertFalse(fc.compare(a, -a).identical)
        self.assertEqual(fc.compare(a, -a).max_difference, 0)

    def test_take_any_memory_layout(self):
        a, b = noise(1), noise(2)
        expected = fc.compare(np.ascontiguousarray(a[::-1, ::2]), np.ascontiguousarray(b[::-1, ::2]))
        self.assertEqual(repr(fc.compare(a[::-1, ::2], b[::-1, ::2])), repr(expected))
        self.assertEqual(fc.compare(np.asfortranarray(a), b).rms, fc.compare(a, b).rms)
        self.assertTrue(fc.compare(a[..., :3], a).identical)


class Flip(unittest.TestCase):
    def test_is_0_for_equal_pictures_and_1_for_green_on_blue(self):
        blue, green = np.zeros((64, 64, 3), np.uint8), np.zeros((64, 64, 3), np.uint8)
        blue[..., 2] = green[..., 1] = 255
        self.assertEqual(fc.flip(blue, blue).max(), 0)
        error = fc.flip(blue, green)
        self.assertEqual((error.shape, error.dtype), ((64, 64), np.float32))
        self.assertGreater(error.min(), 0.9)  # the largest difference of the paper's colours
        self.assertLessEqual(error.max(), 1)

    def test_is_what_comparisons_summarise(self):
        a, b = noise(3), noise(4)
        error, result = fc.flip(a, b), fc.compare(a, b)
        self.assertAlmostEqual(float(error.mean(dtype=np.float64)), result.flip_mean, places=6)
        self.assertEqual(np.float32(result.flip_p99), np.sort(error.ravel())[int(np.ceil(0.99 * error.size)) - 1])

    def test_of_light_is_that_of_its_codes(self):
        a, b = noise(3), noise(4)

        def light(codes):
            c = codes[..., :3] / 255
            return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4).astype(np.float32)

        np.testing.assert_allclose(fc.flip(light(a), light(b)), fc.flip(a, b), atol=2e-3)


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_hold_the_same_bits(self):
        for name, picture in (("a.png", noise(1)), ("a.exr", noise(1, np.float32))):
            fc.save_picture(self.folder / name, picture)
            read = fc.load_picture(self.folder / name)
            self.assertEqual(read.dtype, picture.dtype)
            self.assertTrue((read[..., :3] == picture[..., :3]).all(), name)

    @unittest.skipUnless(IMGDIFF, "FILAMENT_IMGDIFF names the program")
    def test_are_compared_as_imgdiff_does(self):
        a = noise(1)
        b = a.copy()
        b[3:6, 2:20, 1] ^= 5
        fc.save_picture(self.folder / "a.png", a)
        fc.save_picture(self.folder / "b.png", b)
        output = self.folder / "difference.png"
        printed = subprocess.run([IMGDIFF, self.folder / "a.png", self.folder / "b.png"], capture_output=True, text=True,
                                 check=False).stdout
        result = fc.compare(a, b)
        self.assertIn(f"max difference {result.max_difference:.0f}/255", printed)
        share = float(re.search(r"identical: ([0-9.]+) %", printed)[1])
        self.assertAlmostEqual(share, result.identical_pixels / result.pixels * 100, delta=1e-4)
        fc.save_picture(output, fc.difference(a, b))
        self.assertEqual(fc.load_picture(output)[0, 0, :3].tolist(), (a[0, 0, :3] // 4).tolist())


if __name__ == "__main__":
    unittest.main()
