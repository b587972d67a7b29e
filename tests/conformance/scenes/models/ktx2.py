#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes ktx2.gltf, squares with a KTX 2.0 texture each, and cube.ktx2, a sky, for scenes/textures-ktx2.json.

The encoders are simple: they choose two colours of a block and the nearest step between them. Sizes are no multiples
of the blocks. The textures of Basis Universal come from tests/filament_core/assets/image/basis.
Sources: Khronos Data Format Specification 1.3 (S3TC, BPTC, ETC2, ASTC), KTX File Format Specification 2.0.
"""

import base64
import json
import math
import pathlib
import struct
import zlib

FOLDER = pathlib.Path(__file__).resolve().parent
BASIS = FOLDER.parents[2] / "filament_core/assets/image/basis"
WIDTH, HEIGHT = 30, 22


def texel(x, y, width, height):
    """Red to the right, green downwards, blue rings, and a hole of alpha."""
    u, v = (x + 0.5) / width, (y + 0.5) / height
    rings = 0.5 + 0.5 * math.sin(math.hypot(u - 0.3, v - 0.4) * 30)
    alpha = 0.0 if math.hypot(u - 0.75, v - 0.7) < 0.15 else 1.0
    return [round(255 * c) for c in (u, v, rings, alpha)]


def blocks(width, height, block):
    """The texels of each block, row by row; those beyond the edge repeat the last ones."""
    for top in range(0, height, block[1]):
        for left in range(0, width, block[0]):
            yield [[texel(min(left + x, width - 1), min(top + y, height - 1), width, height)
                    for x in range(block[0])] for y in range(block[1])]


def distance(a, b):
    return sum((p - q) ** 2 for p, q in zip(a, b))


def farthest(texels):
    """The two that differ most."""
    return max(((a, b) for a in texels for b in texels), key=lambda pair: distance(*pair))


def nearest(palette, wanted):
    return min(range(len(palette)), key=lambda i: distance(palette[i], wanted))


def flat(rows):
    return [t for row in rows for t in row]


def bc1(rows):
    texels = [t[:3] for t in flat(rows)]
    pack = lambda c: (c[0] * 31 + 127) // 255 << 11 | (c[1] * 63 + 127) // 255 << 5 | (c[2] * 31 + 127) // 255
    spread = lambda p: [(p >> 11) * 255 // 31, (p >> 5 & 63) * 255 // 63, (p & 31) * 255 // 31]
    first, second = sorted(map(pack, farthest(texels)), reverse=True)  # in this order: four colours
    ends = [spread(first), spread(second)]
    palette = ends + [[(w * a + (3 - w) * b) // 3 for a, b in zip(*ends)] for w in (2, 1)]
    codes = [0 if first == second else nearest(palette, t) for t in texels]
    return struct.pack("<HHI", first, second, sum(c << 2 * i for i, c in enumerate(codes)))


def bc3(rows):
    alphas = [t[3] for t in flat(rows)]
    high, low = max(alphas), min(alphas)
    palette = [[high], [low]] + [[(w * high + (7 - w) * low) // 7] for w in range(6, 0, -1)]
    codes = [0 if high == low else nearest(palette, [a]) for a in alphas]
    bits = sum(c << 3 * i for i, c in enumerate(codes))
    return struct.pack("<BB", high, low) + bits.to_bytes(6, "little") + bc1(rows)


def bc7(rows):
    """Mode 6: two colours of 7 bits and a common last bit, indices of 4 bits."""
    weights = [0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64]
    texels = flat(rows)
    ends = farthest(texels)
    if ends[0] == ends[1]:
        ends = (texels[0], texels[0])
    codes = lambda pair: [nearest([[(a * (64 - w) + b * w + 32) // 64 for a, b in zip(*pair)] for w in weights], t)
                          for t in texels]
    indices = codes(ends)
    if indices[0] >= 8:  # the first index has 3 bits
        ends, indices = ends[::-1], codes(ends[::-1])
        indices[0] = min(indices[0], 7)
    bits, at = 1 << 6, 7
    for channel in range(4):
        for end in ends:
            bits, at = bits | end[channel] >> 1 << at, at + 7
    for end in ends:
        bits, at = bits | (end[3] & 1) << at, at + 1
    for i, index in enumerate(indices):
        bits, at = bits | index << at, at + (3 if i == 0 else 4)
    return bits.to_bytes(16, "little")


ETC_TABLES = [(2, 8), (5, 17), (9, 29), (13, 42), (18, 60), (24, 80), (33, 106), (47, 183)]


def etc2(rows):
    """The individual mode of ETC1: two halves side by side, each a colour and a table of four brightnesses."""
    bits, indices = 0, 0
    for half in (0, 1):
        places = [(x, y) for x in (2 * half, 2 * half + 1) for y in range(4)]
        texels = [rows[y][x] for x, y in places]
        base = [(round(sum(t[c] for t in texels) / 8) * 15 + 127) // 255 for c in range(3)]
        best = None
        for table, (small, large) in enumerate(ETC_TABLES):
            palette = [[min(max(17 * b + m, 0), 255) for b in base] for m in (small, large, -small, -large)]
            codes = [nearest(palette, t[:3]) for t in texels]
            cost = sum(distance(palette[c], t[:3]) for c, t in zip(codes, texels))
            if best is None or cost < best[0]:
                best = (cost, table, codes)
        for c in range(3):
            bits |= base[c] << 60 - 8 * c - 4 * half
        bits |= best[1] << (37 if half == 0 else 34)
        for (x, y), code in zip(places, best[2]):
            indices |= (code >> 1) << 16 + 4 * x + y | (code & 1) << 4 * x + y
    return (bits | indices).to_bytes(8, "big")


def etc2_eac(rows):
    steps = [-3, -6, -9, -15, 2, 5, 8, 14]
    alphas = [rows[y][x][3] for x in range(4) for y in range(4)]
    base = (max(alphas) + min(alphas)) // 2
    factor = min(max(1, -(-(max(alphas) - base) // 14)), 15)
    palette = [[min(max(base + factor * s, 0), 255)] for s in steps]
    bits = base << 56 | factor << 52
    for i, alpha in enumerate(alphas):
        bits |= nearest(palette, [alpha]) << 45 - 3 * i
    return bits.to_bytes(8, "big") + etc2(rows)


def astc(rows):
    """One partition, RGBA endpoints of 8 bits, a grid of 4 x 4 weights with four steps whatever the block's size."""
    texels = flat(rows)
    ends = sorted(farthest(texels), key=lambda c: sum(c[:3]))  # the darker one first: no blue contraction
    palette = [[(a * (64 - w) + b * w) // 64 for a, b in zip(*ends)] for w in (0, 21, 43, 64)]
    bits, at = 0x42 | 12 << 13, 17
    for channel in range(4):
        for end in ends:
            bits, at = bits | end[channel] << at, at + 8
    for y in range(4):
        for x in range(4):
            row = rows[round(y * (len(rows) - 1) / 3)]
            weight = nearest(palette, row[round(x * (len(row) - 1) / 3)])
            place = 127 - 2 * (4 * y + x)
            bits |= (weight & 1) << place | (weight >> 1) << place - 1
    return bits.to_bytes(16, "little")


def bgra(rows):
    red, green, blue, alpha = rows[0][0]
    return bytes([blue, green, red, alpha])


def ktx2(vk_format, model, block, size, levels, faces=1, scheme=0, transfer=2):
    """`size`: width, height, bytes of a block."""
    packed = [zlib.compress(level, 9) if scheme == 3 else level for level in levels]
    header = 80 + 24 * len(levels)
    sample = struct.pack("<HBBIII", 0, min(size[2] * 8, 256) - 1, 0, 0, 0, 0xFFFFFFFF)
    description = struct.pack("<IIHHBBBB", 44, 0, 2, 40, model, 1, transfer, 0)
    description += bytes([block[0] - 1, block[1] - 1, 0, 0, size[2]]) + bytes(7) + sample
    at = -(-(header + len(description)) // 16) * 16
    places = {}
    data = bytes(at - header - len(description))
    for level in reversed(range(len(levels))):
        data += bytes(-(header + len(description) + len(data)) % 16)
        places[level] = header + len(description) + len(data)
        data += packed[level]
    type_size = 1 if block != (1, 1) or size[2] == 4 and vk_format != 123 else 4
    file = b"\xabKTX 20\xbb\r\n\x1a\n"
    file += struct.pack("<9I", vk_format, type_size, size[0], size[1], 0, 0, faces, len(levels), scheme)
    file += struct.pack("<4I2Q", header, len(description), 0, 0, 0, 0)
    for level, bytes_ in enumerate(packed):
        file += struct.pack("<3Q", places[level], len(bytes_), len(levels[level]))
    return file + description + data


def texture(vk_format, model, block, encode, scheme=0):
    levels, width, height = [], WIDTH, HEIGHT
    while True:
        levels.append(b"".join(encode(rows) for rows in blocks(width, height, block)))
        if width == height == 1:
            break
        width, height = max(width // 2, 1), max(height // 2, 1)
    block_bytes = len(encode([[[0, 0, 0, 0]] * block[0]] * block[1]))
    return ktx2(vk_format, model, block, (WIDTH, HEIGHT, block_bytes), levels, scheme=scheme)


TEXTURES = {
    "BC1": lambda: texture(132, 128, (4, 4), bc1),
    "BC3": lambda: texture(138, 130, (4, 4), bc3),
    "BC7": lambda: texture(146, 134, (4, 4), bc7),
    "BC7 in zlib": lambda: texture(146, 134, (4, 4), bc7, scheme=3),
    "ETC2": lambda: texture(148, 161, (4, 4), etc2),
    "ETC2 with EAC": lambda: texture(152, 161, (4, 4), etc2_eac),
    "ASTC 4x4": lambda: texture(158, 162, (4, 4), astc),
    "ASTC 8x6": lambda: texture(170, 162, (8, 6), astc),
    "ASTC 5x4": lambda: texture(160, 162, (5, 4), astc),
    "B8G8R8A8": lambda: texture(50, 1, (1, 1), bgra),
    "ETC1S": lambda: (BASIS / "etc1s.ktx2").read_bytes(),
    "UASTC": lambda: (BASIS / "uastc.ktx2").read_bytes(),
}


def uri(data, mime):
    return f"data:{mime};base64," + base64.b64encode(data).decode()


def node(index):
    """Four columns; the squares of every other column lie back, so that their levels are seen."""
    column, row = index % 4, index // 4
    half = math.radians(-50 if column % 2 else 0) / 2
    return {"name": list(TEXTURES)[index], "mesh": index, "translation": [1.1 * column - 1.65, 0.85 - 0.85 * row, 0],
            "rotation": [math.sin(half), 0, 0, math.cos(half)], "scale": [1, 0.75, 1]}


def write_model():
    corners = [(-0.5, 0.5, 0, 0), (-0.5, -0.5, 0, 1), (0.5, -0.5, 1, 1), (0.5, 0.5, 1, 0)]
    data = b"".join(struct.pack("<3f", x, y, 0) for x, y, _, _ in corners)
    data += b"".join(struct.pack("<2f", u, v) for _, _, u, v in corners) + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    count = range(len(TEXTURES))
    model = {
        "asset": {"version": "2.0", "generator": "ktx2.py"},
        "extensionsUsed": ["KHR_materials_unlit", "KHR_texture_basisu"],
        "extensionsRequired": ["KHR_texture_basisu"],
        "scene": 0,
        "scenes": [{"nodes": list(count)}],
        "nodes": [node(i) for i in count],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": i}]}
                   for i in count],
        "materials": [{"name": name, "alphaMode": "MASK", "doubleSided": True,
                       "pbrMetallicRoughness": {"baseColorTexture": {"index": i}},
                       "extensions": {"KHR_materials_unlit": {}}} for i, name in enumerate(TEXTURES)],
        "textures": [{"extensions": {"KHR_texture_basisu": {"source": i}}, "sampler": 0} for i in count],
        "samplers": [{"magFilter": 9729, "minFilter": 9987}],
        "images": [{"name": name, "mimeType": "image/ktx2", "uri": uri(make(), "image/ktx2")}
                   for name, make in TEXTURES.items()],
        "buffers": [{"byteLength": len(data), "uri": uri(data, "application/octet-stream")}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 32},
                        {"buffer": 0, "byteOffset": 80, "byteLength": 12}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-0.5, -0.5, 0], "max": [0.5, 0.5, 0]},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    }
    (FOLDER / "ktx2.gltf").write_text(json.dumps(model, separators=(",", ":")) + "\n")


def shared_exponent(color):
    exponent = max(-15, math.frexp(max(*color, 1e-9))[1]) + 15
    scale = 2.0 ** (exponent - 24)
    if max(round(c / scale) for c in color) > 511:
        exponent, scale = exponent + 1, scale * 2
    red, green, blue = (round(c / scale) for c in color)
    return struct.pack("<I", red | green << 9 | blue << 18 | exponent << 27)


def write_cube(size=12):
    """E5B9G9R9, radiance from the direction: bright above, each side another colour, and a lamp."""
    faces = [lambda s, t: (1, -t, -s), lambda s, t: (-1, -t, s), lambda s, t: (s, 1, t),
             lambda s, t: (s, -1, -t), lambda s, t: (s, -t, 1), lambda s, t: (-s, -t, -1)]
    data = b""
    for face in faces:
        for y in range(size):
            for x in range(size):
                d = face((2 * x + 1) / size - 1, (2 * y + 1) / size - 1)
                length = math.hypot(*d)
                d = [c / length for c in d]
                lamp = 20.0 if d[0] > 0.6 and d[1] > 0.5 else 0.0
                data += shared_exponent([0.3 + 0.25 * c + 0.3 * max(d[1], 0) + lamp for c in d])
    (FOLDER / "cube.ktx2").write_bytes(ktx2(123, 1, (1, 1), (size, size, 4), [data], faces=6, transfer=1))


if __name__ == "__main__":
    write_model()
    write_cube()
