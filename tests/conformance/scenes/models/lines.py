#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes lines.gltf beside this file: sixty lines around a point, a strip along a wave, and a loop in the shape of a star,
with colours per vertex."""
import json
import math
import pathlib

from gltf_buffer import accessors, add, buffers, views

LINES, STRIP, LOOP = 1, 3, 2  # modes of primitives


def primitive(mode, positions):
    colors = [(0.5 + 0.5 * math.sin(0.9 * i), 0.5 + 0.5 * math.cos(0.7 * i), 0.6, 1) for i in range(len(positions))]
    return {"mode": mode, "material": 0, "attributes": {"POSITION": add(positions), "COLOR_0": add(colors)}}


def ring(angle, radius, x, y, z):
    return (x + radius * math.cos(angle), y + radius * math.sin(angle), z)


lines = []
for i in range(60):
    lines += [ring(i * math.pi / 30, 0.15, -0.5, 0.5, 0), ring(i * math.pi / 30, 0.45, -0.5, 0.5, 0.3 * math.sin(7 * i))]
strip = [(0.0225 * i - 0.9, 0.35 * math.sin(0.37 * i) * math.cos(0.05 * i) - 0.5, 0.2 * math.sin(i)) for i in range(81)]
loop = [ring(i * 5 * math.pi / 6, 0.4, 0.5, 0.5, 0.1) for i in range(12)]
primitives = [primitive(LINES, lines), primitive(STRIP, strip), primitive(LOOP, loop)]
document = {
    "asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_materials_unlit"],
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": primitives}],
    "materials": [{"extensions": {"KHR_materials_unlit": {}}}],
    "accessors": accessors,
    "bufferViews": views,
    "buffers": buffers(),
}
pathlib.Path(__file__).with_suffix(".gltf").write_text(json.dumps(document) + "\n")
