# SPDX-License-Identifier: Apache-2.0
"""The code blocks of docs/python.md run as they are, one after the other, where the files that they name exist."""
import json
import os
import pathlib
import re
import shutil
import tempfile

from support import ROOT, WINDMILL, fc, np, unittest

MATERIAL = """
material {
    name : stone, shadingModel : lit, requires : [ uv0 ],
    constants : [ { type : float, name : scale, default : 1.0 } ],
    parameters : [ { type : float3, name : tint }, { type : sampler2d, name : normalMap } ]
}
fragment {
    void material(inout MaterialInputs material) {
        vec2 uv = getUV0() * materialConstants_scale;
        material.normal = texture(materialParams_normalMap, uv).xyz * 2.0 - 1.0;
        prepareMaterial(material);
        material.baseColor.rgb = materialParams.tint;
    }
}
"""
REPORT = {"build": "Release", "reference": "gles", "devices": {"gles": "llvmpipe"}, "summary": {"passed": 0, "failed": 1},
          "cases": [{"name": "b", "status": "failed", "reasons": ["12 pixels differ"], "hash": "13", "comparisons": []}]}


def blocks():
    text = (ROOT / "docs/python.md").read_text(encoding="utf-8")
    return re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL)


class Manual(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        for file in WINDMILL.parent.glob("windmill.*"):
            shutil.copy(file, folder.name)
        fc.save_picture("sky.exr", np.full((16, 32, 4), 0.5, np.float32))
        fc.save_picture("normal.png", np.full((4, 4, 4), (128, 128, 255, 255), np.uint8))
        pathlib.Path("stone.mat").write_text(MATERIAL, encoding="utf-8")
        pathlib.Path("report").mkdir()
        pathlib.Path("report/results.json").write_text(json.dumps(REPORT), encoding="utf-8")

    def test_every_block_runs(self):
        drawing, material, meshes, ids, report = blocks()
        names = {}
        exec(drawing, names)
        self.assertEqual(names["picture"].shape, (360, 640, 4))
        self.assertEqual(names["light"].dtype, np.float32)
        self.assertGreater(len(np.unique(names["picture"].reshape(-1, 4), axis=0)), 100)
        with fc.Engine("gles") as engine:
            names.update(engine=engine, scene=fc.Scene(engine))
            exec(material, names)
            names.update(np=np, renderer=fc.Renderer(engine))
            exec(meshes, names)
            exec(ids, names)
            self.assertTrue(names["shown"].any())
        exec(report, names)
        self.assertEqual(names["case"].name, "b")


if __name__ == "__main__":
    unittest.main()
