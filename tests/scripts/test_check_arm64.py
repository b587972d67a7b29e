# SPDX-License-Identifier: Apache-2.0
"""scripts/check_arm64 unpacks an arm64 system once, and runs unit tests and conformance cases of a build for it."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
DRACO = "usr/lib/aarch64-linux-gnu/cmake/draco/draco-targets.cmake"
PROGRAMS = {
    "uname": "echo ${MACHINE:-x86_64}",
    "aarch64-linux-gnu-g++": "true",
    "qemu-aarch64-static": "true",
    "mmdebstrap": 'for folder; do case $folder in /*.new) break ;; esac; done; echo "mmdebstrap $*" >> "$CALLS"\n'
                  f'mkdir -p "$folder/{os.path.dirname(DRACO)}"; echo \'"/usr/lib/libdraco.a"\' > "$folder/{DRACO}"\n'
                  'mkdir -p "$folder/usr/bin"; ln -s "/bin/${STARTS:-true}" "$folder/usr/bin/spirv-val"\n'
                  '[ -z "${NO_MIRROR:-}" ]',
    "cmake": 'echo "cmake $*" >> "$CALLS"; while [ $# -gt 0 ]; do [ "$1" != -B ] || { mkdir -p "$2/bin"; touch "$2/build.ninja"; '
             'cp "$CONFORMANCE" "$2/bin/filament-conformance"; }; shift; done',
    "ctest": 'echo "ctest $*" >> "$CALLS"; exit "${TESTS:-0}"',
    "filament-conformance": 'echo "conformance $QEMU_LD_PREFIX $VK_ICD_FILENAMES $*" >> "$CALLS"; exit "${CASES:-0}"',
}


class Arm64(unittest.TestCase):
    """A checkout with the script, on a machine whose programs note how they are called."""

    def setUp(self):
        work = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        self.roots, self.calls, self.script = work / "roots", work / "calls", work / "checkout/scripts/check_arm64"
        self.script.parent.mkdir(parents=True)
        (work / "bin").mkdir()
        for name in ("asset_dir", "check_arm64", "list_packages", "packages.txt"):
            shutil.copy(SCRIPTS / name, self.script.parent / name)
        (self.script.parent / "setup").symlink_to("/bin/true")
        for name, text in PROGRAMS.items():
            (work / "bin" / name).write_text(f"#!/bin/sh\n{text}\n")
            (work / "bin" / name).chmod(0o755)
        self.environment = os.environ | {"PATH": f"{work / 'bin'}:{os.environ['PATH']}", "CALLS": str(self.calls),
                                         "FILAMENT_ROOTS": str(self.roots), "CONFORMANCE": str(work / "bin/filament-conformance")}
        self.environment.pop("FILAMENT_ASSET_DIR", None)

    def check(self, *arguments, **environment):
        self.calls.write_text("")
        return subprocess.run([self.script, *arguments], env=self.environment | environment, capture_output=True, text=True, check=False)

    def test_the_system_is_made_once_and_its_paths_are_mended(self):
        for made in (1, 0):
            done = self.check()
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.calls.read_text().count("mmdebstrap "), made)
        self.assertEqual((self.roots / "arm64" / DRACO).read_text(), '"${CMAKE_SYSROOT}/usr/lib/libdraco.a"\n')

    def test_a_system_that_is_half_made_is_made_again(self):
        done = self.check(NO_MIRROR="1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("arm64.log", done.stderr)
        self.assertEqual(self.check().returncode, 0)

    def test_what_runs_here_is_not_unpacked(self):
        self.check()
        packages = self.calls.read_text().split("--include=")[1].split()[0].split(",")
        self.assertLess({"mesa-vulkan-drivers", "libgtest-dev", "libc6-dev"}, set(packages))
        self.assertNotIn("", packages)
        self.assertNotIn("cmake", packages)

    def test_cases_are_drawn_by_drivers_of_arm64(self):
        self.check("--only", "fog")
        self.assertRegex(self.calls.read_text(), rf"conformance {self.roots}/arm64 {self.roots}/arm64/usr/\S+aarch64.json .* --only fog")

    def test_what_fails_fails(self):
        self.assertEqual(self.check(TESTS="8").returncode, 8)
        self.assertIn("conformance ", self.calls.read_text(), "cases are drawn all the same")
        self.assertEqual(self.check(CASES="1").returncode, 1)

    def test_each_error_names_its_cure(self):
        self.assertIn("./check tests it", self.check(MACHINE="aarch64").stderr)
        self.assertIn("update-binfmts --enable qemu-aarch64", self.check(STARTS="false").stderr)


if __name__ == "__main__":
    unittest.main()
