#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes lightmap_pages.gltf for scenes/lightmap-pages.json: a long floor and a wall, each with a page of baked light.

Each page (FILAMENT_lightmap, docs/baking.md) has four levels, which are not all that it could have, and stripes of light whose
means the smaller levels hold: from afar, the floor is grey.
"""
import json
import pathlib
import struct
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from gltf_buffer import add_view, buffers, accessors, views
from lightmap import LUX, square

FOLDER = pathlib.Path(__file__).resolve().parent
SIDE, LEVELS = 32, 4


def page(index):
    """Rows of texels of the first level."""
    def texel(x, y):
        if index == 0:
            glow = 6.0 if (x // 2 + y // 2) % 2 == 0 else 0.25
            return (glow, 0.8 * glow, 0.5 * glow, 0.9 if x % 8 < 4 else 0.1)
        glow = 4.0 if y % 4 < 2 else 0.5
        return (0.3 * glow, 0.5 * glow + x / SIDE, glow, 0.6)
    return [[texel(x, y) for x in range(SIDE)] for y in range(SIDE)]


def halved(rows):
    mean = lambda *texels: tuple(sum(channel) / 4 for channel in zip(*texels))
    return [[mean(rows[y][x], rows[y][x + 1], rows[y + 1][x], rows[y + 1][x + 1]) for x in range(0, len(rows), 2)]
            for y in range(0, len(rows), 2)]


def ktx2(rows):
    """RGBA16F. KTX File Format Specification 2.0; Khronos Data Format Specification 1.3, chapter 5."""
    levels = []
    for _ in range(LEVELS):
        levels.append(b"".join(struct.pack("<4e", *texel) for row in rows for texel in row))
        rows = halved(rows)
    samples = b"".join(struct.pack("<HBBIII", 16 * i, 15, channel | 0xC0, 0, 0xBF800000, 0x3F800000)
                       for i, channel in enumerate((0, 1, 2, 15)))
    description = struct.pack("<IIHHBBBB", 4 + 24 + 64, 0, 2, 24 + 64, 1, 1, 1, 0) + bytes(4) + bytes([8]) + bytes(7) + samples
    header = 80 + 24 * LEVELS
    at = -(-(header + len(description)) // 16) * 16
    places = {}
    for level in reversed(range(LEVELS)):  # the smallest one comes first
        places[level], at = at, at + len(levels[level])
    file = b"\xabKTX 20\xbb\r\n\x1a\n" + struct.pack("<9I", 97, 2, SIDE, SIDE, 0, 0, 1, LEVELS, 0)
    file += struct.pack("<4I2Q", header, len(description), 0, 0, 0, 0)
    for level in range(LEVELS):
        file += struct.pack("<3Q", places[level], len(levels[level]), len(levels[level]))
    file += description
    file += bytes(places[LEVELS - 1] - len(file))
    return file + b"".join(levels[level] for level in reversed(range(LEVELS)))


def main():
    inside = ((0.5 / SIDE, 0.5 / SIDE), ((SIDE - 0.5) / SIDE, (SIDE - 0.5) / SIDE))
    floor = square([(-1, 0, 1), (1, 0, 1), (1, 0, -7), (-1, 0, -7)], (0, 1, 0), inside, 1)
    wall = square([(-1, 0, 1), (-1, 0, -3), (-1, 1.2, -3), (-1, 1.2, 1)], (1, 0, 0), inside, 1)
    for index, primitive in enumerate((floor, wall)):
        primitive["material"] = index
    model = {
        "asset": {"version": "2.0", "generator": "lightmap_pages.py"},
        "extensionsUsed": ["FILAMENT_lightmap"],
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "corridor", "mesh": 0}],
        "meshes": [{"primitives": [floor, wall]}],
        "materials": [{
            "name": name,
            "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0, "roughnessFactor": 0.5},
            "extensions": {"FILAMENT_lightmap": {"lightmapTexture": {"index": index, "texCoord": 1}, "intensity": LUX}},
        } for index, name in enumerate(("floor", "wall"))],
        "textures": [{"sampler": 0, "extensions": {"FILAMENT_lightmap": {"source": index}}} for index in range(2)],
        "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 33071, "wrapT": 33071}],
        "images": [{"name": f"page {index}", "mimeType": "image/ktx2", "bufferView": add_view(ktx2(page(index)))}
                   for index in range(2)],
        "bufferViews": views,
        "accessors": accessors,
        "buffers": buffers(),
    }
    (FOLDER / "lightmap_pages.gltf").write_text(json.dumps(model, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    main()
