# SPDX-License-Identifier: Apache-2.0
"""Materials are compiled, loaded and changed; parameters have the values that were set."""
import pathlib
import tempfile

from support import WINDMILL, fc, flat_view, np, quad, unittest

# Shows what its parameters hold, one channel each.
MATERIAL = """
material {
    name : Probe,
    shadingModel : unlit,
    constants : [ { type : float, name : scale, default : 1.0 } ],
    parameters : [
        { type : float, name : number }, { type : float3, name : color }, { type : int, name : whole },
        { type : bool, name : isOn }, { type : float3x3, name : matrix }, { type : float[3], name : list },
        { type : uint2, name : pair } ]
}
fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        vec3 sum = vec3(materialParams.number) + materialParams.color + vec3(float(materialParams.whole), 0.0, 0.0);
        if (materialParams.isOn) sum += materialParams.matrix * vec3(1.0, 0.0, 0.0);
        sum += vec3(materialParams.list[0], materialParams.list[1], materialParams.list[2]);
        sum += vec3(materialParams.pair, 0.0);
        material.baseColor = vec4(sum * materialConstants_scale, 1.0);
    }
}
"""


class Compiling(unittest.TestCase):
    def test_gives_the_same_package_from_text_and_file(self):
        package = fc.compile_material_text(MATERIAL, name="probe.mat")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "probe.mat"
            path.write_text(MATERIAL, encoding="utf-8")
            self.assertEqual(fc.compile_material(path), package)
            (pathlib.Path(folder) / "probe.fmat").write_bytes(package)
            with fc.Engine("null") as engine:
                self.assertEqual(engine.load_material(str(path.with_suffix(".fmat"))).name, "Probe")

    def test_errors_have_the_line_of_the_author(self):
        with self.assertRaises(fc.InvalidArgumentError) as caught:
            fc.compile_material_text(MATERIAL.replace("prepareMaterial(material);", "prepare(material);"), name="probe.mat")
        line = 1 + MATERIAL[:MATERIAL.index("prepareMaterial")].count("\n")
        self.assertIn(f"probe.mat:{line}:", str(caught.exception))
        self.assertRaises(fc.Error, fc.compile_material_text, "")
        self.assertRaises(fc.NotFoundError, fc.compile_material, "no such.mat")

    def test_packages_that_are_broken_are_refused(self):
        package = fc.compile_material_text(MATERIAL)
        with fc.Engine("null") as engine:
            for broken in (b"", package[:100], b"x" * 1000, package[:-1]):
                self.assertRaises(fc.CorruptError, engine.load_material, broken)
            with self.assertRaises(fc.NotFoundError) as caught:
                engine.load_material(package, constants={"scal": 1.0})
            self.assertIn("scale", str(caught.exception))


