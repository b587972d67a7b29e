# SPDX-License-Identifier: Apache-2.0
"""Whatever is given to the module: an exception that says what is wrong, never the end of the process."""
import inspect
import pathlib
import random
import tempfile
import warnings

from support import WINDMILL, fc, flat_view, np, placed, quad, unittest, unlit

# What hostile arguments may raise: the module's own exceptions, and those of Python for types.
EXPECTED = (fc.Error, TypeError, ValueError, OverflowError)


class Messages(unittest.TestCase):
    def setUp(self):
        self.engine = fc.Engine("null", workers=0)
        self.addCleanup(self.engine.close)
        self.scene = fc.Scene(self.engine)
        self.view = flat_view()

    def fails(self, kind, words, call, *arguments, **keywords):
        with self.assertRaises(kind) as caught:
            call(*arguments, **keywords)
        self.assertIn(words, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))
        return caught.exception

    def test_of_engines(self):
        self.fails(fc.InvalidArgumentError, "'metal' is not vulkan, gles or null", fc.Engine, "metal")
        self.fails(fc.InvalidArgumentError, "workers: 1000", fc.Engine, "null", workers=1000)
        self.fails(fc.DeviceError, "no such card", fc.Engine, "gles", require_device="no such card")

    def test_of_files(self):
        error = self.fails(fc.NotFoundError, "missing.glb", self.engine.load_model, "missing.glb")
        self.assertEqual(error.code, "not found")
        self.assertIsInstance(error, LookupError)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "broken.glb"
            path.write_bytes(b"glTF\0\0\0\0")
            self.fails(fc.CorruptError, "broken.glb", self.engine.load_model, path)
            self.fails(fc.Error, "broken.glb", self.engine.load_environment, path)
            self.fails(fc.Error, "broken.glb", self.engine.load_texture, str(path))
            self.fails(fc.Error, "broken.glb", fc.load_picture, path)
            self.fails(fc.UnreadableError, "b.png", fc.save_picture, path / "b.png", np.zeros((2, 2, 4), np.uint8))

    def test_of_options(self):
        self.fails(fc.NotFoundError, "did you mean 'shadows'?", self.view.set, "shadow", "off")
        self.fails(fc.InvalidArgumentError, "shadows", self.view.set, "shadows", "soft")
        self.fails(fc.InvalidArgumentError, "fog.density", self.view.set, "fog.density", -1)
        self.fails(fc.NotFoundError, "Scene.add_sun() has it", self.view.set, "sun.showsDisc", True)
        self.fails(fc.NotFoundError, "Engine.load_model() has it", self.view.set, "model.positions", "half")
        self.fails(fc.InvalidArgumentError, "samples: '3'", self.view.set, "samples", 3)
        self.fails(fc.InvalidArgumentError, "debugView: 'x'", self.view.set, "debugView", "x")
        self.fails(fc.InvalidArgumentError, "preset", self.view.preset, "best")

    def test_of_cameras(self):
        self.fails(fc.InvalidArgumentError, "same point", self.view.look_at, (1, 2, 3), (1, 2, 3))
        self.fails(fc.InvalidArgumentError, "eye", self.view.look_at, (1, 2, float("nan")), (0, 0, 0))
        self.fails(fc.InvalidArgumentError, "fov_degrees", self.view.look_at, (1, 2, 3), (0, 0, 0), fov_degrees=180)
        self.fails(fc.InvalidArgumentError, "up", self.view.look_at, (1, 2, 3), (0, 0, 0), up=(0, 0, 0))
        self.fails(fc.InvalidArgumentError, "far", self.view.orthographic, 1, near=2, far=1)
        self.fails(fc.InvalidArgumentError, "a camera is a rotation", setattr, self.view, "world_from_view",
                   placed(scale=2))
        self.fails(fc.InvalidArgumentError, "size", fc.View, (0, 1))
        self.fails(fc.InvalidArgumentError, "size", fc.View, (1, 16385))

    def test_of_meshes(self):
        self.fails(fc.InvalidArgumentError, "vertex 3 of triangle 0", self.engine.mesh, np.zeros((3, 3)), [[0, 1, 3]])
        self.fails(fc.InvalidArgumentError, "vertex -1", self.engine.mesh, np.zeros((3, 3)), [[0, 1, -1]])
        self.fails(fc.InvalidArgumentError, "three integers", self.engine.mesh, np.zeros((3, 3)), [[0.0, 1, 2]])
        self.fails(fc.InvalidArgumentError, "not a finite float", self.engine.mesh, np.full((3, 3), np.inf), [[0, 1, 2]])
        self.fails(fc.InvalidArgumentError, "uv: 2 rows", self.engine.mesh, np.eye(3), [[0, 1, 2]], uv=[[0, 0], [1, 1]])
        self.fails(fc.InvalidArgumentError, "at least one vertex", self.engine.mesh, np.zeros((0, 3)), [[0, 1, 2]])

    def test_of_scenes(self):
        other = fc.Engine("null", workers=0)
        self.addCleanup(other.close)
        material = unlit(self.engine, (1, 1, 1))
        self.fails(fc.InvalidArgumentError, "the mesh belongs to another engine", self.scene.add_mesh, quad(other), material)
        self.fails(fc.InvalidArgumentError, "the scene belongs to another engine", fc.Renderer(other).render, self.scene,
                   self.view)
        self.fails(fc.InvalidArgumentError, "4 x 4", self.scene.add_mesh, quad(self.engine), material, transform=np.eye(3))
        self.fails(fc.InvalidArgumentError, "last row", self.scene.add_mesh, quad(self.engine), material,
                   transform=np.ones((4, 4)))
        self.fails(fc.InvalidArgumentError, "direction is zero", self.scene.add_sun, (0, 0, 0))
        tile = self.engine.light_image(np.ones((2, 2, 4), np.float32), shape="tiled")
        self.fails(fc.InvalidArgumentError, "cookie: its shape is tiled", self.scene.add_spot_light, (0, 0, 0), (0, 0, 1),
                   cookie=tile)
        self.scene.add_sun((0, -1, 0), cookie=tile, cookie_meters=2, up=(1, 0, 0)).remove()
        self.fails(fc.InvalidArgumentError, "shape: 'round' is not", self.engine.light_image,
                   np.ones((2, 2, 4), np.float32), shape="round")
        self.fails(fc.InvalidArgumentError, "inner_degrees", self.scene.add_spot_light, (0, 0, 0), (0, 0, 1),
                   inner_degrees=50, outer_degrees=40)
        self.fails(fc.InvalidArgumentError, "illuminance", self.scene.add_sun, (0, 0, 1), float("inf"))
        self.fails(fc.NotFoundError, "brings no environment", self.scene.set_environment, self.engine.load_model(WINDMILL))
        self.assertRaises(TypeError, self.scene.add_mesh, None, material)

    def test_of_animations(self):
        copy = self.scene.add(self.engine.load_model(WINDMILL))
        self.fails(fc.InvalidArgumentError, "is not below 1", copy.animate, 1, 0)
        self.fails(fc.InvalidArgumentError, "is not below 1", copy.animate, -1, 0)
        for given in (0.5, None, (0,), 1 << 80):
            self.fails(fc.InvalidArgumentError, "give a name or a whole number", copy.animate, given, 0)
        self.fails(fc.NotFoundError, "", copy.animate, "no such animation", 0)

    def test_of_what_was_removed(self):
        shape = self.scene.add_mesh(quad(self.engine), unlit(self.engine, (1, 1, 1)))
        sun = self.scene.add_sun((0, -1, 0))
        copy = self.scene.add(self.engine.load_model(WINDMILL))
        for part in (shape, sun, copy):
            part.remove()
            self.fails(fc.ClosedError, "was removed from its scene", part.remove)
        self.fails(fc.ClosedError, "removed", shape.set_visible, True)
        self.fails(fc.ClosedError, "removed", copy.animate, 0, 0)

    def test_of_pictures(self):
        codes, light = np.zeros((2, 3, 4), np.uint8), np.zeros((2, 3, 4), np.float32)
        self.fails(fc.InvalidArgumentError, "differ in size", fc.compare, codes, codes[:1])
        self.fails(fc.InvalidArgumentError, "display codes", fc.compare, codes, light)
        self.fails(fc.InvalidArgumentError, "uint8 or of floats", fc.compare, codes.astype(int), codes)
        self.fails(fc.InvalidArgumentError, "shape", fc.flip, codes[0], codes[0])
        self.fails(fc.InvalidArgumentError, "shape", fc.flip, codes[:0], codes[:0])
        self.fails(fc.InvalidArgumentError, "output", fc.Renderer(self.engine).render, self.scene, self.view, output="raw")
        self.fails(fc.InvalidArgumentError, "frames", fc.Renderer(self.engine).render, self.scene, self.view, frames=0)


