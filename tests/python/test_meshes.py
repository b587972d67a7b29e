# SPDX-License-Identifier: Apache-2.0
"""Meshes whose arrays change: what is drawn is what a new mesh of these arrays shows, bit for bit."""
from support import BACKENDS, QUAD, QUAD_TRIANGLES, QUAD_UV, fc, flat_view, np, quad, unittest, unlit

SIDE = 9
X, Y = np.meshgrid(np.linspace(-1, 1, SIDE), np.linspace(-1, 1, SIDE))
GRID_UV = np.stack([X, Y], -1).reshape(-1, 2) / 2 + 0.5
CELLS = (np.arange(SIDE - 1)[:, None] * SIDE + np.arange(SIDE - 1)).reshape(-1, 1)
GRID_TRIANGLES = np.concatenate([CELLS + [0, 1, SIDE + 1], CELLS + [0, SIDE + 1, SIDE]])


def wave(seconds):
    return np.stack([X, Y, 0.3 * np.sin(4 * X + seconds)], -1).reshape(-1, 3)


class ChangingMeshes(unittest.TestCase):
    def lit_view(self, engine, mesh):
        scene = fc.Scene(engine)
        material = engine.built_in_material("lit").instance()
        material.set("baseColor", (0.8, 0.5, 0.2))
        material.set("roughness", 0.4)
        scene.add_mesh(mesh, material)
        scene.add_sun((1, -0.5, -1))
        view = flat_view()
        return lambda renderer: renderer.render(scene, view, output="light")

    def test_have_the_bits_of_new_ones(self):
        pictures = []
        for backend in BACKENDS:
            with fc.Engine(backend) as engine:
                renderer = fc.Renderer(engine)
                mesh = engine.mesh(wave(0), GRID_TRIANGLES, uv=GRID_UV)
                draw = self.lit_view(engine, mesh)
                before = draw(renderer)
                for seconds in (0.5, 1.0):
                    mesh.update(wave(seconds))
                    changed = draw(renderer)
                    new = engine.mesh(wave(seconds), GRID_TRIANGLES, uv=GRID_UV)
                    self.assertTrue(fc.compare(self.lit_view(engine, new)(renderer), changed).identical)
                    np.testing.assert_array_equal(mesh.normals, new.normals)
                self.assertFalse(fc.compare(before, changed).identical)
                mesh.update(wave(0))
                self.assertTrue(fc.compare(before, draw(renderer)).identical)
                pictures.append(changed)
        self.assertTrue(fc.compare(*pictures).identical)

    def test_move_colour_and_bound_what_they_say(self):
        with fc.Engine("gles") as engine:
            scene = fc.Scene(engine)
            mesh = engine.mesh(QUAD, QUAD_TRIANGLES, colors=np.ones((4, 4)))
            scene.add_mesh(mesh, engine.built_in_material("vertexColors").instance())
            renderer, view = fc.Renderer(engine), flat_view()
            mesh.update(QUAD * [0.5, 1, 1], colors=np.tile([0.25, 0.5, 0.75, 1], (4, 1)))
            picture = renderer.render(scene, view, output="light")
            inside = np.broadcast_to((np.arange(64) >= 16) & (np.arange(64) < 48), (64, 64))
            self.assertTrue((picture[inside][:, :3] == (0.25, 0.5, 0.75)).all())
            self.assertTrue((picture[~inside][:, :3] == 0).all())
            np.testing.assert_array_equal(scene.bounds, [[-0.5, -1, 0], [0.5, 1, 0]])
            mesh.update(QUAD + [100, 0, 0])  # out of view
            self.assertEqual(renderer.render(scene, view, output="light")[..., 0].max(), 0)
            np.testing.assert_array_equal(mesh.positions, (QUAD + [100, 0, 0]).astype(np.float32))

    def test_keep_the_normals_that_were_given(self):
        with fc.Engine("null") as engine:
            tilted = np.tile([0.6, 0, 0.8], (4, 1))
            mesh = engine.mesh(QUAD, QUAD_TRIANGLES, normals=tilted)
            mesh.update(QUAD[:, [0, 2, 1]])
            np.testing.assert_allclose(mesh.normals, tilted, rtol=1e-6)
            mesh.update(normals=[[0, 0, 1]] * 4)
            self.assertEqual(mesh.normals.tolist(), [[0, 0, 1]] * 4)
            plain = quad(engine)
            plain.update(QUAD[:, [2, 0, 1]])  # in x = 0 now
            np.testing.assert_allclose(plain.normals, [[1, 0, 0]] * 4, atol=1e-6)

    def test_of_mirrored_textures_keep_their_vertices(self):
        with fc.Engine("gles") as engine:
            places = np.array([[-1, -1, 0], [0, -1, 0], [1, -1, 0], [-1, 1, 0], [0, 1, 0], [1, 1, 0]], float)
            uv = [[0, 0], [1, 0], [0, 0], [0, 1], [1, 1], [0, 1]]  # mirrored at x = 0
            triangles = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]]
            mesh = engine.mesh(places, triangles, uv=uv)
            self.assertEqual((mesh.vertex_count, mesh.positions.shape, mesh.triangles.tolist()), (8, (6, 3), triangles))
            mesh.update(places * 0.5)
            self.assertEqual(mesh.vertex_count, 8)
            scene = fc.Scene(engine)
            scene.add_mesh(mesh, unlit(engine, (1, 1, 1)))
            picture = fc.Renderer(engine).render(scene, flat_view(), output="light")[..., 0]
            self.assertEqual((picture == 1).sum(), 32 * 32)
            mesh.update(np.zeros((6, 3)))  # no area left: nothing is drawn, and nothing breaks
            self.assertEqual(fc.Renderer(engine).render(scene, flat_view(), output="light")[..., 0].max(), 0)
            mesh.update(places, uv=[[0, 0]] * 6)
            self.assertEqual((fc.Renderer(engine).render(scene, flat_view(), output="light")[..., 0] == 1).sum(), 64 * 64)

    def test_of_shapes_can_be_bent(self):
        with fc.Engine("null") as engine:
            ball = engine.sphere(0.5, 8, 4)
            ball.update(ball.positions * [1, 2, 1], normals=ball.normals)
            self.assertAlmostEqual(float(np.abs(ball.positions[:, 1]).max()), 1, places=6)

    def test_say_what_does_not_fit(self):
        with fc.Engine("null") as engine:
            mesh = quad(engine)
            kept = mesh.positions
            for words, arguments in (("positions: 3 rows, but there are 4 vertices", {"positions": QUAD[:3]}),
                                     ("positions: not an array of fewer than 2^24 rows of 3", {"positions": QUAD[:, :2]}),
                                     ("uv: not an array", {"uv": QUAD}),
                                     ("uv: 5 rows", {"positions": QUAD, "uv": np.zeros((5, 2))}),
                                     ("colors: not an array", {"colors": QUAD}),
                                     ("normals: 0 rows", {"normals": np.zeros((0, 3))}),
                                     ("positions: nan", {"positions": QUAD * np.nan}),
                                     ("update(): give", {})):
                with self.assertRaises(fc.InvalidArgumentError) as caught:
                    mesh.update(**arguments)
                self.assertIn(words, str(caught.exception))
            np.testing.assert_array_equal(mesh.positions, kept)


if __name__ == "__main__":
    unittest.main()