class Parameters(unittest.TestCase):
    def setUp(self):
        self.engine = fc.Engine("gles")
        self.addCleanup(self.engine.close)

    def shown(self, instance):
        scene = fc.Scene(self.engine)
        scene.add_mesh(quad(self.engine), instance)
        return fc.Renderer(self.engine).render(scene, flat_view(4, 4), output="light")[0, 0, :3].tolist()

    def test_hold_what_was_set(self):
        material = self.engine.load_material(fc.compile_material_text(MATERIAL), constants={"scale": 2.0})
        self.assertEqual(material.constants, {"scale": 2.0})
        self.assertEqual([p["type"] for p in material.parameters][:5], ["float", "float3", "int", "bool", "float3x3"])
        instance = material.instance()
        self.assertEqual(self.shown(instance), [0, 0, 0])
        instance.set("number", 1)
        instance.set("color", (0, 1, np.float32(2)))
        instance.set("whole", np.int64(-1))
        instance.set("isOn", True)
        instance.set("matrix", [[8, 0, 0], [16, 0, 0], [32, 0, 0]])  # its first column, row by row
        instance.set("list", np.array([0.25, 0.5, 0.75]))
        instance.set("pair", [64, 128])
        self.assertEqual(self.shown(instance), [2 * v for v in (1 - 1 + 8 + 0.25 + 64, 1 + 1 + 16 + 0.5 + 128,
                                                                1 + 2 + 32 + 0.75)])

    def test_of_other_types_are_refused(self):
        instance = self.engine.load_material(fc.compile_material_text(MATERIAL)).instance()
        for name, value in (("number", "1"), ("number", float("nan")), ("number", 1e39), ("color", (1, 2)), ("whole", 0.5),
                            ("whole", 2 ** 31), ("isOn", 2), ("matrix", np.eye(4)), ("list", [1, 2, 3, 4]), ("list", 1),
                            ("pair", (-1, 0))):
            with self.assertRaises(fc.InvalidArgumentError, msg=(name, value)) as caught:
                instance.set(name, value)
            self.assertIn(name, str(caught.exception))
        with self.assertRaises(fc.NotFoundError) as caught:
            instance.set("colour", (1, 1, 1))
        self.assertIn("color", str(caught.exception))
        self.assertEqual(self.shown(instance), [0, 0, 0])

    def test_of_a_material_with_attributes_that_meshes_lack_are_refused(self):
        text = MATERIAL.replace("shadingModel : unlit,", "shadingModel : unlit, requires : [ uv1 ],")
        instance = self.engine.load_material(fc.compile_material_text(text)).instance()
        scene = fc.Scene(self.engine)
        self.assertRaises(fc.InvalidArgumentError, scene.add_mesh, quad(self.engine), instance)
        shape = scene.add_mesh(quad(self.engine), self.engine.built_in_material("unlit").instance())
        self.assertRaises(fc.InvalidArgumentError, shape.set_material, instance)


PASS = """
material {
    name : Adder,
    domain : postprocess,
    parameters : [ { type : sampler2d, name : color }, { type : float, name : share } ]
}
fragment {
    void postProcess(inout PostProcessInputs inputs) {
        inputs.color = texelFetch(materialParams_color, getPixel(), 0) + vec4(vec3(materialParams.share), 0.0);
    }
}
"""


class Passes(unittest.TestCase):
    def setUp(self):
        self.engine = fc.Engine("gles")
        self.addCleanup(self.engine.close)

    def test_follow_each_other_over_the_picture(self):
        material = self.engine.load_material(fc.compile_material_text(PASS))
        view, renderer, scene = flat_view(4, 4), fc.Renderer(self.engine), fc.Scene(self.engine)
        view.clear_color = (0, 0, 0, 1)
        passes = []
        for share, place in ((0.25, "last"), (0.5, "beforeToneMapping")):
            instance = material.instance()
            instance.set("share", share)
            passes.append((instance, place))
        view.post_process = passes
        self.assertEqual([place for _, place in view.post_process], ["last", "beforeToneMapping"])
        self.assertEqual(renderer.render(scene, view, output="light")[0, 0].tolist(), [0.75, 0.75, 0.75, 1])
        view.post_process = []
        self.assertEqual(renderer.render(scene, view, output="light")[0, 0].tolist(), [0, 0, 0, 1])

    def test_that_cannot_be_drawn_are_refused(self):
        surface = self.engine.built_in_material("unlit").instance()
        view = flat_view(4, 4)
        with self.assertRaises(fc.InvalidArgumentError) as caught:
            view.post_process = [(surface, "first")]
        self.assertIn("afterOpaque", str(caught.exception))
        view.post_process = [(surface, "last")]
        with self.assertRaises(fc.Error) as caught:
            fc.Renderer(self.engine).render(fc.Scene(self.engine), view)
        self.assertIn("domain : postprocess", str(caught.exception))


MESHES = """
material {
    name : Pair,
    shadingModel : unlit,
    culling : none,
    outputs : [ { name : mask }, { name : place } ]
}
fragment {
    void material(inout MaterialInputs material) {
        prepareMaterial(material);
        material.mask = float4(0.5, 2.0, 0.0, 1.0);
        material.place = float4(getUserWorldPosition(), 1.0);
    }
}
"""


