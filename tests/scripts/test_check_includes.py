# SPDX-License-Identifier: Apache-2.0
"""The include checker finds what it is there to find: each bad tree breaks one rule, each good tree none."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_includes.py"


def check(files):
    """Exit status and output of the checker over a tree of {path: text}."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, SCRIPT, "--root", root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


class IncludeTable(unittest.TestCase):
    def assert_broken(self, files, where, words):
        status, output = check(files)
        self.assertNotEqual(status, 0, output)
        self.assertIn(where, output)
        self.assertIn(words, output)
        self.assertIn("1 broken rules", output)

    def test_an_include_that_points_down_is_fine(self):
        status, output = check({
            "filament_core/base/Hash.h": "#include <cstdint>\n",
            "filament_core/scene/Scene.h": '#include "filament_core/base/Hash.h"\n#include "filament_core/scene/Node.h"\n',
            "filament_core/scene/Node.h": "\n",
        })
        self.assertEqual(status, 0, output)

    def test_an_include_that_points_up_is_reported_with_file_and_line(self):
        self.assert_broken({
            "filament_core/base/Hash.h": '\n#include "filament_core/scene/Scene.h"\n',
            "filament_core/scene/Scene.h": "\n",
        }, "filament_core/base/Hash.h:2:", "includes point down")

    def test_the_two_backends_cannot_see_each_other(self):
        self.assert_broken({
            "backend/gles/Buffer.cpp": '#include "backend/vulkan/Buffer.h"\n',
            "backend/vulkan/Buffer.h": "\n",
        }, "backend/gles/Buffer.cpp:1:", "backend/vulkan")

    def test_a_tool_reaches_a_backend_only_through_create(self):
        files = {"backend/vulkan/Buffer.h": "\n", "backend/create/CreateDriver.h": "\n"}
        status, output = check(files | {"tools/x/main.cpp": '#include "backend/create/CreateDriver.h"\n'})
        self.assertEqual(status, 0, output)
        self.assert_broken(files | {"tools/x/main.cpp": '#include "backend/vulkan/Buffer.h"\n'},
                           "tools/x/main.cpp:1:", "behind backend/create")

    def test_a_test_looks_inside_the_folder_it_mirrors(self):
        files = {"backend/vulkan/Buffer.h": "\n"}
        status, output = check(files | {"tests/backend/vulkan/T.cpp": '#include "backend/vulkan/Buffer.h"\n'})
        self.assertEqual(status, 0, output)
        self.assert_broken(files | {"tests/backend/gles/T.cpp": '#include "backend/vulkan/Buffer.h"\n'},
                           "tests/backend/gles/T.cpp:1:", "behind backend/create")

    def test_includes_are_written_from_the_repository_root(self):
        self.assert_broken({
            "jobsystem/Jobs.cpp": '#include "Jobs.h"\n',
            "jobsystem/Jobs.h": "\n",
        }, "jobsystem/Jobs.cpp:1:", "from the repository root")

    def test_a_room_below_the_engine_sees_only_the_public_values(self):
        files = {
            "filament_core/include/filament/Math.h": "#include <glm/vec2.hpp>\n",
            "filament_core/include/filament/Engine.h": "#include <filament/Math.h>\n",
        }
        status, output = check(files | {"filament_core/engine/E.cpp": "#include <filament/Engine.h>\n",
                                        "filament_core/base/B.h": "#include <filament/Math.h>\n"})
        self.assertEqual(status, 0, output)
        self.assert_broken(files | {"filament_core/scene/S.h": "#include <filament/Engine.h>\n"},
                           "filament_core/scene/S.h:1:", "names the engine")

    def test_a_public_header_includes_only_std_and_glm(self):
        self.assert_broken({"filament_core/include/filament/Log.h": "#include <string>\n#include <fmt/core.h>\n"},
                           "filament_core/include/filament/Log.h:2:", "standard library and GLM")

    def test_a_library_is_included_only_in_its_room(self):
        self.assert_broken({"framegraph/Graph.cpp": "#include <volk.h>\n"}, "framegraph/Graph.cpp:1:", "backend/vulkan")

    def test_a_sample_sees_only_the_public_api(self):
        self.assert_broken({
            "samples/hello/main.cpp": '#include "filament_core/base/Hash.h"\n',
            "filament_core/base/Hash.h": "\n",
        }, "samples/hello/main.cpp:1:", "public headers")

    def test_a_source_file_outside_every_room_is_reported(self):
        self.assert_broken({"misc/Helper.cpp": "\n"}, "misc/Helper.cpp:1:", "no room")

    def test_an_empty_tree_is_not_a_pass(self):
        status, _ = check({})
        self.assertNotEqual(status, 0)


if __name__ == "__main__":
    unittest.main()
