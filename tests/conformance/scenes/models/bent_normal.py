#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes bent_normal.gltf for scenes/bent-normals.json: surfaces whose occlusion texture has bent normals
(FILAMENT_bent_normal, docs/baking.md), in charts that are turned and mirrored on them.
"""
import json
import math
import pathlib
import struct
import sys
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from gltf_buffer import add, add_view, accessors, buffers, views

FOLDER = pathlib.Path(__file__).resolve().parent
SIDE = 16


def occlusion(x, y):
    """Visible part; mean open direction along u and against v: away from the middle, more and more."""
    u, v = (x + 0.5) / SIDE * 2 - 1, (y + 0.5) / SIDE * 2 - 1
    visible = 0.35 + 0.3 * math.hypot(u, v)
    return round(255 * min(visible, 1)), 128 + round(127 * 0.6 * u), 128 - round(127 * 0.6 * v)


def bumps(x, y):
    return 128 + (40 if x % 8 < 4 else -40), 128 + (40 if y % 8 < 4 else -40), 230


def png(code):
    rows = b"".join(b"\0" + bytes(c for x in range(SIDE) for c in code(x, y)) for y in range(SIDE))
    head = struct.pack(">IIBBBBB", SIDE, SIDE, 8, 2, 0, 0, 0)
    parts = ((b"IHDR", head), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(d)) + n + d + struct.pack(">I", zlib.crc32(n + d)) for n, d in parts)


def square(corners, normal, chart, material):
    attributes = {"POSITION": add(corners), "NORMAL": add([normal] * 4),
                  "TEXCOORD_0": add([(0, 1), (1, 1), (1, 0), (0, 0)]), "TEXCOORD_1": add(chart)}
    accessors.append({"bufferView": add_view(struct.pack("<6H", 0, 1, 2, 0, 2, 3)), "componentType": 5123, "count": 6,
                      "type": "SCALAR"})
    return {"attributes": attributes, "indices": len(accessors) - 1, "material": material}


def material(name, bent=True, strength=1, transform=None, extensions=None, **more):
    texture = {"index": 0, "texCoord": 1, "strength": strength}
    if transform:
        texture["extensions"] = {"KHR_texture_transform": transform}
    result = {"name": name, "doubleSided": True, "occlusionTexture": texture, "extensions": dict(extensions or {})}
    if bent:
        result["extensions"]["FILAMENT_bent_normal"] = {}
    if "normalTexture" in more:
        result["normalTexture"] = more.pop("normalTexture")
    result["pbrMetallicRoughness"] = {"metallicFactor": 0, "roughnessFactor": 0.8, **more}
    if not result["extensions"]:
        del result["extensions"]
    return result


def main():
    upright = [(0, 1), (1, 1), (1, 0), (0, 0)]
    turned = [(1, 1), (1, 0), (0, 0), (0, 1)]
    mirrored = [(1, 1), (0, 1), (0, 0), (1, 0)]

    def floor(x, z, chart, index):
        return square([(x, 0, z + 0.9), (x + 0.9, 0, z + 0.9), (x + 0.9, 0, z), (x, 0, z)], (0, 1, 0), chart, index)

    def wall(x, chart, index, toward=1):
        low, high = (x, x + 0.9) if toward > 0 else (x + 0.9, x)
        return square([(low, 0.1, -1), (high, 0.1, -1), (high, 1, -1), (low, 1, -1)], (0, 0, toward), chart, index)

    primitives = [floor(-1.45, 0, upright, 0), floor(-0.45, 0, turned, 0), floor(0.55, 0, mirrored, 0),
                  floor(-1.45, -0.95, upright, 1), floor(-0.45, -0.95, upright, 2), floor(0.55, -0.95, upright, 3),
                  wall(-1.45, upright, 4), wall(-0.45, mirrored, 0, -1), wall(0.55, turned, 5)]
    model = {
        "asset": {"version": "2.0", "generator": "bent_normal.py"},
        "extensionsUsed": ["FILAMENT_bent_normal", "KHR_texture_transform", "KHR_materials_clearcoat",
                           "KHR_materials_pbrSpecularGlossiness"],
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "squares", "mesh": 0}],
        "meshes": [{"primitives": primitives}],
        "materials": [
            material("plain"),
            material("not bent", bent=False),
            material("bumps", normalTexture={"index": 1}),
            material("a turned texture", transform={"rotation": 0.6, "offset": [0.1, 0.5]}),
            material("coat", extensions={"KHR_materials_clearcoat": {"clearcoatFactor": 1}}, strength=0.5),
            {**material("specular", extensions={"KHR_materials_pbrSpecularGlossiness": {
                "diffuseFactor": [0.8, 0.6, 0.4, 1], "glossinessFactor": 0.3}})},
        ],
        "textures": [{"sampler": 0, "source": 0}, {"sampler": 0, "source": 1}],
        "samplers": [{"magFilter": 9729, "minFilter": 9729, "wrapS": 33071, "wrapT": 33071}],
        "images": [{"name": "occlusion", "mimeType": "image/png", "bufferView": add_view(png(occlusion))},
                   {"name": "bumps", "mimeType": "image/png", "bufferView": add_view(png(bumps))}],
        "bufferViews": views,
        "accessors": accessors,
        "buffers": buffers(),
    }
    (FOLDER / "bent_normal.gltf").write_text(json.dumps(model, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    main()
