# SPDX-License-Identifier: Apache-2.0
"""Scene files are edited, saved and built from Python."""
import pathlib
import tempfile

from support import WINDMILL, fc, unittest


class SceneFiles(unittest.TestCase):
    def setUp(self):
        self.scene = fc.SceneFile.parse('{"points": [{"at": [0, 2, 2], "candela": 100}], "view": {"size": [64, 48]}}')

    def test_keys_are_values_of_json(self):
        self.scene.set("camera.eye", (0, 1, 4))
        self.scene.set("points[0].castsShadows", False)
        self.scene.set("points[1]", {"at": [1, 2, 3]})
        self.scene.set("effects.fog", "on")
        self.assertEqual(self.scene.get("camera.eye"), [0, 1, 4])
        self.assertEqual(self.scene.get("points[1]"), {"at": [1, 2, 3]})
        self.assertIsNone(self.scene.get("points[2]"))
        self.scene.erase("points[1]")
        self.assertEqual(len(self.scene.get("points")), 1)
        with self.assertRaisesRegex(fc.InvalidArgumentError, "candela: expected a number from 0"):
            self.scene.set("points[0].candela", -1)
        with self.assertRaises(fc.NotFoundError):
            fc.SceneFile.load("/no/such/scene.json")

    def test_a_saved_scene_is_the_same(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "lamp.json"
            self.scene.save(path)
            again = fc.SceneFile.load(path)
        self.assertEqual(again.text, self.scene.text)
        self.assertEqual(again.name, "lamp")
        self.assertEqual(fc.SceneFile.schema()["title"], "Scene file")

    def test_what_is_built_is_drawn(self):
        self.scene.set("model", str(WINDMILL))
        self.scene.set("suns[0]", {"direction": [-0.3, -1, -0.5]})
        with fc.Engine("gles") as engine:
            scene, view = self.scene.build(engine)
            picture = fc.Renderer(engine).render(scene, view)
            self.assertEqual(picture.shape, (48, 64, 4))
            self.assertGreater(int(picture[..., :3].max()), 0)
            self.assertEqual(scene.counts["lights"], 2)
            self.assertTrue((self.scene.render(engine) == picture).all())

    def test_a_scene_is_saved_as_gltf(self):
        self.scene.set("model", str(WINDMILL))
        self.scene.set("rects[0]", {"at": [0, 3, 0], "nits": 10})
        with tempfile.TemporaryDirectory() as folder, fc.Engine("gles") as engine:
            scene, _ = self.scene.build(engine)
            path = pathlib.Path(folder) / "windmill.glb"
            warnings = scene.save_gltf(path, copyright="A. Author")
            self.assertEqual(warnings, [])
            again = fc.Scene(engine)
            again.add(engine.load_model(path))
            self.assertEqual(again.counts["lights"], scene.counts["lights"])
            self.assertGreater(len(engine.load_model(path).animations), 0)
            with self.assertRaisesRegex(fc.InvalidArgumentError, "ending .glb or .gltf"):
                scene.save_gltf("windmill.obj")


if __name__ == "__main__":
    unittest.main()
