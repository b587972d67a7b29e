# SPDX-License-Identifier: Apache-2.0
"""The include checker finds every broken rule: each bad tree breaks one rule, each good tree none."""
import importlib
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_includes.py"
TABLE = "<!-- scripts/check_includes.py --write -->\n```\n{}```\n"


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
            "base/Hash.h": "#include <cstdint>\n",
            "filament_core/scene/Scene.h": '#include "base/Hash.h"\n#include "filament_core/scene/Node.h"\n',
            "filament_core/scene/Node.h": "\n",
        })
        self.assertEqual(status, 0, output)

    def test_an_include_that_points_up_is_reported_with_file_and_line(self):
        self.assert_broken({
            "base/Hash.h": '\n#include "filament_core/scene/Scene.h"\n',
            "filament_core/scene/Scene.h": "\n",
        }, "base/Hash.h:2:", "includes point down")

    def test_the_two_backends_cannot_see_each_other(self):
        self.assert_broken({
            "backend/gles/Buffer.cpp": '#include "backend/vulkan/Buffer.h"\n',
            "backend/vulkan/Buffer.h": "\n",
        }, "backend/gles/Buffer.cpp:1:", "backend/vulkan")

    def test_a_tool_reaches_a_backend_only_through_create(self):
        files = {"backend/vulkan/Buffer.h": "\n", "backend/create/CreateDriver.h": "\n"}
        status, output = check(files | {"tools/view/main.cpp": '#include "backend/create/CreateDriver.h"\n'})
        self.assertEqual(status, 0, output)
        self.assert_broken(files | {"tools/view/main.cpp": '#include "backend/vulkan/Buffer.h"\n'},
                           "tools/view/main.cpp:1:", "behind backend/create")

    def test_a_program_includes_the_toolkit_and_no_other_program(self):
        files = {"tools/view/View.h": "\n", "toolkit/json/Json.h": "\n"}
        for path in ("tools/accuracy/A.cpp", "python/P.cpp", "bench/frame/B.cpp", "toolkit/json/J.cpp"):
            status, output = check(files | {path: '#include "toolkit/json/Json.h"\n'})
            self.assertEqual(status, 0, output)
            self.assert_broken(files | {path: '#include "tools/view/View.h"\n'}, f"{path}:1:", "the program tools/view")
        status, output = check(files | {"tests/tools/view/T.cpp": '#include "tools/view/View.h"\n'})
        self.assertEqual(status, 0, output)

    def test_every_folder_of_tools_is_in_the_table(self):
        self.assert_broken({"tools/another/main.cpp": "\n"}, "tools/another/main.cpp:1:", "no room")

    def test_a_room_of_the_toolkit_includes_those_below_it(self):
        files = {"toolkit/json/Json.h": "\n", "toolkit/record/Record.h": '#include "toolkit/json/Json.h"\n'}
        self.assertEqual(check(files)[0], 0)
        self.assert_broken(files | {"toolkit/json/J.cpp": '#include "toolkit/record/Record.h"\n'}, "toolkit/json/J.cpp:1:",
                           "includes point down")
        self.assert_broken({"toolkit/json/Json.h": "\n", "filament_core/engine/E.cpp": '#include "toolkit/json/Json.h"\n'},
                           "filament_core/engine/E.cpp:1:", "may not include toolkit/json")

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
            "base/include/filament_core/Math.h": "#include <glm/vec2.hpp>\n",
            "filament_core/include/filament_core/Engine.h": "#include <filament_core/Math.h>\n",
        }
        status, output = check(files | {"filament_core/engine/E.cpp": "#include <filament_core/Engine.h>\n",
                                        "base/B.h": "#include <filament_core/Math.h>\n"})
        self.assertEqual(status, 0, output)
        self.assert_broken(files | {"filament_core/scene/S.h": "#include <filament_core/Engine.h>\n"},
                           "filament_core/scene/S.h:1:", "names the engine")

    def test_a_public_header_belongs_to_its_room(self):
        self.assert_broken({
            "shaders/package/include/filament_core/Material.h": "\n",
            "jobsystem/J.h": "#include <filament_core/Material.h>\n",
        }, "jobsystem/J.h:1:", "belongs to shaders/package")

    def test_a_public_name_is_there_once(self):
        self.assert_broken({
            "base/include/filament_core/Math.h": "\n",
            "filament_core/include/filament_core/Math.h": "\n",
            "filament_core/scene/S.h": "#include <filament_core/Math.h>\n",
        }, "filament_core/scene/S.h:1:", "exists 2 times")

    def test_a_public_header_includes_nothing_that_is_not_public(self):
        self.assert_broken({
            "base/include/filament_core/Math.h": '#include "base/Hash.h"\n',
            "base/Hash.h": "\n",
        }, "base/include/filament_core/Math.h:1:", "public headers include only")

    def test_a_document_with_another_table_is_reported_and_mended(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {"base/Hash.h": "\n",
                               "docs/architecture.md": "Rooms\n\n" + TABLE.format("base: everything\n") + "After\n"}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            run = lambda *more: subprocess.run([sys.executable, SCRIPT, "--root", root, *more], capture_output=True,
                                               text=True, check=False)
            self.assertIn("its include table is not this script's", run().stdout)
            self.assertEqual(run("--write").returncode, 0)
            self.assertEqual(run().returncode, 0)
            text = (root / "docs/architecture.md").read_text(encoding="utf-8")
            self.assertTrue(text.startswith("Rooms\n\n") and text.endswith("```\nAfter\n"), text)
            self.assertIn("jobsystem", text)

    def test_a_document_without_a_table_is_reported(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "docs").mkdir()
            (pathlib.Path(folder) / "docs/architecture.md").write_text("nothing\n", encoding="utf-8")
            done = subprocess.run([sys.executable, SCRIPT, "--root", folder], capture_output=True, text=True, check=False)
            self.assertIn("has no include table", done.stdout)

    def test_no_room_lists_one_that_stands_above_it(self):
        sys.path.insert(0, str(SCRIPT.parent))
        checker = importlib.import_module("check_includes")
        self.assertEqual(list(checker.check_order()), [])
        checker.ROOMS["base"] = ["framegraph"]
        self.assertEqual(list(checker.check_order()), ["base lists framegraph, which is not below it"])

    def test_a_public_header_includes_only_std_and_glm(self):
        self.assert_broken({"filament_core/include/filament_core/Log.h": "#include <string>\n#include <fmt/core.h>\n"},
                           "filament_core/include/filament_core/Log.h:2:", "standard library and GLM")

    def test_a_library_is_included_only_in_its_room(self):
        self.assert_broken({"framegraph/Graph.cpp": "#include <volk.h>\n"}, "framegraph/Graph.cpp:1:", "backend/vulkan")

    def test_a_room_leaves_elementary_functions_of_the_c_library_alone(self):
        self.assert_broken({"framegraph/Graph.cpp": "float a = std::sqrt(2.0f);\nfloat b = std::atan2(1.0f, a);\n"},
                           "framegraph/Graph.cpp:2:", "base/math/Elementary.h")

    def test_a_sample_sees_only_the_public_api(self):
        self.assert_broken({
            "samples/hello/main.cpp": '#include "base/Hash.h"\n',
            "base/Hash.h": "\n",
        }, "samples/hello/main.cpp:1:", "public headers")

    def test_a_source_file_outside_every_room_is_reported(self):
        self.assert_broken({"misc/Helper.cpp": "\n"}, "misc/Helper.cpp:1:", "no room")

    def test_an_empty_tree_is_not_a_pass(self):
        status, _ = check({})
        self.assertNotEqual(status, 0)


if __name__ == "__main__":
    unittest.main()
