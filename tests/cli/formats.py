"""Readers of what ptbench writes."""

import struct
import zlib


def png_size(data):
    """Width and height of an intact PNG: signature and every chunk's checksum are tested."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", data[:8]
    at, chunks = 8, {}
    while at < len(data):
        length, = struct.unpack(">I", data[at:at + 4])
        kind, body = data[at + 4:at + 8], data[at + 8:at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0] == zlib.crc32(kind + body), kind
        chunks.setdefault(kind, b"")
        chunks[kind] += body
        at += 12 + length
    assert b"IEND" in chunks and zlib.decompress(chunks[b"IDAT"])
    return struct.unpack(">II", chunks[b"IHDR"][:8])


def pfm_pixels(data):
    """Size and floats of a PFM file."""
    magic, size, scale, body = data.split(b"\n", 3)
    assert (magic, scale) == (b"PF", b"-1.0")
    width, height = map(int, size.split())
    return (width, height), struct.unpack(f"<{3 * width * height}f", body)
