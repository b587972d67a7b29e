#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes points.gltf beside this file: balls of points and rings of lines. On the left they have no normals: base colour
and emission without light. In the middle they have normals, and a normal map that nothing can turn. On the right they
have tangents, too."""
import json
import math
import pathlib
import struct

from gltf_buffer import accessors, add, add_view, buffers, views

POINTS, LINES = 0, 1  # modes of primitives
MAP = ("iVBORw0KGgoAAAANSUhEUgAAAAQAAAAECAYAAACp8Z5+AAAAP0lEQVR42iWKIRaAMBTD/sF6kn8a5CRyEomcRE72VqE8REWSFjpon9kFWlR7gCet"
       "O/Kh+KpSvSJ2HpqBvyLzAu/9LYz/yFTBAAAAAElFTkSuQmCC")


def sphere(count):
    """Directions along a spiral from pole to pole."""
    golden = math.pi * (3 - math.sqrt(5))
    for i in range(count):
        y = 1 - 2 * (i + 0.5) / count
        r = math.sqrt(1 - y * y)
        yield (r * math.cos(golden * i), y, r * math.sin(golden * i))


RINGS, CORNERS = 11, 48


def rings():
    """Corners of circles of latitude."""
    for ring in range(RINGS):
        polar = (ring + 1) * math.pi / (RINGS + 1)
        for corner in range(CORNERS):
            turn = corner * 2 * math.pi / CORNERS
            yield (math.sin(polar) * math.cos(turn), math.cos(polar), math.sin(polar) * math.sin(turn))


def ring_lines():
    """Indices of neighbours on the same ring."""
    pairs = [(ring * CORNERS + i, ring * CORNERS + (i + 1) % CORNERS) for ring in range(RINGS) for i in range(CORNERS)]
    accessors.append({"bufferView": add_view(b"".join(struct.pack("<2H", *pair) for pair in pairs)), "componentType": 5123,
                      "count": 2 * len(pairs), "type": "SCALAR"})
    return len(accessors) - 1


def tangent(n):
    length = math.hypot(n[0], n[2])
    return (n[2] / length, 0, -n[0] / length, 1)


meshes, nodes = [], []
for row, (mode, directions) in enumerate([(POINTS, list(sphere(900))), (LINES, list(rings()))]):
    attributes = {"POSITION": add([tuple(0.4 * c for c in n) for n in directions]),
                  "TEXCOORD_0": add([(0.5 + 0.5 * n[0], 0.5 + 0.5 * n[1]) for n in directions])}
    indices = {"indices": ring_lines()} if mode == LINES else {}
    for column, name in enumerate([None, "NORMAL", "TANGENT"]):
        if name:
            attributes = {**attributes, name: add(directions if name == "NORMAL" else [tangent(n) for n in directions])}
        meshes.append({"primitives": [{"mode": mode, "material": row, "attributes": attributes, **indices}]})
        nodes.append({"mesh": len(meshes) - 1, "translation": [column - 1, 0.5 - row, 0]})
document = {
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": list(range(len(nodes)))}],
    "nodes": nodes,
    "meshes": meshes,
    "materials": [
        {"pbrMetallicRoughness": {"baseColorFactor": [0.6, 0.3, 0.2, 1], "metallicFactor": 0, "roughnessFactor": 0.6},
         "emissiveFactor": [0, 0.1, 0.4], "normalTexture": {"index": 0}},
        {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0, "roughnessFactor": 0.4},
         "emissiveFactor": [0.2, 0.2, 0], "emissiveTexture": {"index": 0}, "normalTexture": {"index": 0}},
    ],
    "textures": [{"source": 0}],
    "images": [{"uri": "data:image/png;base64," + MAP}],
    "accessors": accessors,
    "bufferViews": views,
    "buffers": buffers(),
}
pathlib.Path(__file__).with_suffix(".gltf").write_text(json.dumps(document) + "\n")
