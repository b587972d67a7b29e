# SPDX-License-Identifier: Apache-2.0
"""Pictures have the values that follow from their definition, and the same bits on both APIs."""
import math
import pathlib
import tempfile

from support import BACKENDS, WINDMILL, fc, flat_view, np, placed, quad, unittest, unlit


def codes_of(linear):
    """IEC 61966-2-1, rounded to 8 bits."""
    encoded = np.where(linear <= 0.0031308, linear * 12.92, 1.055 * np.power(linear, 1 / 2.4) - 0.055)
    return np.round(np.clip(encoded, 0, 1) * 255).astype(np.uint8)


class ClosedForms(unittest.TestCase):
    def setUp(self):
        self.engine = fc.Engine("gles")
        self.addCleanup(self.engine.close)
        self.scene = fc.Scene(self.engine)
        self.renderer = fc.Renderer(self.engine)

    def test_light_is_what_an_unlit_material_says(self):
        self.scene.add_mesh(quad(self.engine), unlit(self.engine, (0.25, 0.5, 3)))
        picture = self.renderer.render(self.scene, flat_view(), output="light")
        self.assertEqual((picture.dtype, picture.shape), (np.float32, (64, 64, 4)))
        self.assertTrue((picture == np.array([0.25, 0.5, 3, 1], np.float32)).all())

    def test_display_values_are_codes_of_srgb(self):
        self.scene.add_mesh(quad(self.engine), unlit(self.engine, (0.25, 0.5, 3)))
        picture = self.renderer.render(self.scene, flat_view())
        self.assertEqual((picture.dtype, picture.shape), (np.uint8, (64, 64, 4)))
        self.assertEqual(picture[0, 0, :3].tolist(), codes_of(np.array([0.25, 0.5, 3])).tolist())
        self.assertTrue((picture == picture[0, 0]).all())

    def test_the_background_is_the_clear_color(self):
        view = flat_view(8, 4)
        view.clear_color = 0.5, 0.25, 0.125, 1
        picture = self.renderer.render(self.scene, view, output="light")
        self.assertEqual(picture.shape, (4, 8, 4))
        self.assertEqual(picture[3, 7, :3].tolist(), [0.5, 0.25, 0.125])

    def test_row_0_is_on_top_and_column_0_on_the_left(self):
        self.scene.add_mesh(quad(self.engine), unlit(self.engine, (1, 1, 1)), transform=placed(-0.5, 0.5, scale=0.5))
        picture = self.renderer.render(self.scene, flat_view(), output="light")[..., 0]
        expected = np.zeros((64, 64))
        expected[:32, :32] = 1
        self.assertTrue((picture == expected).all())

    def test_aovs_are_numbers_of_the_surface(self):
        self.scene.add_mesh(quad(self.engine), unlit(self.engine, (0.25, 0.5, 3)), transform=placed(scale=0.5))
        numbers = fc.render_aovs(self.engine, self.scene, flat_view(), ["depth", "position", "baseColor", "roughness"])
        self.assertEqual(list(numbers), ["depth", "position", "baseColor", "roughness"])
        self.assertEqual((numbers["depth"].dtype, numbers["depth"].shape), (np.float32, (64, 64, 4)))
        self.assertEqual(numbers["depth"][..., 3].sum(), 32 * 32)
        self.assertTrue((np.abs(numbers["depth"][16:48, 16:48, 0] - 5) < 1e-4).all())
        self.assertTrue((np.abs(numbers["position"][16, 16] - [-31 / 64, 31 / 64, -5, 1]) < 1e-4).all())
        self.assertEqual(numbers["baseColor"][32, 32].tolist(), [0.25, 0.5, 3, 1])
        self.assertEqual(numbers["roughness"][32, 32].tolist(), [0, 0, 0, 0.5])
        with self.assertRaisesRegex(fc.InvalidArgumentError, "names: 'beauty' is not depth, position"):
            fc.render_aovs(self.engine, self.scene, flat_view(), ["beauty"])

    def test_aovs_have_ids_of_objects_and_their_motion(self):
        square = quad(self.engine)
        self.scene.add_mesh(square, unlit(self.engine, (1, 1, 1)), transform=placed(-0.5, 0, scale=0.25))
        self.scene.add_mesh(square, unlit(self.engine, (0, 1, 1)), transform=placed(0.5, 0, scale=0.25))
        names = ["objectId", "materialInstanceId", "triangleId", "coverage", "motion"]
        renderer = fc.Renderer(self.engine)
        view = flat_view()
        for _ in range(2):
            numbers = fc.render_aovs(self.engine, self.scene, view, names, renderer=renderer)
        self.assertEqual([sorted(set(numbers[name][..., 0].flat)) for name in names],
                         [[0, 1, 2], [0, 1, 2], [0, 1], [0, 1], [0]])
        self.assertEqual(numbers["objectId"][32, 16].tolist(), [1, 0, 0, 1])
        self.assertEqual(numbers["coverage"][..., 0].sum(), 2 * 16 * 16)
        self.assertEqual(numbers["motion"][32, 48].tolist(), [0, 0, 0, 1])

    def test_shares_add_up_to_the_light(self):
        self.scene.add_mesh(self.engine.sphere(), self.engine.built_in_material("lit").instance(), name="ball")
        lamps = [self.scene.add_point_light((x, 0, 2), 2000) for x in (-0.5, 0.5)]
        self.scene.add_sun((0, 0, -1), 20000)
        view = flat_view(16, 16)
        view["vignette"] = True
        light = fc.Renderer(self.engine).render(self.scene, view, output="light")
        shares = fc.render_shares(self.engine, self.scene, view, terms="all", groups={"lamps": lamps})
        self.assertEqual(list(shares), ["emission", "lamps", "light2", "shadows", "refraction", "vignette"])
        self.assertEqual((shares["lamps"].dtype, shares["lamps"].shape), (np.float64, (16, 16, 4)))
        self.assertTrue((sum(shares.values()) == light).all())
        explained = fc.explain_pixel(self.engine, self.scene, view, 8, 9)
        self.assertEqual(explained["value"], light[9, 8].tolist())
        self.assertEqual(np.sum([term["value"] for term in explained["terms"]], axis=0).tolist(), explained["value"])
        self.assertEqual(explained["surface"]["material"], "lit")
        with self.assertRaisesRegex(fc.InvalidArgumentError, "pixel: 16, 0 is not in a view of 16 x 16"):
            fc.explain_pixel(self.engine, self.scene, view, 16, 0)

    def test_explained_pixels_have_the_texels_of_their_textures(self):
        codes = np.zeros((2, 2, 4), np.uint8)
        codes[0, 1] = 255, 0, 51, 255  # right of the middle and above it
        material = self.engine.built_in_material("unlitTextured").instance()
        material.set_texture("baseColorMap", self.engine.texture(codes, srgb=False, name="codes"), filter="nearest")
        self.scene.add_mesh(quad(self.engine), material)
        explained = fc.explain_pixel(self.engine, self.scene, flat_view(16, 16), 11, 3)
        none, texture = explained["textures"]
        self.assertEqual((none["name"], none["value"]), ("none", [1, 1, 1, 1]))
        self.assertEqual((texture["name"], texture["texture"], texture["size"]), ("baseColorMap", "codes", [2, 2]))
        np.testing.assert_allclose(texture["uv"], [11.5 / 16, 3.5 / 16], atol=1e-6)
        np.testing.assert_allclose(texture["texel"], [1, 0, 0.2], atol=1e-6)
        np.testing.assert_allclose(np.add(none["value"], texture["value"]), [1, 0, 0.2, 1], atol=1e-4)
        self.assertEqual(np.add(none["value"], texture["value"]).tolist(), explained["value"])

    def test_a_parallel_lens_shows_metres(self):
        self.scene.add_mesh(quad(self.engine), unlit(self.engine, (1, 1, 1)), transform=placed(scale=0.5))
        for metres, side in ((2, 32), (4, 16), (8, 8)):
            picture = self.renderer.render(self.scene, flat_view(metres=metres), output="light")
            self.assertEqual(int(picture[..., 0].sum()), side * side)

    def test_a_perspective_lens_shows_its_field_of_view(self):
        self.scene.add_mesh(quad(self.engine), unlit(self.engine, (1, 1, 1)))
        view = flat_view()
        view.look_at((0, 0, 4), (0, 0, 0), fov_degrees=math.degrees(2 * math.atan(0.5)))  # 4 metres high at 4 metres
        picture = self.renderer.render(self.scene, view, output="light")
        self.assertEqual(int(picture[..., 0].sum()), 32 * 32)

    def test_a_matte_surface_reflects_a_share_of_its_sun(self):
        matte = self.engine.built_in_material("lit").instance()
        matte.set("baseColor", (0.5, 0.25, 1))
        matte.set("roughness", 1)
        matte.set("reflectance", 0)
        self.scene.add_mesh(quad(self.engine), matte)
        slope = math.cos(math.radians(60))
        self.scene.add_sun((0, math.sin(math.radians(60)), -slope), 100_000, casts_shadows=False)
        view = flat_view()
        view.exposure(16, 1 / 125, 100)
        ev100 = math.log2(16 * 16 * 125)
        self.assertAlmostEqual(view.exposure_factor * 1.2 * 2 ** ev100, 1, places=5)
        picture = self.renderer.render(self.scene, view, output="light")
        lambert = np.array([0.5, 0.25, 1]) / math.pi * 100_000 * slope * view.exposure_factor
        np.testing.assert_allclose(picture[32, 32, :3], lambert, rtol=2e-3)

    def test_a_texture_is_shown_texel_by_texel(self):
        codes = np.random.default_rng(1).integers(0, 256, (16, 32, 4), dtype=np.uint8)
        codes[..., 3] = 255
        material = self.engine.built_in_material("unlitTextured").instance()
        material.set_texture("baseColorMap", self.engine.texture(codes), filter="nearest", wrap="clamp")
        self.scene.add_mesh(quad(self.engine), material, transform=np.diag([2.0, 1.0, 1.0, 1.0]))
        picture = self.renderer.render(self.scene, flat_view(32, 16))
        self.assertTrue(fc.compare(codes, picture).identical)

    def test_hidden_and_removed_shapes_are_not_drawn(self):
        shape = self.scene.add_mesh(quad(self.engine), unlit(self.engine, (1, 1, 1)))
        for change in (lambda: shape.set_visible(False), lambda: shape.set_transform(placed(x=10)), shape.remove):
            shape.set_visible(True)
            shape.set_transform(None)
            self.assertEqual(self.renderer.render(self.scene, flat_view(), output="light")[..., 0].min(), 1)
            change()
            self.assertEqual(self.renderer.render(self.scene, flat_view(), output="light")[..., 0].max(), 0)
        self.assertEqual(self.scene.counts["renderables"], 0)

    def test_pictures_are_arrays_of_their_own(self):
        self.scene.add_mesh(quad(self.engine), unlit(self.engine, (1, 1, 1)))
        first = self.renderer.render(self.scene, flat_view())
        kept = first.copy()
        second = self.renderer.render(self.scene, flat_view(metres=8))
        self.assertTrue((first == kept).all() and not (first == second).all())
        first[:] = 0  # writable
        self.assertTrue(first.flags.owndata or first.base is not None)