class LyingSequence:
    """Says that it has three items, and has none."""

    def __len__(self):
        return 3

    def __getitem__(self, index):
        raise RuntimeError("no item")


HOSTILE = [None, True, -1, 0, 1, 2 ** 31, 2 ** 64, -2 ** 70, 0.5, float("nan"), float("inf"), -1e308, 1e-320, 1j, "", "on",
           "\0", "ä" * 1000, "\ud800", b"", b"\xff" * 64, "/", "/dev/null/x", (), [], {}, (0, 0, 0), (1, 2), [[1]] * 3,
           ("1", "2", "3"), (None,) * 3, [float("nan")] * 3, range(3), np.zeros(3), np.zeros((0, 0, 4), np.uint8),
           (3e38, -3e38, 3e38), (1e-38,) * 3, 1e12, 3e38, 1e-300, np.diag([1e30, 1e30, 1e30, 1]), np.diag([0, 0, 0, 1]),
           np.array([[1, 0, 0, -1e30], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]), np.zeros((4, 4)), np.eye(4), np.eye(4) * np.nan, np.full((4, 4), 1e300), np.zeros((2, 2, 4), np.uint8),
           np.full((2, 2, 3), np.nan, np.float32), np.array(["a"]), np.array([object()]), np.zeros((2, 2, 2, 2)),
           np.zeros((1, 1, 4), ">f8"), np.zeros((4, 8, 8), np.uint8)[::2, ::2, ::-2], object(), type, len, LyingSequence()]


