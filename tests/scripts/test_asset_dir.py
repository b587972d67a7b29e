# SPDX-License-Identifier: Apache-2.0
"""scripts/asset_dir chooses the folder of models, and scripts/setup tells CMake, also in a build folder that exists."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"


class Folders(unittest.TestCase):
    """A checkout with the two scripts and a cmake that notes how it is called."""

    def setUp(self):
        work = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        self.root, self.build = work / "checkout", work / "checkout/build/release"
        self.beside, self.own, self.calls = work / "shared/assets", work / "my models", work / "calls"
        for folder in (self.root / "scripts", self.build, self.own, work / "bin"):
            folder.mkdir(parents=True)
        for name in ("asset_dir", "list_packages", "setup"):
            shutil.copy(SCRIPTS / name, self.root / "scripts" / name)
        (self.root / "scripts/packages.txt").write_text("bash\n")
        program = work / "bin/cmake"
        program.write_text(f'#!/bin/sh\n[ "$1" = --build ] || echo "$@" >> "{self.calls}"\n')
        program.chmod(0o755)
        self.environment = {name: value for name, value in os.environ.items() if name != "FILAMENT_ASSET_DIR"}
        self.environment["PATH"] = f"{work / 'bin'}:{os.environ['PATH']}"

    def run_script(self, name, **environment):
        return subprocess.run([self.root / "scripts" / name], env={**self.environment, **environment}, capture_output=True, text=True,
                              check=False)

    def chosen(self, **environment):
        done = self.run_script("asset_dir", **environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()

    def tell(self, folder):
        (self.build / "CMakeCache.txt").write_text(f"FILAMENT_ASSET_DIR:PATH={folder}\n")
        (self.build / "build.ninja").touch()

    def configured(self, **environment):
        """How setup calls cmake, except for the build."""
        self.calls.unlink(missing_ok=True)
        done = self.run_script("setup", **environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.calls.read_text() if self.calls.exists() else ""

    def test_the_environment_comes_first_then_the_build_folder_then_what_lies_beside(self):
        self.assertEqual(self.chosen(), "")
        self.beside.mkdir(parents=True)
        self.assertEqual(self.chosen(), str(self.beside))
        self.tell("")
        self.assertEqual(self.chosen(), str(self.beside))
        self.tell(self.own)
        self.assertEqual(self.chosen(), str(self.own))
        self.assertEqual(self.chosen(FILAMENT_ASSET_DIR=str(self.beside)), str(self.beside))
        self.assertEqual(self.chosen(FILAMENT_ASSET_DIR=""), "")

    def test_a_folder_that_went_away_is_forgotten_and_one_that_is_asked_for_is_missed(self):
        self.tell(self.own / "gone")
        self.assertEqual(self.chosen(), "")
        for name in ("asset_dir", "setup"):
            done = self.run_script(name, FILAMENT_ASSET_DIR="/no/such/folder")
            self.assertEqual(done.returncode, 1)
            self.assertIn("'/no/such/folder', which is no folder", done.stderr)

    def test_setup_configures_anew_only_where_the_folder_is_another(self):
        self.assertIn("--preset release", self.configured())
        self.tell("")
        self.assertEqual(self.configured(), "")
        self.beside.mkdir(parents=True)
        call = self.configured()
        self.assertIn(f"-DFILAMENT_ASSET_DIR={self.beside}\n", call)
        self.assertNotIn("--preset", call)
        self.tell(self.beside)
        self.assertEqual(self.configured(), "")
        self.assertIn(f"-DFILAMENT_ASSET_DIR={self.own}\n", self.configured(FILAMENT_ASSET_DIR=str(self.own)))
        self.assertIn("-DFILAMENT_ASSET_DIR=\n", self.configured(FILAMENT_ASSET_DIR=""))


if __name__ == "__main__":
    unittest.main()
