#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes reeds.gltf beside this file: nine columns with one mesh, each with a skin of four joints and a pose of its own."""
import json
import math
import pathlib
import struct

from gltf_buffer import accessors, add, add_view, buffers, views

ROWS, JOINTS, HALF = 10, 4, 0.06
SIDES = [((-1, 1), (1, 1), (0, 0, 1)), ((1, 1), (1, -1), (1, 0, 0)), ((1, -1), (-1, -1), (0, 0, -1)),
         ((-1, -1), (-1, 1), (-1, 0, 0))]


def add_integers(fmt, rows, component, kind):
    view = add_view(b"".join(struct.pack("<" + fmt, *row) for row in rows))
    accessors.append({"bufferView": view, "componentType": component, "count": len(rows), "type": kind})
    return len(accessors) - 1


def weights_at(height):
    bell = [math.exp(-18 * (height - k / (JOINTS - 1)) ** 2) for k in range(JOINTS)]
    return [b / sum(bell) for b in bell]


corners, normals, indices = [], [], []
for left, right, normal in SIDES:
    first = len(corners)
    for row in range(ROWS):
        height = row / (ROWS - 1)
        for x, z in (left, right):
            corners.append((x * HALF, height, z * HALF))
            normals.append(normal)
    for row in range(ROWS - 1):
        a = first + 2 * row
        indices += [a, a + 1, a + 2, a + 2, a + 1, a + 3]
first = len(corners)
for x, z in ((-1, 1), (1, 1), (1, -1), (-1, -1)):
    corners.append((x * HALF, 1.0, z * HALF))
    normals.append((0, 1, 0))
indices += [first, first + 1, first + 2, first, first + 2, first + 3]

attributes = {
    "POSITION": add(corners),
    "NORMAL": add(normals),
    "JOINTS_0": add_integers("4B", [(0, 1, 2, 3)] * len(corners), 5121, "VEC4"),
    "WEIGHTS_0": add([weights_at(y) for _, y, _ in corners]),
}
order = add_integers("H", [(i,) for i in indices], 5123, "SCALAR")
bind = add_integers("16f", [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -k / (JOINTS - 1), 0, 1] for k in range(JOINTS)],
                    5126, "MAT4")
nodes, skins, roots = [], [], []
for reed in range(9):
    bend, turn = 0.09 * (reed - 4), 0.7 * reed
    skins.append({"joints": [len(nodes) + 1 + k for k in range(JOINTS)], "inverseBindMatrices": bind})
    roots += [len(nodes), len(nodes) + 1]
    nodes.append({"name": f"reed {reed}", "mesh": 0, "skin": reed})
    for k in range(JOINTS):
        place = [reed % 3 * 0.4 - 0.4, 0, reed // 3 * 0.4 - 0.4] if k == 0 else [0, 1 / (JOINTS - 1), 0]
        axis = (math.sin(turn), 0, math.cos(turn))
        node = {"name": f"reed {reed} joint {k}", "translation": place,
                "rotation": [math.sin(bend) * axis[0], 0, math.sin(bend) * axis[2], math.cos(bend)]}
        if k + 1 < JOINTS:
            node["children"] = [len(nodes) + 1]
        nodes.append(node)

gltf = {
    "asset": {"version": "2.0", "generator": "reeds.py"},
    "scene": 0,
    "scenes": [{"nodes": roots}],
    "nodes": nodes,
    "meshes": [{"name": "reed", "primitives": [{"attributes": attributes, "indices": order, "material": 0}]}],
    "skins": skins,
    "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.35, 0.5, 0.12, 1], "metallicFactor": 0,
                                            "roughnessFactor": 0.5}}],
    "bufferViews": views,
    "accessors": accessors,
}
gltf["buffers"] = buffers()
(pathlib.Path(__file__).parent / "reeds.gltf").write_text(json.dumps(gltf) + "\n")
