#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes fronds.gltf beside this file: the columns of reeds.gltf with two morph targets. Bones and weights of each are
its own, and an animation of a second moves all of them, each in its own way."""
import base64
import json
import math
import pathlib
import struct

from gltf_buffer import accessors, add, add_view, buffer, buffers, views

HERE = pathlib.Path(__file__).parent
gltf = json.loads((HERE / "reeds.gltf").read_text())
buffer.extend(base64.b64decode(gltf["buffers"][0]["uri"].split(",")[1]))
views.extend(gltf["bufferViews"])
accessors.extend(gltf["accessors"])

primitive = gltf["meshes"][0]["primitives"][0]
position = accessors[primitive["attributes"]["POSITION"]]
first = views[position["bufferView"]]["byteOffset"]
corners = [struct.unpack_from("<3f", buffer, first + 12 * i) for i in range(position["count"])]
normals = [struct.unpack_from("<3f", buffer, views[accessors[primitive["attributes"]["NORMAL"]]["bufferView"]]
                              ["byteOffset"] + 12 * i) for i in range(position["count"])]
primitive["targets"] = [
    # Thicker in the middle, and broader at the top.
    {"POSITION": add([(2 * x * math.sin(math.pi * y), 0, 2 * z * math.sin(math.pi * y)) for x, y, z in corners]),
     "NORMAL": add([(0, -0.4 * math.cos(math.pi * y) * (abs(nx) + abs(nz)), 0)
                    for (_, y, _), (nx, _, nz) in zip(corners, normals)])},
    {"POSITION": add([(2.5 * x * y * y, 0, 0) for x, y, _ in corners])},
]


def scalars(rows):
    accessors.append({"bufferView": add_view(struct.pack(f"<{len(rows)}f", *rows)), "componentType": 5126,
                      "count": len(rows), "type": "SCALAR"})
    return len(accessors) - 1


def turned(quaternion, angle):
    """After a turn about z."""
    x, y, z, w = quaternion
    s, c = math.sin(angle / 2), math.cos(angle / 2)
    return (x * c - y * s, x * s + y * c, w * s + z * c, w * c - z * s)


times = scalars([0.0, 1.0])
accessors[times]["min"], accessors[times]["max"] = [0.0], [1.0]
channels, samplers = [], []
for i, node in enumerate(gltf["nodes"]):
    if "mesh" in node:
        reed = node["skin"]
        node["weights"] = [round(0.12 * reed, 2), round(0.9 - 0.1 * reed, 2) if reed % 3 else 0]
        later = [round(0.9 - 0.1 * reed, 2), 0.5]
        sampler, path = {"input": times, "output": scalars(node["weights"] + later)}, "weights"
    else:
        turn = 0.5 if i % 2 else -0.3
        sampler, path = {"input": times, "output": add([node["rotation"], turned(node["rotation"], turn)])}, "rotation"
    channels.append({"sampler": len(samplers), "target": {"node": i, "path": path}})
    samplers.append(sampler)
gltf["animations"] = [{"name": "sway", "channels": channels, "samplers": samplers}]
gltf["meshes"][0]["name"] = "frond"
gltf["asset"]["generator"] = "fronds.py"
gltf["bufferViews"], gltf["accessors"] = views, accessors
gltf["buffers"] = buffers()
(HERE / "fronds.gltf").write_text(json.dumps(gltf) + "\n")