class EnvironmentLights(unittest.TestCase):
    def test_a_sun_becomes_a_light(self):
        with tempfile.TemporaryDirectory() as folder, fc.Engine("null") as engine:
            sky = np.full((32, 64, 3), 0.5, np.float32)
            sky[10, 20] = 2000
            path = pathlib.Path(folder) / "sky.exr"
            fc.save_picture(path, sky)
            kept = engine.load_environment(path, face_size=16, samples=16)
            self.assertEqual((kept.lights, kept.explanation), ([], ""))
            light, = engine.load_environment(path, face_size=16, samples=16, sun="extract").lights
            azimuth, polar = (0.5 - 20.5 / 64) * 2 * np.pi, 10.5 / 32 * np.pi
            np.testing.assert_allclose(light["direction"], (np.sin(azimuth) * np.sin(polar), np.cos(polar),
                                                            np.cos(azimuth) * np.sin(polar)), atol=1e-3)
            self.assertTrue(0.9 < light["share"] < 1)
            with self.assertRaises(fc.InvalidArgumentError):
                engine.load_environment(path, sun="moon")


class Skies(unittest.TestCase):
    def test_the_sun_of_a_sky_is_a_light_where_it_was_asked_for(self):
        with fc.Engine("null") as engine:
            sky = engine.load_sky((0, 3, 4), turbidity=3, height=32, face_size=16, samples=16)
            light, = sky.lights
            np.testing.assert_allclose(light["direction"], (0, 0.6, 0.8), atol=1e-4)
            self.assertTrue(60 < sum(light["illuminance"]) / 3 < 100)  # klx
            fc.Scene(engine).set_environment(sky, illuminance=1000)
            self.assertEqual(engine.load_sky((0, -0.1, 1), height=32, face_size=16, samples=16).lights, [])  # it has set

    def test_haze_takes_light_of_the_sun(self):
        with fc.Engine("null") as engine:
            clear, hazy = (engine.load_sky((0, 1, 1), turbidity=turbidity, height=32, face_size=16, samples=16).lights[0]
                           for turbidity in (2, 8))
            self.assertTrue(all(h < c for h, c in zip(hazy["illuminance"], clear["illuminance"])))

    def test_what_is_out_of_range_is_named(self):
        with fc.Engine("null") as engine:
            for wrong in ({"turbidity": 11}, {"altitude": -1}, {"height": 15}, {"ground_albedo": (2, 0, 0)},
                          {"face_size": 17}, {"direction_to_sun": (0, 0, 0)}, {"turbidity": float("nan")}):
                with self.assertRaises(fc.InvalidArgumentError, msg=wrong):
                    engine.load_sky(**wrong)


