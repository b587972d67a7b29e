#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes levels.gltf beside this file: a sphere in three levels of detail (MSFT_lod), each with a colour of its own. The
coarser ones are in no scene. Each level has a quarter of the triangles of the one before."""
import base64
import json
import math
import pathlib
import struct

LEVELS = (("fine", 32, (0.8, 0.5, 0.1)), ("medium", 16, (0.1, 0.6, 0.3)), ("coarse", 8, (0.2, 0.3, 0.8)))
buffer, views, accessors = bytearray(), [], []


def add(fmt, rows, kind, component, **more):
    data = b"".join(struct.pack("<" + fmt, *row) for row in rows)
    views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data)})
    buffer.extend(data)
    accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(rows), "type": kind, **more})
    return len(accessors) - 1


def sphere(columns):
    """Positions, which are the normals too, and indices."""
    rows = columns // 2
    points = [(math.sin(math.pi * r / rows) * math.cos(2 * math.pi * c / columns), math.cos(math.pi * r / rows),
               -math.sin(math.pi * r / rows) * math.sin(2 * math.pi * c / columns))
              for r in range(rows + 1) for c in range(columns + 1)]
    at = lambda r, c: r * (columns + 1) + c
    triangles = [t for r in range(rows) for c in range(columns)
                 for t in ((at(r, c), at(r + 1, c), at(r + 1, c + 1)), (at(r, c), at(r + 1, c + 1), at(r, c + 1)))]
    return points, [(i,) for t in triangles for i in t]


nodes, meshes, materials = [], [], []
for name, columns, color in LEVELS:
    points, indices = sphere(columns)
    position = add("3f", points, "VEC3", 5126, min=[-1, -1, -1], max=[1, 1, 1])
    primitive = {"attributes": {"POSITION": position, "NORMAL": position}, "indices": add("H", indices, "SCALAR", 5123),
                 "material": len(materials)}
    nodes.append({"name": name, "mesh": len(meshes)})
    meshes.append({"primitives": [primitive]})
    materials.append({"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": 0.5}})
nodes[0] |= {"extensions": {"MSFT_lod": {"ids": [1, 2]}}, "extras": {"MSFT_screencoverage": [0.04, 0.01, 0.002]}}
model = {"asset": {"version": "2.0"}, "extensionsUsed": ["MSFT_lod"], "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes,
         "meshes": meshes, "materials": materials, "accessors": accessors, "bufferViews": views,
         "buffers": [{"byteLength": len(buffer),
                      "uri": "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()}]}
path = pathlib.Path(__file__).with_suffix(".gltf")
path.write_text(json.dumps(model, separators=(",", ":")) + "\n", encoding="utf-8")