class HostileArguments(unittest.TestCase):
    """Every function with arguments that make no sense, and with objects of the module in the wrong places."""

    def setUp(self):
        quiet = warnings.catch_warnings()  # NumPy's, about the truth of arrays
        quiet.__enter__()
        self.addCleanup(quiet.__exit__, None, None, None)
        warnings.simplefilter("ignore")

    def targets(self, engine, scene):
        """(function, names of its parameters)"""
        material = engine.built_in_material("lit")
        instance = material.instance()
        model = engine.load_model(WINDMILL)
        parts = [engine, material, instance, engine.sphere(), scene, fc.View((8, 8)), fc.Renderer(engine), scene.add(model),
                 scene.add_mesh(engine.sphere(), instance), scene.add_sun((0, -1, 0))]
        functions = [getattr(fc, name) for name in ("compare", "flip", "difference", "load_picture", "View", "Scene",
                                                    "Renderer", "compile_material_text", "compile_material")]
        for part in parts:
            names = [name for name, _ in inspect.getmembers(type(part)) if not name.startswith("_")]
            functions += [getattr(part, name) for name in names
                          if name not in ("close", "load_look", "use_on_this_thread") and callable(getattr(part, name))]
        return functions, parts + [model, engine.sphere(), engine.texture(np.zeros((2, 2, 4), np.uint8))]

    def test_end_in_exceptions(self):
        choose = random.Random(7)
        engine = fc.Engine("null", workers=0)
        self.addCleanup(engine.close)
        scene = fc.Scene(engine)
        functions, parts = self.targets(engine, scene)
        view = next(part for part in parts if isinstance(part, fc.View))
        renderer = fc.Renderer(engine)
        raised = 0
        for function in functions:
            for _ in range(60):
                arguments = [choose.choice(HOSTILE if choose.random() < 0.7 else parts)
                             for _ in range(choose.randint(1, 3))]
                try:
                    function(*arguments)
                except EXPECTED + (RuntimeError,):
                    raised += 1
            view.size = 8, 8
            renderer.render(scene, view)  # whatever scene and view have become
        self.assertGreater(raised, len(functions) * 20)

    def test_of_keywords_end_in_exceptions(self):
        engine = fc.Engine("null", workers=0)
        self.addCleanup(engine.close)
        scene, renderer, view = fc.Scene(engine), fc.Renderer(engine), fc.View((8, 8))
        mesh, instance = engine.sphere(), unlit(engine, (1, 1, 1))
        calls = [(lambda **k: scene.add_mesh(mesh, instance, **k), ("transform", "name", "casts_shadows")),
                 (lambda **k: scene.add_sun((0, -1, 0), **k), ("illuminance", "color", "angular_radius_degrees")),
                 (lambda **k: scene.add_point_light((0, 1, 0), **k), ("intensity", "color", "range")),
                 (lambda **k: scene.add_spot_light((0, 1, 0), (0, -1, 0), **k), ("inner_degrees", "outer_degrees", "range")),
                 (lambda **k: view.look_at((0, 0, 1), (0, 0, 0), **k), ("fov_degrees", "up", "near")),
                 (lambda **k: view.exposure(**k), ("aperture", "shutter_seconds", "iso")),
                 (lambda **k: engine.mesh(np.eye(3), [[0, 1, 2]], **k), ("normals", "uv", "colors")),
                 (lambda **k: mesh.update(**k), ("positions", "normals", "uv", "colors")),
                 (lambda **k: scene.identify(**{"image": np.ones((2, 2)), **k}), ("image", "aov")),
                 (lambda **k: scene.mask(**{"image": np.ones((2, 2)), "part": 1, **k}), ("image", "part", "aov")),
                 (lambda **k: renderer.render(scene, view, **k), ("output",)),
                 (lambda **k: engine.load_model(WINDMILL, **k), ("positions", "tangents", "files"))]
        for call, names in calls:
            for name in names:
                for value in HOSTILE:
                    try:
                        call(**{name: value})
                    except EXPECTED + (RuntimeError,):
                        pass
                    renderer.render(scene, view)

    def test_as_values_of_parameters_and_options_end_in_exceptions(self):
        engine = fc.Engine("null", workers=0)
        self.addCleanup(engine.close)
        instance = engine.built_in_material("litTextured").instance()
        copy = fc.Scene(engine).add(engine.load_model(WINDMILL))
        view = fc.View((8, 8))
        for value in HOSTILE:
            for parameter in [parameter["name"] for parameter in instance.parameters] + ["x"]:
                try:
                    instance.set(parameter, value)
                except EXPECTED + (RuntimeError,):
                    pass
            for name in copy.materials[:1]:
                for parameter in [parameter["name"] for parameter in copy.parameters(name)]:
                    try:
                        copy.set(name, parameter, value)
                    except EXPECTED + (RuntimeError,):
                        pass
            for name in fc.options():
                try:
                    view.set(name, value)
                except EXPECTED + (RuntimeError,):
                    pass
            fc.Renderer(engine).render(fc.Scene(engine), view)


if __name__ == "__main__":
    unittest.main()
