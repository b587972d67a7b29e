#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes ribbon.gltf beside this file: a strip bent by eight joints, all of which affect every vertex, with two
morph targets.

Vertex i of a row is at height i / 16; its weights for the eight joints form a bell curve around it, which sums to 1. Joint k is
at height k / 7 and a child of joint k - 1. The animation rotates all joints about x and varies the targets' weights."""
import base64
import json
import math
import pathlib
import struct

ROWS, JOINTS = 17, 8
buffer, views, accessors = bytearray(), [], []


def add(fmt, rows, kind, component, normalized=False):
    data = b"".join(struct.pack("<" + fmt, *row) for row in rows)
    while len(buffer) % 4:
        buffer.append(0)
    views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data)})
    buffer.extend(data)
    accessor = {"bufferView": len(views) - 1, "componentType": component, "count": len(rows), "type": kind}
    if kind == "VEC3" or kind == "SCALAR":
        accessor["min"] = [min(row[i] for row in rows) for i in range(len(rows[0]))]
        accessor["max"] = [max(row[i] for row in rows) for i in range(len(rows[0]))]
    if normalized:
        accessor["normalized"] = True
    accessors.append(accessor)
    return len(accessors) - 1


def weights_at(height):
    bell = [math.exp(-30 * (height - k / (JOINTS - 1)) ** 2) for k in range(JOINTS)]
    return [b / sum(bell) for b in bell]


corners = [(x, i / (ROWS - 1)) for i in range(ROWS) for x in (-0.15, 0.15)]
weights = [weights_at(y) for _, y in corners]
indices = [v for i in range(ROWS - 1) for v in (2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 2, 2 * i + 1, 2 * i + 3)]
inverse_bind = [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -k / (JOINTS - 1), 0, 1] for k in range(JOINTS)]
times = [(0.0,), (1.0,), (2.0,)]
turns = [(0, 0, 0, 1), (math.sin(0.12), 0, 0, math.cos(0.12)), (0, math.sin(0.1), 0, math.cos(0.1))]

primitive = {
    "attributes": {
        "POSITION": add("3f", [(x, y, 0) for x, y in corners], "VEC3", 5126),
        "NORMAL": add("3f", [(0, 0, 1)] * len(corners), "VEC3", 5126),
        "JOINTS_0": add("4B", [(0, 1, 2, 3)] * len(corners), "VEC4", 5121),
        "WEIGHTS_0": add("4f", [w[:4] for w in weights], "VEC4", 5126),
        "JOINTS_1": add("4B", [(4, 5, 6, 7)] * len(corners), "VEC4", 5121),
        "WEIGHTS_1": add("4f", [w[4:] for w in weights], "VEC4", 5126),
    },
    "indices": add("H", [(i,) for i in indices], "SCALAR", 5123),
    "targets": [
        {"POSITION": add("3f", [(x * y * 2, 0, 0) for x, y in corners], "VEC3", 5126)},
        {"POSITION": add("3f", [(0, 0, 0.3 * math.sin(6 * y)) for _, y in corners], "VEC3", 5126),
         "NORMAL": add("3f", [(0, -1.8 * math.cos(6 * y), 0) for _, y in corners], "VEC3", 5126)},
    ],
    "material": 0,
}
time = add("f", times, "SCALAR", 5126)
turn = add("4f", turns, "VEC4", 5126)
swing = add("f", [(0,), (0,), (1,), (0.5,), (0.2,), (1,)], "SCALAR", 5126)
nodes = [{"name": "ribbon", "mesh": 0, "skin": 0}]
for k in range(JOINTS):
    node = {"name": f"joint {k}", "translation": [0, 1 / (JOINTS - 1) if k else 0, 0]}
    if k + 1 < JOINTS:
        node["children"] = [k + 2]
    nodes.append(node)
channels = [{"sampler": 0, "target": {"node": k + 1, "path": "rotation"}} for k in range(JOINTS)]
channels.append({"sampler": 1, "target": {"node": 0, "path": "weights"}})

gltf = {
    "asset": {"version": "2.0", "generator": "ribbon.py"},
    "scene": 0,
    "scenes": [{"nodes": [0, 1]}],
    "nodes": nodes,
    "meshes": [{"name": "ribbon", "weights": [0, 0.3], "primitives": [primitive]}],
    "skins": [{"joints": list(range(1, JOINTS + 1)), "inverseBindMatrices": add("16f", inverse_bind, "MAT4", 5126)}],
    "materials": [{"doubleSided": True, "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.2, 0.1, 1],
                                                                 "metallicFactor": 0, "roughnessFactor": 0.5}}],
    "animations": [{"name": "bend", "channels": channels,
                    "samplers": [{"input": time, "output": turn}, {"input": time, "output": swing}]}],
    "bufferViews": views,
    "accessors": accessors,
}
gltf["buffers"] = [{"byteLength": len(buffer),
                    "uri": "data:application/octet-stream;base64," + base64.b64encode(bytes(buffer)).decode()}]
(pathlib.Path(__file__).parent / "ribbon.gltf").write_text(json.dumps(gltf) + "\n")
