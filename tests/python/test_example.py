# SPDX-License-Identifier: Apache-2.0
"""The example draws its plot."""
import pathlib
import subprocess
import sys
import tempfile

from support import ROOT, fc, unittest


class Example(unittest.TestCase):
    def test_plots_error_over_time(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "plot.png"
            subprocess.run([sys.executable, ROOT / "python/examples/error_over_time.py", "--size", "32", "18", "--suns", "2",
                            "--frames", "2", "--out", out], check=True, stdout=subprocess.DEVNULL)
            picture = fc.load_picture(out)
            self.assertGreater(picture.shape[1], 800)
            self.assertGreater(picture.std(), 5)


if __name__ == "__main__":
    unittest.main()
