#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The settings of GLM that a user may choose: each either leaves calls of the library as they are, or is refused with a message.

  test_glm_settings.py --prefix PREFIX --libdir lib --compiler g++
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
MESSAGE = "filament_core was compiled with GLM's default vectors"
BOTH = {"g++", "clang++"}
# flags: the compilers with which they change the vectors. GLM takes its features from the dialect for g++, and queries clang.
REFUSED = {
    ("GLM_FORCE_CTOR_INIT",): BOTH,  # copies are no longer trivial: vectors travel by reference
    ("GLM_FORCE_SIZE_T_LENGTH",): BOTH,  # another type of index, and of template
    ("GLM_FORCE_DEFAULT_ALIGNED_GENTYPES", "GLM_FORCE_INTRINSICS"): BOTH,  # a float3 of 16 bytes
    ("GLM_FORCE_DEFAULT_ALIGNED_GENTYPES", "GLM_FORCE_AVX2"): BOTH,
    ("GLM_FORCE_ALIGNED", "GLM_FORCE_INTRINSICS"): BOTH,  # an undocumented name of the same
    ("GLM_FORCE_CXX98",): {"g++"},
    ("GLM_FORCE_CXX03",): {"g++"},
    ("GLM_FORCE_CXX_UNKNOWN",): {"g++"},
}
# Three programs, because some exclude each other: vectors are aligned only with intrinsics, which do not compile with XYZW_ONLY,
# and of which g++ makes ten seconds of work together with swizzles.
PRECISION = [f"GLM_FORCE_PRECISION_{level}_{kind}" for level in ("LOWP", "MEDIUMP", "HIGHP")
             for kind in ("BOOL", "DOUBLE", "FLOAT", "INT", "UINT")]
ACCEPTED = [
    ["GLM_FORCE_DEPTH_ZERO_TO_ONE", "GLM_FORCE_LEFT_HANDED", "GLM_FORCE_EXPLICIT_CTOR",
     "GLM_FORCE_QUAT_DATA_WXYZ", "GLM_FORCE_SILENT_WARNINGS", "GLM_FORCE_UNRESTRICTED_GENTYPE", "GLM_FORCE_INTRINSICS",
     "GLM_FORCE_INLINE", "GLM_FORCE_SSE", "GLM_FORCE_SSE2", "GLM_FORCE_SSE3", "GLM_FORCE_SSSE3", "GLM_FORCE_SSE41",
     "GLM_FORCE_SSE42", "GLM_FORCE_CXX17", "GLM_FORCE_ALIGNED_GENTYPES"],
    ["GLM_FORCE_SWIZZLE", "GLM_FORCE_DEFAULT_ALIGNED_GENTYPES", "GLM_FORCE_PURE", "GLM_FORCE_SINGLE_ONLY",
     "GLM_FORCE_CXX11", "GLM_FORCE_CXX14", "GLM_FORCE_CXX2A", "GLM_FORCE_IGNORE_VERSION", "GLM_FORCE_MESSAGES",
     "GLM_FORCE_COMPILER_UNKNOWN", "GLM_FORCE_PLATFORM_UNKNOWN", "GLM_FORCE_ARCH_UNKNOWN", *PRECISION],
    ["GLM_FORCE_XYZW_ONLY"],
]
# Instruction sets that need a compiler option, or another machine.
ELSEWHERE = {"GLM_FORCE_NEON", "GLM_FORCE_CUDA", "GLM_FORCE_AVX", "GLM_FORCE_AVX2"}
options = None


def compile_with(macros, *arguments):
    command = [options.compiler, "-std=c++20", f"-I{options.prefix}/include", *(f"-D{macro}" for macro in macros), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Settings(unittest.TestCase):
    def test_every_setting_of_the_installed_glm_is_in_a_list(self):
        includes = compile_with([], "-E", "-x", "c++", "-include", "glm/vec3.hpp", "/dev/null").stdout
        folder = pathlib.Path(re.search(r'"([^"]*/glm)/vec3\.hpp"', includes)[1])
        known = set(ELSEWHERE).union(*ACCEPTED, *REFUSED)
        found = {name for path in folder.rglob("*.[hi][pn][pl]") for name in
                 re.findall(r"\bGLM_FORCE_[A-Z0-9_]+", path.read_text(encoding="utf-8", errors="replace"))}
        self.assertGreater(len(found), 30)
        self.assertEqual(found - known, set(), "put these into one of the lists, after looking at what they change")

    def test_what_changes_the_vectors_is_refused_with_a_message(self):
        for macros, compilers in REFUSED.items():
            if options.compiler in compilers:
                with self.subTest(macros):
                    flags = ["-mavx2"] if "GLM_FORCE_AVX2" in macros else []
                    done = compile_with(macros, *flags, "-fsyntax-only", "-x", "c++", "-include", "filament_core/Math.h", "/dev/null")
                    self.assertNotEqual(done.returncode, 0)
                    self.assertIn(MESSAGE, done.stderr)

    def test_everything_else_calls_the_library_as_ever(self):
        library = pathlib.Path(options.prefix, options.libdir)
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", "filament_core"], check=True, capture_output=True, text=True,
                               env={**os.environ, "PKG_CONFIG_PATH": str(library / "pkgconfig")}).stdout.split()
        for macros in ACCEPTED:
            with self.subTest(macros), tempfile.TemporaryDirectory() as folder:
                program = pathlib.Path(folder, "program")
                done = compile_with(macros, "-O0", HERE / "glm_settings.cpp", "-o", program, f"-Wl,-rpath,{library}", *flags)
                self.assertEqual(done.returncode, 0, done.stderr)
                ran = subprocess.run([program], capture_output=True, text=True, check=False)
                self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--prefix", required=True)
    parser.add_argument("--libdir", default="lib")
    parser.add_argument("--compiler", required=True, choices=sorted(BOTH))
    options, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest])
