# SPDX-License-Identifier: Apache-2.0
"""scripts/check_on makes a release once (scripts/debian_root), runs ./run and ./check in it, and keeps one row of its table for each
release."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
PROGRAMS = {
    "id": "echo ${USER_ID:-0}",
    # as on a machine: the folder grows while it works, and is half done if the mirror is gone
    "debootstrap": 'for folder; do case $folder in /*.new) break ;; esac; done; mkdir -p "$folder/proc" "$folder/dev" "$folder/etc/apt"\n'
                   'echo "$*" >> "$CALLS"; [ -z "${NO_MIRROR:-}" ] || { echo "E: Failed getting release file"; exit 1; }\n'
                   'mkdir -p "$folder/usr/bin"; touch "$folder/usr/bin/git"; chmod +x "$folder/usr/bin/git"',
    "unshare": 'while [ "${1#-}" != "$1" ]; do [ "$1" != --propagation ] || shift; shift; done; exec "$@"',
    "mount": 'echo "mount $*" >> "$CALLS"',
    "chroot": 'echo "chroot $*" >> "$CALLS"\n'
              'case " $* " in\n'
              '*" ./run "*) echo "identical: ${PIXELS:-100.0000} % of pixels, max difference 0/255"; exit "${RUN_STATUS:-0}" ;;\n'
              '*" ./check "*) echo "a.cpp:1: warning: unused"; echo "100% tests passed, 0 tests failed out of 7"; exit "${CHECK_STATUS:-0}" ;;\n'
              '*" scripts/package"*) echo "1.6M libfilament-core0.1.deb"; exit "${PACKAGE_STATUS:-0}" ;;\n'
              '*--list-devices*) echo "vulkan  llvmpipe (LLVM 19.1.7, 256 bits), Mesa 25.0.7-2 (LLVM 19.1.7), Vulkan 1.4" ;;\n'
              '*-dumpfullversion*) echo 14.2.0 ;;\n'
              'esac',
}


class Releases(unittest.TestCase):
    """A checkout with the scripts, on a machine whose programs note how they are called."""

    def setUp(self):
        work = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        self.root, self.roots, self.calls = work / "checkout", work / "roots", work / "calls"
        (self.root / "scripts").mkdir(parents=True)
        (work / "bin").mkdir()
        for name in ("asset_dir", "check_on", "debian_root"):
            shutil.copy(SCRIPTS / name, self.root / "scripts" / name)
        (self.root / "scripts/test_packages").write_text('#!/bin/sh\necho "test_packages $FILAMENT_RELEASE $*" >> "$CALLS"\n')
        (self.root / "scripts/test_packages").chmod(0o755)
        for name, text in PROGRAMS.items():
            (work / "bin" / name).write_text(f"#!/bin/sh\n{text}\n")
            (work / "bin" / name).chmod(0o755)
        unwanted = ("CXX", "FILAMENT_ASSET_DIR", "FILAMENT_NAMESPACE", "FILAMENT_MIRROR")
        self.environment = {name: value for name, value in os.environ.items() if name not in unwanted}
        self.environment |= {"PATH": f"{work / 'bin'}:{os.environ['PATH']}", "CALLS": str(self.calls), "FILAMENT_ROOTS": str(self.roots)}

    def check_on(self, *arguments, **environment):
        self.calls.write_text("")
        return subprocess.run([self.root / "scripts/check_on", *arguments], env={**self.environment, **environment}, capture_output=True,
                              text=True, check=False)

    def refused(self, *arguments, **environment):
        done = self.check_on(*arguments, **environment)
        self.assertEqual(done.returncode, 1, done.stdout)
        return done.stderr

    def test_a_release_is_made_once_and_kept(self):
        for calls in (1, 0):
            done = self.check_on("trixie")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.calls.read_text().count("--variant=minbase"), calls)

    def test_the_build_folder_of_a_release_is_its_own(self):
        self.check_on("trixie")
        self.assertIn(f"mount --bind {self.roots}/trixie-g++/build {self.roots}/trixie{self.root}/build", self.calls.read_text())

    def test_arguments_reach_check(self):
        self.check_on("trixie", "-R", "base")
        self.assertIn("./check -R base", self.calls.read_text())

    def test_run_alone_is_enough_if_asked(self):
        self.check_on("trixie", "--run")
        self.assertNotIn("./check", self.calls.read_text())

    def test_packages_are_made_in_the_release_and_tested_if_asked(self):
        done = self.check_on("trixie", "--package", DEBFULLNAME="A B", DEBEMAIL="a@b.c")
        self.assertEqual(done.returncode, 0, done.stderr)
        calls = self.calls.read_text()
        self.assertIn("DEBFULLNAME=A B DEBEMAIL=a@b.c scripts/package\n", calls)
        self.assertIn(f"test_packages trixie {self.roots}/trixie-g++/build/packages\n", calls)
        self.assertIn("libfilament-core0.1.deb", done.stdout)
        self.assertNotIn("./run", calls)
        self.assertEqual(self.check_on("trixie", "--package", PACKAGE_STATUS="3").returncode, 3)
        self.assertNotIn("test_packages", self.calls.read_text())

    def test_the_table_has_a_row_for_each_release_and_compiler(self):
        self.check_on("trixie", RUN_STATUS="1")
        self.check_on("trixie")
        self.check_on("forky", "--run")
        table = self.check_on("trixie", "--run", CXX="clang++").stdout.splitlines()
        self.assertEqual(len(table), 4, table)
        self.assertRegex(table[0], r"^release +compiler +Mesa +LLVM +\./run s +\./check s +result$")
        self.assertRegex(table[1], r"^forky +g\+\+ 14\.2\.0 +25\.0\.7-2 +19\.1\.7 +\d+ +- +100\.0000 % of pixels equal$")
        self.assertRegex(table[2], r"^trixie +clang\+\+ 14\.2\.0 ")
        self.assertRegex(table[3], r"^trixie +g\+\+ 14\.2\.0 .* 100\.0000 % of pixels equal, 100% tests passed, .* 7, 1 warnings$")

    def test_what_fails_is_shown_and_fails(self):
        for environment, said in (({"RUN_STATUS": "1"}, "./run failed"), ({"CHECK_STATUS": "8"}, "100.0000 % of pixels"),
                                  ({"PIXELS": "0.0000"}, "0.0000 % of pixels")):
            done = self.check_on("trixie", **environment)
            self.assertNotEqual(done.returncode, 0, environment)
            self.assertIn(said, done.stdout)

    def test_pixels_that_differ_are_no_reason_to_leave_out_the_tests(self):
        self.assertEqual(self.check_on("trixie", RUN_STATUS="1", PIXELS="99.9998").returncode, 1)
        self.assertIn("./check", self.calls.read_text())

    def test_each_error_names_its_cure(self):
        self.assertIn("give bookworm, trixie, forky or sid", self.refused("jessie"))
        self.assertIn("run as root, or with sudo", self.refused("trixie", USER_ID="1000"))
        self.assertIn("give the name of a compiler", self.refused("trixie", CXX="g++; true"))
        said = self.refused("trixie", NO_MIRROR="1")
        self.assertIn("FILAMENT_MIRROR names another one", said)
        self.assertIn("E: Failed getting release file", said)

    def test_packages_of_backports_come_from_there(self):
        self.calls.write_text("")
        folder = self.roots / "root"
        folder.mkdir(parents=True)  # an empty one is as good as none
        subprocess.run([self.root / "scripts/debian_root", "bookworm-backports", folder, "libvulkan1"], env=self.environment,
                       check=True, capture_output=True)
        self.assertRegex(self.calls.read_text(), r"--include=ca-certificates bookworm \S+ http://deb.debian.org/debian /usr/share/")
        self.assertIn("apt-get -q install -y --no-install-recommends -t bookworm-backports libvulkan1", self.calls.read_text())
        self.assertEqual((folder / "etc/apt/sources.list").read_text(), "deb http://deb.debian.org/debian bookworm-backports main\n")

    def test_a_release_that_is_half_made_is_made_again(self):
        self.refused("trixie", NO_MIRROR="1")
        self.assertEqual(self.check_on("trixie").returncode, 0)

    def test_without_debootstrap_it_names_the_package(self):
        (self.root.parent / "bin/debootstrap").unlink()
        beside = self.root.parent / "bin"
        for name in ("bash", "env", "dirname", "readlink", "realpath", "sh", "cat", "mkdir"):
            (beside / name).symlink_to(shutil.which(name))
        self.assertIn("apt-get install debootstrap", self.refused("trixie", PATH=str(beside)))


if __name__ == "__main__":
    unittest.main()
