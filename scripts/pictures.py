"""Readers of the pictures that ptbench writes. A picture is its rows from the top, three floats a pixel."""

import array
import itertools
import struct
import zlib

ZIP, ZIP_LINES, FLOAT = 3, 16, 2


def read_pfm(path):
    with open(path, "rb") as file:
        assert file.readline() == b"PF\n"
        width, height = map(int, file.readline().split())
        assert float(file.readline()) < 0, "little-endian"
        values = array.array("f", file.read())
    row = 3 * width
    return [values[y * row:(y + 1) * row] for y in reversed(range(height))]


def text(data, at):
    """A text that ends with a zero byte, and where the next thing begins."""
    end = data.index(0, at)
    return data[at:end].decode(), end + 1


def header(data):
    """Attributes by name, and where the table of chunks begins."""
    assert data[:8] == struct.pack("<II", 20000630, 2), "an EXR file of lines in one part"
    at, attributes = 8, {}
    while data[at]:
        name, at = text(data, at)
        _, at = text(data, at)
        (size,) = struct.unpack_from("<I", data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def channels(attribute):
    """Names in the order in which lines have them."""
    at, names = 0, []
    while attribute[at]:
        name, at = text(attribute, at)
        assert struct.unpack_from("<I", attribute, at)[0] == FLOAT
        names.append(name)
        at += 16
    return names


def unpacked(chunk, size):
    """OpenEXR's ZIP: halves of every second byte, differences, zlib; a chunk that would have grown is as it was."""
    if len(chunk) == size:
        return chunk
    halves = bytes(itertools.accumulate(zlib.decompress(chunk), lambda sum_, byte: (sum_ + byte - 128) & 255))
    middle = (size + 1) // 2
    whole = bytearray(size)
    whole[0::2], whole[1::2] = halves[:middle], halves[middle:]
    return bytes(whole)


def read_exr(path):
    """Its layers by name, of a file that ptbench_reference wrote."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, table = header(data)
    assert attributes["compression"][0] == ZIP
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height, names = right - left + 1, bottom - top + 1, channels(attributes["channels"])
    layers = {name.rpartition(".")[0]: [array.array("f", bytes(12 * width)) for _ in range(height)] for name in names}
    for (start,) in struct.iter_unpack("<Q", data[table:table + 8 * -(-height // ZIP_LINES)]):
        first, packed = struct.unpack_from("<iI", data, start)
        lines = range(first - top, min(first - top + ZIP_LINES, height))
        values = array.array("f", unpacked(data[start + 8:start + 8 + packed], 4 * width * len(names) * len(lines)))
        for number, (y, name) in enumerate(itertools.product(lines, names)):
            layer, _, colour = name.rpartition(".")
            layers[layer][y]["RGB".index(colour)::3] = values[number * width:(number + 1) * width]
    return layers
