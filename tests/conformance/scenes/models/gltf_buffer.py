# SPDX-License-Identifier: Apache-2.0
"""The buffer of a generated glTF file: its views and accessors, and the data URI that holds its bytes."""
import base64
import struct

buffer, views, accessors = bytearray(), [], []


def add_view(data):
    views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data)})
    buffer.extend(data)
    return len(views) - 1


def add(rows):
    """An accessor of 32-bit floats; three in a row have bounds, as positions need them."""
    accessor = {"bufferView": add_view(b"".join(struct.pack(f"<{len(row)}f", *row) for row in rows)),
                "componentType": 5126, "count": len(rows), "type": f"VEC{len(rows[0])}"}
    if len(rows[0]) == 3:
        stored = [struct.unpack("<3f", struct.pack("<3f", *row)) for row in rows]
        accessor["min"] = [min(column) for column in zip(*stored)]
        accessor["max"] = [max(column) for column in zip(*stored)]
    accessors.append(accessor)
    return len(accessors) - 1


def buffers():
    uri = "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()
    return [{"byteLength": len(buffer), "uri": uri}]
