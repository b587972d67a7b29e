#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes animated.gltf beside this file: six squares, a point light and a spot with properties that
KHR_animation_pointer changes over one second.

From left to right: a colour and a roughness; the transform of a texture; a square that is hidden at rest, with
emission; the height of bumps; a smooth clear coat over bumps; a glossy material with bumps.
The point's intensity and the spot's cone and colour change as well."""
import base64
import json
import pathlib
import struct
import zlib

buffer, views, accessors, samplers, channels = bytearray(), [], [], [], []


def add(fmt, rows, kind, component):
    while len(buffer) % 4:
        buffer.append(0)
    data = b"".join(struct.pack("<" + fmt, *row) for row in rows)
    views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data)})
    buffer.extend(data)
    accessor = {"bufferView": len(views) - 1, "componentType": component, "count": len(rows), "type": kind}
    if kind in ("VEC3", "SCALAR") and component == 5126:
        accessor["min"] = [min(row[i] for row in rows) for i in range(len(rows[0]))]
        accessor["max"] = [max(row[i] for row in rows) for i in range(len(rows[0]))]
    accessors.append(accessor)
    return len(accessors) - 1


def png(side, code):
    rows = b"".join(b"\0" + bytes(c for x in range(side) for c in code(x, y)) for y in range(side))
    head = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    parts = ((b"IHDR", head), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b""))
    body = b"".join(struct.pack(">I", len(d)) + n + d + struct.pack(">I", zlib.crc32(n + d)) for n, d in parts)
    return "data:image/png;base64," + base64.b64encode(b"\x89PNG\r\n\x1a\n" + body).decode()


def animate(pointer, first, last):
    """From `first` to `last` in a second; booleans change at 0.25 s."""
    is_bool = isinstance(first, bool)
    if is_bool:
        output = add("B3x", [(int(first),), (int(last),)], "SCALAR", 5121)
        views[-1]["byteStride"] = 4
    else:
        output = add(f"{len(first)}f", [first, last], ("SCALAR", "VEC2", "VEC3", "VEC4")[len(first) - 1], 5126)
    samplers.append({"input": switch if is_bool else times, "output": output,
                     "interpolation": "STEP" if is_bool else "LINEAR"})
    channels.append({"sampler": len(samplers) - 1, "target": {"path": "pointer", "extensions": {
        "KHR_animation_pointer": {"pointer": pointer}}}})


def tile(x, y):
    return (230, 200, 60) if (x ^ y) & 1 else (30 + 25 * x, 60, 40 + 25 * y)


def hill(x, y):
    height = max(0, 255 - 8 * ((x - 8) ** 2 + (y - 8) ** 2))
    return (height, height, height)


attributes = {
    "POSITION": add("3f", [(-0.5, 0.5, 0), (-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0)], "VEC3", 5126),
    "NORMAL": add("3f", [(0, 0, 1)] * 4, "VEC3", 5126),
    "TEXCOORD_0": add("2f", [(0, 0), (0, 1), (1, 1), (1, 0)], "VEC2", 5126),
}
indices = add("H", [(i,) for i in (0, 1, 2, 0, 2, 3)], "SCALAR", 5123)
times = add("f", [(0,), (1,)], "SCALAR", 5126)
switch = add("f", [(0,), (0.25,)], "SCALAR", 5126)

transform = "/materials/1/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/"
animate("/materials/0/pbrMetallicRoughness/baseColorFactor", (1, 0, 0, 1), (0, 0.2, 1, 1))
animate("/materials/0/pbrMetallicRoughness/roughnessFactor", (0.1,), (0.7,))
animate(transform + "offset", (0, 0), (1, 0.5))
animate(transform + "rotation", (0,), (0.6,))
animate(transform + "scale", (1, 1), (2, 0.5))
animate("/nodes/2/extensions/KHR_node_visibility/visible", False, True)
animate("/materials/2/emissiveFactor", (0, 0, 0), (0, 0.5, 0.2))
animate("/materials/3/extensions/EXT_materials_bump/bumpFactor", (0,), (0.4,))
animate("/materials/4/extensions/KHR_materials_clearcoat/clearcoatFactor", (0,), (1,))
animate("/extensions/KHR_lights_punctual/lights/0/intensity", (0,), (60000,))
animate("/extensions/KHR_lights_punctual/lights/1/color", (1, 1, 1), (1, 0.2, 0))
animate("/extensions/KHR_lights_punctual/lights/1/spot/outerConeAngle", (0.1,), (0.5,))

lights = "KHR_lights_punctual"
model = {
    "asset": {"version": "2.0", "generator": "animated.py"},
    "extensionsUsed": ["EXT_materials_bump", "KHR_animation_pointer", "KHR_lights_punctual", "KHR_materials_clearcoat",
                       "KHR_materials_pbrSpecularGlossiness", "KHR_node_visibility", "KHR_texture_transform"],
    "extensions": {lights: {"lights": [
        {"type": "point", "intensity": 0},
        {"type": "spot", "intensity": 150000, "spot": {"innerConeAngle": 0, "outerConeAngle": 0.1}}]}},
    "scene": 0,
    "scenes": [{"nodes": [0, 1, 2, 3, 4, 5, 6, 7]}],
    "nodes": [{"mesh": i, "translation": [1.1 * i - 2.75, 0, 0]} for i in range(6)] + [
        {"translation": [-1.15, 1, 1], "extensions": {lights: {"light": 0}}},
        {"translation": [1.6, 0, 2], "extensions": {lights: {"light": 1}}}],
    "materials": [
        {"pbrMetallicRoughness": {"metallicFactor": 0}},
        {"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {
            "index": 0, "extensions": {"KHR_texture_transform": {}}}}},
        {"pbrMetallicRoughness": {"metallicFactor": 0}},
        {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.4}, "extensions": {
            "EXT_materials_bump": {"bumpFactor": 0, "bumpTexture": {"index": 1}}}},
        {"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.5, 0.4, 1], "metallicFactor": 0}, "extensions": {
            "KHR_materials_clearcoat": {"clearcoatFactor": 0, "clearcoatRoughnessFactor": 0.1},
            "EXT_materials_bump": {"bumpFactor": -0.3, "bumpTexture": {"index": 1}}}},
        {"extensions": {
            "KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.2, 0.4, 0.2, 1],
                                                    "specularFactor": [0.3, 0.3, 0.3], "glossinessFactor": 0.6},
            "EXT_materials_bump": {"bumpFactor": 0.3, "bumpTexture": {"index": 1}}}}],
    "meshes": [{"primitives": [{"attributes": attributes, "indices": indices, "material": i}]} for i in range(6)],
    "textures": [{"source": 0}, {"source": 1}],
    "images": [{"uri": png(8, tile)}, {"uri": png(16, hill)}],
    "animations": [{"samplers": samplers, "channels": channels}],
    "accessors": accessors,
    "bufferViews": views,
    "buffers": [{"byteLength": len(buffer),
                 "uri": "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()}],
}
model["nodes"][2]["extensions"] = {"KHR_node_visibility": {"visible": False}}
path = pathlib.Path(__file__).with_suffix(".gltf")
path.write_text(json.dumps(model, separators=(",", ":")) + "\n")
