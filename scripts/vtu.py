"""Reads the VTU files that impoint writes: zlib-compressed blocks in base64, a
piece a rank."""

import array
import base64
import struct
import xml.etree.ElementTree as ElementTree
import zlib

TYPES = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt8": "B"}


def decoded(data_array):
    """A DataArray's numbers, one after the other. Its text is a header (number of
    blocks, size of a block, of the last one, compressed sizes) and then the
    blocks, each part in base64 of its own."""
    text = data_array.text.strip()
    n_blocks, = struct.unpack("<I", base64.b64decode(text[:8])[:4])
    n_header = 4 * ((4 * (3 + n_blocks) + 2) // 3)
    header = struct.unpack(f"<{3 + n_blocks}I",
                           base64.b64decode(text[:n_header])[:12 + 4 * n_blocks])
    data = base64.b64decode(text[n_header:])
    raw, start = b"", 0
    for size in header[3:]:
        raw += zlib.decompress(data[start:start + size])
        start += size
    return array.array(TYPES[data_array.get("type")], raw)


def read_rows(path):
    """Places and fields of all pieces as lists, one row a point."""
    fields = {}
    for piece in ElementTree.parse(path).iter("Piece"):
        for name, data in [
                *(("place", points) for points in piece.findall("Points/DataArray")),
                *((field.get("Name"), field)
                  for field in piece.findall("PointData/DataArray"))]:
            width, numbers = int(data.get("NumberOfComponents", 1)), decoded(data)
            fields.setdefault(name, []).extend(
                numbers[i:i + width].tolist()
                for i in range(0, len(numbers), width))
    return fields


def read_vtu(path):
    """The same as numpy's arrays."""
    import numpy
    return {name: numpy.array(rows) for name, rows in read_rows(path).items()}