class MeshPasses(unittest.TestCase):
    def test_give_their_outputs_as_arrays(self):
        engine = fc.Engine("gles")
        self.addCleanup(engine.close)
        scene, renderer, view = fc.Scene(engine), fc.Renderer(engine), flat_view(4, 4)
        scene.add_mesh(quad(engine), engine.built_in_material("unlit").instance())
        pair = engine.load_material(fc.compile_material_text(MESHES)).instance()
        mask, place = renderer.render_meshes(scene, view, pair, outputs=2, clear=(7, 7, 7, 7))
        self.assertEqual(mask.dtype, np.float32)
        self.assertEqual(mask[1, 1].tolist(), [0.5, 2, 0, 1])
        self.assertEqual(place[1, 1, 3], 1)
        empty, _ = renderer.render_meshes(fc.Scene(engine), view, pair, outputs=2, clear=(7, 7, 7, 7))
        self.assertTrue((empty == 7).all())
        with self.assertRaises(fc.Error) as caught:
            renderer.render_meshes(scene, view, pair)
        self.assertIn("writes 2 colours, and is drawn to 1", str(caught.exception))
        self.assertRaises(fc.InvalidArgumentError, renderer.render_meshes, scene, view, pair, outputs=5)


class Models(unittest.TestCase):
    def setUp(self):
        self.engine = fc.Engine("gles")
        self.addCleanup(self.engine.close)
        self.model = self.engine.load_model(WINDMILL)
        self.scene = fc.Scene(self.engine)
        self.scene.add_sun((-1, -1, -1))
        self.view = fc.View((64, 64))
        self.view.look_at((0.9, 0.6, 1.5), (0, 0, 0))

    def picture(self):
        return fc.Renderer(self.engine).render(self.scene, self.view)

    def test_fit_into_a_cube_of_one_metre(self):
        self.scene.add(self.model, fit=True)
        low, high = self.scene.bounds
        self.assertAlmostEqual((high - low).max(), 1, places=5)
        np.testing.assert_allclose(low + high, 0, atol=1e-5)

    def test_move_with_their_animation(self):
        copy = self.scene.add(self.model, fit=True)
        self.assertTrue(self.model.animations)
        name, seconds = self.model.animations[0]
        copy.animate(0, 0)
        first = self.picture()
        copy.animate(name or 0, seconds * 0.3)
        self.assertFalse(fc.compare(first, self.picture()).identical)
        copy.animate(0, 0)
        self.assertTrue(fc.compare(first, self.picture()).identical)
        self.assertRaises(fc.InvalidArgumentError, copy.animate, len(self.model.animations), 0)
        self.assertRaises(fc.NotFoundError, copy.animate, "no such animation", 0)

    def test_change_their_materials_one_copy_at_a_time(self):
        copy = self.scene.add(self.model, fit=True)
        first = self.picture()
        for name in copy.materials:
            self.assertIn("baseColorFactor", [p["name"] for p in copy.parameters(name)])
            copy.set(name, "baseColorFactor", (0, 0, 1, 1))
        blue = self.picture()
        self.assertFalse(fc.compare(first, blue).identical)
        copy.remove()
        self.scene.add(self.model, fit=True)
        self.assertTrue(fc.compare(first, self.picture()).identical)

    def test_name_what_they_do_not_have(self):
        copy = self.scene.add(self.model)
        self.assertRaises(fc.NotFoundError, copy.set, "no such material", "baseColorFactor", (0, 0, 1, 1))
        self.assertRaises(fc.NotFoundError, copy.set, copy.materials[0], "baseColour", (0, 0, 1, 1))
        self.assertRaises(fc.NotFoundError, copy.use_camera, self.view, "no such camera")
        self.assertRaises(fc.InvalidArgumentError, copy.set_variant, "no such variant")


if __name__ == "__main__":
    unittest.main()