class Surroundings(unittest.TestCase):
    def setUp(self):
        self.engine = fc.Engine("gles")
        self.addCleanup(self.engine.close)
        self.scene = fc.Scene(self.engine)

    def test_a_mirror_shows_what_a_probe_captured(self):
        walls = unlit(self.engine, (0.25, 0.5, 3))
        walls.set_double_sided(True)
        room = self.scene.add_mesh(self.engine.box((4, 4, 4)), walls)
        probe = self.scene.add_reflection_probe((0, 0, 0), (2, 2, 2), face_size=16, name="room")
        room.remove()
        mirror = self.engine.built_in_material("lit").instance()
        mirror.set("metallic", 1.0)
        mirror.set("roughness", 0.3)
        mirror.set("baseColor", (1, 1, 1))
        self.scene.add_mesh(quad(self.engine), mirror)
        renderer = fc.Renderer(self.engine)
        picture = renderer.render(self.scene, flat_view(), output="light")
        np.testing.assert_allclose(picture[32, 32, :3], (0.25, 0.5, 3), rtol=0.02)
        self.assertIn("room", renderer.explain())
        probe.remove()
        self.assertEqual(renderer.render(self.scene, flat_view(), output="light")[32, 32, :3].tolist(), [0, 0, 0])
        with self.assertRaises(fc.ClosedError):
            probe.remove()
        for wrong in ({"half_extent": (1, 0, 1)}, {"half_extent": (1, 1, 1), "capture": (0, 2, 0)},
                      {"half_extent": (1, 1, 1), "face_size": 8}):
            with self.assertRaises(fc.InvalidArgumentError):
                self.scene.add_reflection_probe((0, 0, 0), **wrong)

    def test_the_background_lies_on_the_ground(self):
        with tempfile.TemporaryDirectory() as folder:
            sky = np.full((64, 128, 3), 1, np.float32)
            sky[32:] = 0.25  # below the horizon
            fc.save_picture(pathlib.Path(folder) / "sky.exr", sky)
            light = self.engine.load_environment(pathlib.Path(folder) / "sky.exr", face_size=64, samples=16)
        view = fc.View((64, 64))
        view.look_at((0, 1, 0), (0, 1, -1), fov_degrees=90)
        lower = []
        for height in (0, 1):
            # The level line of sight ends on the dome, 5 m away: 1 m above the ground, as the panorama was taken.
            self.scene.set_environment(light, ground_height=height, ground_level=0, ground_radius=5)
            picture = fc.Renderer(self.engine).render(self.scene, view, output="light")[..., 0]
            lower.append(float((picture[:, 32] < 0.5 * picture.max()).mean()))
        self.assertAlmostEqual(lower[0], 0.5, delta=0.05)
        self.assertAlmostEqual(lower[1], 0.5, delta=0.05)
        view.look_at((0, 3, 0), (0, 3, -1), fov_degrees=90)
        picture = fc.Renderer(self.engine).render(self.scene, view, output="light")[..., 0]
        # From 3 m the edge of the ground, 5 m away, is atan(3 / 5) below the level.
        share = float((picture[:, 32] < 0.5 * picture.max()).mean())
        self.assertLess(share, 0.4)


