#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes lightmap.gltf for scenes/lightmaps.json: a floor, a wall and a strip of tiles with baked light.

The lightmap (FILAMENT_lightmap, docs/baking.md) has a chart for each, without a lamp that explains them: stripes of light,
colours that change from texel to texel, and places where the sky is hidden. The wall finds its chart by the third set of
texture coordinates and a transform; the tiles are glossy, and have a coat.
"""
import json
import math
import pathlib
import struct
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from gltf_buffer import add, add_view, accessors, buffers, views

FOLDER = pathlib.Path(__file__).resolve().parent
WIDTH, HEIGHT = 36, 16
LUX = 4096.0  # of a texel of 1


def texel(x, y):
    """Three charts of twelve columns: smooth, striped, and one with hidden sky."""
    chart, u, v = x // 12, (x % 12) / 11, y / (HEIGHT - 1)
    if chart == 0:
        glow = 6 * math.exp(-8 * ((u - 0.3) ** 2 + (v - 0.6) ** 2))
        return (1 + glow, 1 + 0.8 * glow, 1.2 + 0.4 * glow, 0.3 + 0.7 * u)
    if chart == 1:
        stripe = 4.0 if (x + y) % 4 < 2 else 0.5
        return (stripe, 0.25 * stripe + 2 * v, 3 * u, 0.8)
    return (2.5 * u, 2.5 * v, 2.0, 0.0 if u > 0.5 else 1.0)


def ktx2():
    """RGBA16F, one level. KTX File Format Specification 2.0; Khronos Data Format Specification 1.3, chapter 5."""
    level = b"".join(struct.pack("<4e", *texel(x, y)) for y in range(HEIGHT) for x in range(WIDTH))
    samples = b"".join(struct.pack("<HBBIII", 16 * i, 15, channel | 0xC0, 0, 0xBF800000, 0x3F800000)
                       for i, channel in enumerate((0, 1, 2, 15)))
    description = struct.pack("<IIHHBBBB", 4 + 24 + 64, 0, 2, 24 + 64, 1, 1, 1, 0) + bytes(4) + bytes([8]) + bytes(7) + samples
    header = 80 + 24
    at = -(-(header + len(description)) // 16) * 16
    file = b"\xabKTX 20\xbb\r\n\x1a\n" + struct.pack("<9I", 97, 2, WIDTH, HEIGHT, 0, 0, 1, 1, 0)
    file += struct.pack("<4I2Q", header, len(description), 0, 0, 0, 0)
    file += struct.pack("<3Q", at, len(level), len(level)) + description
    return file + bytes(at - len(file)) + level


def square(corners, normal, light, light_set):
    """A quad; `light`: low and high corner of its chart."""
    (u0, v0), (u1, v1) = light
    chart = [(u0, v1), (u1, v1), (u1, v0), (u0, v0)]
    plain = [(0, 1), (1, 1), (1, 0), (0, 0)]
    attributes = {"POSITION": add(corners), "NORMAL": add([normal] * 4)}
    for index in range(light_set + 1):
        attributes[f"TEXCOORD_{index}"] = add(chart if index == light_set else plain)
    accessors.append({"bufferView": add_view(struct.pack("<6H", 0, 1, 2, 0, 2, 3)), "componentType": 5123, "count": 6,
                      "type": "SCALAR"})
    return {"attributes": attributes, "indices": len(accessors) - 1}


def chart(index):
    """Of whole texels, half a texel inside."""
    return ((12 * index + 0.5) / WIDTH, 0.5 / HEIGHT), ((12 * index + 11.5) / WIDTH, (HEIGHT - 0.5) / HEIGHT)


def material(name, light_set, transform=None, **more):
    texture = {"index": 0, "texCoord": light_set}
    if transform:
        texture["extensions"] = {"KHR_texture_transform": transform}
    extensions = {"FILAMENT_lightmap": {"lightmapTexture": texture, "intensity": LUX}, **more.pop("extensions", {})}
    return {"name": name, "pbrMetallicRoughness": more, "extensions": extensions}


def main():
    floor = square([(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)], (0, 1, 0), chart(0), 1)
    # in the first chart's place, from which the transform moves it
    wall = square([(-1, 0, -1), (1, 0, -1), (1, 1.2, -1), (-1, 1.2, -1)], (0, 0, 1), chart(0), 2)
    tiles = square([(-0.9, 0.02, 0.9), (0.1, 0.02, 0.9), (0.1, 0.02, 0.1), (-0.9, 0.02, 0.1)], (0, 1, 0), chart(2), 1)
    lamp = square([(0.5, 0.01, 0.7), (0.9, 0.01, 0.7), (0.9, 0.01, 0.3), (0.5, 0.01, 0.3)], (0, 1, 0), chart(0), 1)
    primitives = [floor, wall, tiles, lamp]
    for index, primitive in enumerate(primitives):
        primitive["material"] = index
    model = {
        "asset": {"version": "2.0", "generator": "lightmap.py"},
        "extensionsUsed": ["FILAMENT_lightmap", "KHR_texture_transform", "KHR_materials_clearcoat"],
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "room", "mesh": 0}],
        "meshes": [{"primitives": primitives}],
        "materials": [
            material("floor", 1, baseColorFactor=[0.8, 0.8, 0.8, 1], metallicFactor=0, roughnessFactor=0.6),
            material("wall", 2, {"offset": [12 / WIDTH, 0]}, baseColorFactor=[0.9, 0.7, 0.5, 1], metallicFactor=0,
                     roughnessFactor=1),
            material("tiles", 1, baseColorFactor=[0.5, 0.5, 0.6, 1], metallicFactor=0.3, roughnessFactor=0.2,
                     extensions={"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.1}}),
            {"name": "unbaked", "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0}},
        ],
        "textures": [{"sampler": 0, "extensions": {"FILAMENT_lightmap": {"source": 0}}}],
        "samplers": [{"magFilter": 9729, "minFilter": 9729, "wrapS": 33071, "wrapT": 33071}],
        "images": [{"name": "lightmap", "mimeType": "image/ktx2", "bufferView": add_view(ktx2())}],
        "bufferViews": views,
        "accessors": accessors,
        "buffers": buffers(),
    }
    (FOLDER / "lightmap.gltf").write_text(json.dumps(model, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    main()
