#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes splats.gltf beside this file (KHR_gaussian_splatting). On the left a ball of flat splats, whose colours depend on
the direction of view by spherical harmonics of degree 3; in the middle long splats across each other, of which only the
order tells which is in front, and a board that hides and is hidden; on the right a ring of linear colours below a node
that turns it and scales it unevenly. A plane of splats that no node shows breaks rules."""
import json
import math
import pathlib
import struct

from gltf_buffer import accessors, add, add_view, buffers, views

PREFIX = "KHR_gaussian_splatting:"


def packed(rows, code, component):
    """Normalised integers of a struct code."""
    peak = {"b": 127, "h": 32767, "B": 255, "H": 65535}[code]
    pad = -(len(rows[0]) * struct.calcsize(code)) % 4
    data = b"".join(struct.pack(f"<{len(row)}{code}", *(round(v * peak) for v in row)) + b"\0" * pad for row in rows)
    view = add_view(data + b"\0" * (-len(data) % 4))
    if pad:
        views[view]["byteStride"] = len(rows[0]) * struct.calcsize(code) + pad
    kind = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}[len(rows[0])]
    accessors.append({"bufferView": view, "componentType": component, "normalized": True, "count": len(rows), "type": kind})
    return len(accessors) - 1


def towards(n):
    """The shortest rotation of +z to the direction."""
    w = 1 + n[2]
    q = (-n[1], n[0], 0, w) if w > 1e-6 else (1, 0, 0, 0)
    length = math.sqrt(sum(c * c for c in q))
    return tuple(c / length for c in q)


def coefficient(color):
    """Of degree 0."""
    return tuple((c - 0.5) / 0.28209479177387814 for c in color)


def primitive(positions, rotations, scales, opacities, harmonics, space):
    attributes = {"POSITION": add(positions), PREFIX + "ROTATION": packed(rotations, "h", 5122),
                  PREFIX + "SCALE": packed(scales, "H", 5123), PREFIX + "OPACITY": packed([(o,) for o in opacities], "B", 5121)}
    degree = 0
    for coefficients in harmonics:  # of degree 0, 1, ...
        for i, rows in enumerate(coefficients):
            attributes[f"{PREFIX}SH_DEGREE_{degree}_COEF_{i}"] = add(rows)
        degree += 1
    return {"mode": 0, "attributes": attributes,
            "extensions": {"KHR_gaussian_splatting": {"kernel": "ellipse", "colorSpace": space}}}


def ball(count=160, radius=0.42):
    golden = math.pi * (3 - math.sqrt(5))
    places = []
    for i in range(count):
        y = 1 - 2 * (i + 0.5) / count
        r = math.sqrt(1 - y * y)
        places.append((r * math.cos(golden * i), y, r * math.sin(golden * i)))
    colors = [coefficient((0.5 + 0.4 * n[0], 0.55 + 0.35 * n[1], 0.5 - 0.3 * n[2])) for n in places]

    def shine(k):  # different ones for each coefficient and splat
        return [tuple(0.25 * math.sin(0.7 * k + 1.3 * c + 0.05 * i) for c in range(3)) for i in range(count)]
    harmonics = [[colors]] + [[shine(l * l + m) for m in range(2 * l + 1)] for l in (1, 2, 3)]
    return primitive([tuple(radius * c for c in n) for n in places], [towards(n) for n in places],
                     [(0.06, 0.04, 0.004)] * count, [0.9] * count, harmonics, "srgb_rec709_display")


def sticks(count=12):
    positions, rotations, colors = [], [], []
    for i in range(count):
        turn = i * math.pi / count
        positions.append((0.02 * math.cos(3 * turn), 0.02 * math.sin(3 * turn), 0.3 - 0.6 * (i * 5 % count) / count))
        rotations.append((0, 0, math.sin(turn / 2), math.cos(turn / 2)))
        colors.append(coefficient((0.9 if i % 3 == 0 else 0.15, 0.8 if i % 3 == 1 else 0.2, 0.9 if i % 3 == 2 else 0.1)))
    opacities = [1.0 if i % 4 == 0 else 0.6 for i in range(count)]
    return primitive(positions, rotations, [(0.16, 0.025, 0.025)] * count, opacities, [[colors]], "srgb_rec709_display")


def ring(count=40):
    positions, rotations, colors = [], [], []
    for i in range(count):
        turn = 2 * math.pi * i / count
        positions.append((0.35 * math.cos(turn), 0.35 * math.sin(turn), 0))
        rotations.append((0, 0, math.sin(turn / 2), math.cos(turn / 2)))
        colors.append(coefficient((0.8 * (i % 2), 0.3 + 0.5 * i / count, 0.6 - 0.5 * i / count)))
    return primitive(positions, rotations, [(0.03, 0.05, 0.0)] * count, [0.8] * count, [[colors]], "lin_rec709_display")


def board():
    corners = [(-0.5, -0.15, 0), (0.5, -0.15, 0), (0.5, 0.05, 0), (-0.5, 0.05, 0)]
    indices = add_view(struct.pack("<6H", 0, 1, 2, 0, 2, 3))
    accessors.append({"bufferView": indices, "componentType": 5123, "count": 6, "type": "SCALAR"})
    number = len(accessors) - 1
    return {"attributes": {"POSITION": add(corners)}, "indices": number, "material": 0}


meshes = [{"name": name, "primitives": [part]} for name, part in
          [("ball", ball()), ("sticks", sticks()), ("ring", ring()), ("board", board())]]
unused = ring(4)
unused["mode"] = 4
del unused["extensions"]["KHR_gaussian_splatting"]["kernel"]
meshes.append({"name": "unused", "primitives": [unused]})
nodes = [{"mesh": 0, "translation": [-1.0, 0, 0]}, {"mesh": 1}, {"mesh": 3, "translation": [0, 0, 0.02]},
         {"children": [4], "translation": [1.0, 0, 0], "rotation": [0.25881904, 0, 0, 0.96592583]},
         {"mesh": 2, "scale": [1.0, 1.3, 0.5]}]
file = {"asset": {"version": "2.0", "generator": "splats.py"},
        "extensionsUsed": ["KHR_gaussian_splatting", "KHR_materials_unlit"],
        "scenes": [{"nodes": [0, 1, 2, 3]}], "nodes": nodes, "meshes": meshes,
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.25, 0.2, 1]}, "doubleSided": True,
                       "extensions": {"KHR_materials_unlit": {}}}],
        "accessors": accessors, "bufferViews": views, "buffers": buffers()}
path = pathlib.Path(__file__).with_name("splats.gltf")
path.write_text(json.dumps(file, separators=(",", ":")) + "\n")
