"""Reads frames/*.vtu of a run: the arrays of an unstructured grid, compressed by zlib and written as base64."""
import base64
import re
import struct
import zlib

FORMATS = {"Float64": "d", "Int64": "q", "Int32": "i", "UInt8": "B"}


def unpacked(text):
    """VTK writes the sizes first: blocks, bytes of a block, bytes of the last one, compressed bytes of each."""
    blocks = struct.unpack("<Q", base64.b64decode(text[:32])[:8])[0]
    size = (3 + blocks) * 8
    encoded = (size + 2) // 3 * 4
    lengths = struct.unpack(f"<{3 + blocks}Q", base64.b64decode(text[:encoded])[:size])[3:]
    data, plain, start = base64.b64decode(text[encoded:]), b"", 0
    for length in lengths:
        plain += zlib.decompress(data[start:start + length])
        start += length
    return plain


def read(path):
    """Arrays by name; those of several components as lists of tuples."""
    arrays = {}
    pattern = r'<DataArray type="(\w+)" Name="(\w+)" NumberOfComponents="(\d+)" format="binary">([^<]*)<'
    for kind, name, components, text in re.findall(pattern, path.read_text(encoding="ascii")):
        plain, letter, count = unpacked(text.strip()), FORMATS[kind], int(components)
        values = struct.unpack(f"<{len(plain) // struct.calcsize(letter)}{letter}", plain)
        arrays[name] = values if count == 1 else list(zip(*[values[k::count] for k in range(count)]))
    return arrays


def cells(arrays):
    """Corners of each cell, as indices of points."""
    begin = 0
    for end in arrays["offsets"]:
        yield arrays["connectivity"][begin:end]
        begin = end
