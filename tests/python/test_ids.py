# SPDX-License-Identifier: Apache-2.0
"""What the numbers in images of ids name: the objects of the program, materials, and triangles of meshes."""
from support import BACKENDS, WINDMILL, fc, flat_view, np, placed, quad, unittest, unlit

HALF = 32  # of the images' sides: squares left and right of it


class Ids(unittest.TestCase):
    """A square on the left and one on the right, which end at the middle of the image."""

    def setUp(self):
        self.engine = fc.Engine("gles")
        self.addCleanup(self.engine.close)
        self.scene = fc.Scene(self.engine)
        self.red = self.engine.built_in_material("unlit").instance("red")
        self.blue = self.engine.built_in_material("lit").instance("blue")
        self.mesh = quad(self.engine)
        self.left = self.scene.add_mesh(self.mesh, self.red, transform=placed(x=-1), name="left")
        self.right = self.scene.add_mesh(self.mesh, self.blue, transform=placed(x=1), name="right")

    def numbers(self, *names, scene=None, engine=None):
        return fc.render_aovs(engine or self.engine, scene or self.scene, flat_view(), names)

    def test_of_objects_name_the_shapes_of_the_program(self):
        image = self.numbers("objectId")["objectId"]
        found = self.scene.identify(image)
        self.assertEqual(sorted(found), sorted({int(image[0, 0, 0]), int(image[0, -1, 0])}))
        at_left = found[int(image[0, 0, 0])]
        self.assertIs(at_left.part, self.left)
        self.assertIs(at_left.part.mesh, self.mesh)
        self.assertEqual((at_left.name, at_left.material, at_left.material_instance, at_left.is_light, at_left.primitive),
                         ("left", "unlit", "red", False, 0))
        self.assertIs(self.scene.object_of(int(image[0, -1, 0])).part, self.right)
        self.assertIsNone(self.scene.object_of(0))
        self.assertIsNone(self.scene.object_of(1000))

    def test_masks_are_where_a_part_is(self):
        image = self.numbers("objectId")["objectId"]
        expected = np.broadcast_to(np.arange(64) < HALF, (64, 64))
        for part in (self.left, "left", self.scene.identify(image)[int(image[0, 0, 0])].id):
            mask = self.scene.mask(image, part)
            self.assertEqual((mask.dtype, mask.shape), (np.dtype(bool), (64, 64)))
            self.assertTrue((mask == expected).all())
        self.assertTrue((self.scene.mask(image[..., 0], self.right) == ~expected).all())  # whole numbers do, too
        self.assertFalse(self.scene.mask(image, "nothing").any())

    def test_of_materials_name_the_instances_of_the_program(self):
        numbers = self.numbers("materialId", "materialInstanceId")
        found = self.scene.identify(numbers["materialInstanceId"], aov="materialInstanceId")
        self.assertEqual({one.name: one.material for one in found.values()}, {"red": "unlit", "blue": "lit"})
        self.assertIs(found[int(numbers["materialInstanceId"][0, 0, 0])].part, self.red)
        self.assertTrue(self.scene.mask(numbers["materialInstanceId"], self.blue, aov="materialInstanceId")[:, HALF:].all())
        names = {one.name for one in self.scene.identify(numbers["materialId"], aov="materialId").values()}
        self.assertEqual(names, {"unlit", "lit"})
        self.assertEqual(self.scene.material_of(int(numbers["materialId"][0, 0, 0])).name, "unlit")
        self.assertIsNone(self.scene.material_instance_of(3))

    def test_of_triangles_are_rows_of_the_mesh(self):
        triangle = self.numbers("triangleId")["triangleId"]
        self.assertTrue((triangle[..., 3] == 1).all())
        corners = self.mesh.positions[self.mesh.triangles[triangle[..., 0].astype(int)]]  # (64, 64, 3, 3)
        x = (np.arange(HALF) + 0.5) / HALF - 1  # of pixel centres, from the middle of the square on the right
        y = (HALF - 0.5 - np.arange(64)) / HALF
        place = np.stack(np.broadcast_arrays(x[None, :], y[:, None]), -1)
        a, b, c = (corners[:, HALF:, i, :2] for i in range(3))

        def side(p, q):
            return (q - p)[..., 0] * (place - p)[..., 1] - (q - p)[..., 1] * (place - p)[..., 0]

        self.assertTrue((np.minimum(np.minimum(side(a, b), side(b, c)), side(c, a)) >= -1e-5).all())

    def test_follow_what_is_removed_and_what_the_program_holds(self):
        image = self.numbers("objectId")["objectId"]
        number = int(image[0, -1, 0])
        self.right = None
        self.assertIsNone(self.scene.object_of(number).part)
        self.left.remove()
        self.assertIsNone(self.scene.object_of(int(image[0, 0, 0])))
        self.assertFalse(self.scene.mask(image, self.left).any())
        again = self.scene.add_mesh(self.mesh, self.blue, name="again")
        self.assertIs(self.scene.object_of(int(self.numbers("objectId")["objectId"][32, 31, 0])).part, again)

    def test_of_models_name_copies_and_nodes(self):
        scene = fc.Scene(self.engine)
        model = self.engine.load_model(WINDMILL)
        copies = [scene.add(model, fit=True, transform=placed(x=x)) for x in (-0.6, 0.6)]
        image = self.numbers("objectId", scene=scene)["objectId"]
        found = scene.identify(image).values()
        self.assertEqual({id(one.part) for one in found}, {id(copy) for copy in copies})
        self.assertTrue(all(one.name and one.material_instance for one in found))
        first, second = (scene.mask(image, copy) for copy in copies)
        self.assertTrue(first.any() and second.any() and not (first & second).any())
        self.assertTrue(((first | second) == (image[..., 3] == 1)).all())
        self.assertLess(np.nonzero(first)[1].mean(), HALF)

    def test_are_the_same_on_both_apis(self):
        seen = []
        for backend in BACKENDS:
            with fc.Engine(backend) as engine:
                scene = fc.Scene(engine)
                scene.add_mesh(quad(engine), unlit(engine, (1, 1, 1)), name="square")
                image = self.numbers("objectId", scene=scene, engine=engine)["objectId"]
                seen.append({number: one.name for number, one in scene.identify(image).items()})
        self.assertEqual(seen[0], seen[1])

    def test_that_are_none_are_errors(self):
        image = np.ones((2, 2), int)
        for words, call in (("aov: 'depth'", lambda: self.scene.identify(image, aov="depth")),
                            ("3.5 is no id", lambda: self.scene.identify(np.full((2, 2), 3.5))),
                            ("-1 is no id", lambda: self.scene.identify(-image)),
                            ("shape (height, width, 4)", lambda: self.scene.identify(np.zeros((2, 2, 3)))),
                            ("no array of numbers", lambda: self.scene.identify("image")),
                            ("a MaterialInstance", lambda: self.scene.mask(image, self.left, aov="materialInstanceId")),
                            ("a Shape, a ModelCopy", lambda: self.scene.mask(image, self.red)),
                            ("id: -1", lambda: self.scene.object_of(-1))):
            with self.assertRaises(fc.InvalidArgumentError) as caught:
                call()
            self.assertIn(words, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
