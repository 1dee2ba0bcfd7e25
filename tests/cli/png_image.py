"""PNG files as rows of integers, with the standard library alone: what tests write and look at."""

import struct
import zlib

_KINDS = {1: 0, 2: 4, 3: 2, 4: 6}  # channels -> PNG color type


def write_png(path, rows, channels, bits=8):
    """rows: lists of width * channels integers."""
    code = ">%d%s" % (len(rows[0]), "B" if bits == 8 else "H")
    data = b"".join(b"\0" + struct.pack(code, *row) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]) // channels, len(rows), bits, _KINDS[channels], 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for name, body in ((b"IHDR", header), (b"IDAT", zlib.compress(data)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body)))


def read_png(path):
    """(rows, channels, bits) of a PNG without palette or interlacing."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    at, packed, header = 8, b"", None
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        if name == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        elif name == b"IDAT":
            packed += body
        at += 12 + length
    width, height, bits, kind = header[:4]
    channels = {0: 1, 4: 2, 2: 3, 6: 4}[kind]
    step = channels * bits // 8
    stride = width * step
    raw = zlib.decompress(packed)
    assert len(raw) == height * (stride + 1), path
    rows, above = [], bytes(stride)
    for y in range(height):
        start = y * (stride + 1)
        line = bytearray(raw[start + 1 : start + 1 + stride])
        _unfilter(raw[start], line, above, step)
        above = bytes(line)
        rows.append(list(struct.unpack(">%d%s" % (width * channels, "B" if bits == 8 else "H"), above)))
    return rows, channels, bits


def _unfilter(kind, line, above, step):
    for i in range(len(line)):
        left = line[i - step] if i >= step else 0
        up = above[i]
        corner = above[i - step] if i >= step else 0
        if kind == 1:
            guess = left
        elif kind == 2:
            guess = up
        elif kind == 3:
            guess = (left + up) // 2
        elif kind == 4:
            estimate = left + up - corner
            guess = min((abs(estimate - left), 0, left), (abs(estimate - up), 1, up), (abs(estimate - corner), 2, corner))[2]
        else:
            guess = 0
        line[i] = (line[i] + guess) & 255
