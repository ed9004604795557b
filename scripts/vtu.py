"""Reads the VTU files that impoint writes: zlib-compressed blocks in base64, a
piece a rank."""

import base64
import xml.etree.ElementTree as ElementTree
import zlib

import numpy

TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "UInt8": "u1"}


def decoded(array):
    """A DataArray's numbers. Its text is a header (number of blocks, size of a
    block, of the last one, compressed sizes) and then the blocks, each part
    in base64 of its own."""
    text = array.text.strip()
    n_blocks = numpy.frombuffer(base64.b64decode(text[:8])[:4], "<u4")[0]
    n_header = 4 * ((4 * (3 + int(n_blocks)) + 2) // 3)
    header = numpy.frombuffer(base64.b64decode(text[:n_header]), "<u4")
    data = base64.b64decode(text[n_header:])
    raw, start = b"", 0
    for size in header[3:3 + n_blocks]:
        raw += zlib.decompress(data[start:start + size])
        start += int(size)
    numbers = numpy.frombuffer(raw, TYPES[array.get("type")])
    width = int(array.get("NumberOfComponents", 1))
    return numbers.reshape(-1, width)


def read_vtu(path):
    """Places and fields of all pieces, one row a point."""
    parts = {}
    for piece in ElementTree.parse(path).iter("Piece"):
        for array in piece.findall("Points/DataArray"):
            parts.setdefault("place", []).append(decoded(array))
        for array in piece.findall("PointData/DataArray"):
            parts.setdefault(array.get("Name"), []).append(decoded(array))
    return {name: numpy.concatenate(part) for name, part in parts.items()}