class BothApis(unittest.TestCase):
    """One scene, one view: what Vulkan and OpenGL ES draw."""

    def picture(self, backend, output, change=lambda view: None, roughness=0.3):
        with tempfile.TemporaryDirectory() as folder, fc.Engine(backend) as engine:
            height, width = np.mgrid[0:32, 0:64]
            sky = np.dstack([height / 8.0, width / 40.0, np.full(height.shape, 0.7)]).astype(np.float32)
            fc.save_picture(pathlib.Path(folder) / "sky.exr", sky)
            scene = fc.Scene(engine)
            scene.set_environment(engine.load_environment(pathlib.Path(folder) / "sky.exr", face_size=16, samples=16))
            lit = engine.built_in_material("lit").instance()
            lit.set("baseColor", (0.9, 0.4, 0.1))
            lit.set("roughness", roughness)
            scene.add_mesh(engine.sphere(0.5), lit, transform=placed(y=0.5))
            scene.add_mesh(engine.plane(4, 4), lit)
            scene.add(engine.load_model(WINDMILL), fit=True, transform=placed(x=-0.8, y=0.5))
            scene.add_sun((-1, -2, -1), 50_000)
            scene.add_spot_light((1, 2, 1), (-1, -2, -1), 5000, outer_degrees=30)
            scene.add_point_light((0.5, 0.3, 0.8), 200, range=3)
            view = fc.View((160, 90))
            view.look_at((0.9, 1.1, 2.4), (0, 0.3, 0))
            change(view)
            return fc.Renderer(engine).render(scene, view, output=output, frames=3)

    def test_have_the_same_bits(self):
        def effects(view):
            view["ambientOcclusion"] = True
            view["bloom"] = True
            view["antiAliasing"] = "taa"
            view["fog.density"] = 0.02
            view["fog"] = True

        for output in ("display", "light"):
            pictures = [self.picture(backend, output, effects) for backend in BACKENDS]
            self.assertTrue(fc.compare(*pictures).identical, fc.compare(*pictures))
            self.assertGreater(pictures[0][..., :3].std(), 0.01)

    def test_options_change_the_picture(self):
        plain = self.picture("gles", "light")
        for name, value in (("ambientOcclusion", True), ("shadows", "off"), ("specularVisibility", "uncorrelated")):
            changed = self.picture("gles", "light", lambda view, name=name, value=value: view.set(name, value))
            self.assertFalse(fc.compare(plain, changed).identical, name)
        self.assertFalse(fc.compare(plain, self.picture("gles", "light", roughness=0.31)).identical)
        self.assertTrue(fc.compare(plain, self.picture("gles", "light")).identical)


class Timings(unittest.TestCase):
    def drawn(self, backend, **options):
        engine = fc.Engine(backend)
        self.addCleanup(engine.close)
        scene = fc.Scene(engine)
        scene.add_mesh(engine.sphere(0.5), engine.built_in_material("unlit").instance())
        view = flat_view(64, 48)
        view["bloom"] = True
        renderer = fc.Renderer(engine, **options)
        renderer.render(scene, view, frames=3)
        return renderer.take_timings()

    def test_of_passes_sum_up_to_that_of_the_frame(self):
        for backend in BACKENDS:
            frames = self.drawn(backend, pass_timers=True)
            self.assertEqual(len(frames), 3)
            for frame in frames:
                self.assertIn("bloom down", frame["passes"])  # several passes have this name
                self.assertAlmostEqual(sum(frame["passes"].values()), frame["gpu_milliseconds"], places=6)
                self.assertGreater(frame["gpu_milliseconds"], 0)

    def test_without_timers_have_none_of_the_device(self):
        for backend in BACKENDS:
            for frame in self.drawn(backend):
                self.assertEqual((frame["passes"], frame["gpu_milliseconds"]), ({}, 0))


if __name__ == "__main__":
    unittest.main()
