"""Draws a set of 16 tiles with two edge colors, as one might by hand: python3 draw_tiles.py FOLDER

Bands run across the tiles and end at their edges; an edge of color 0 is crossed in its middle, one of color 1 nearer to
its end, so that bands go on from tile to tile. Writes tile_00.png to tile_15.png and colors.json.
"""

import json
import math
import os
import struct
import sys
import zlib

SIDE = 32
CROSSED_AT = (16, 9)  # texels from the west or north end of an edge, by color
BAND, LINE = 5.5, 1.5  # half widths
GROUND, BODY, RIM = (44, 52, 68), (222, 190, 120), (250, 240, 214)


def distance(x, y, ends):
    """To a curve from one end to the other that leaves the edges at right angles."""
    (ax, ay, adx, ady), (bx, by, bdx, bdy) = ends
    nearest = math.inf
    for i in range(65):
        t = i / 64
        u = 1 - t
        weights = (u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t)
        px = weights[0] * ax + weights[1] * (ax + adx) + weights[2] * (bx + bdx) + weights[3] * bx
        py = weights[0] * ay + weights[1] * (ay + ady) + weights[2] * (by + bdy) + weights[3] * by
        nearest = min(nearest, math.hypot(x - px, y - py))
    return nearest


def tile(north, east, south, west):
    """Rows of texels: a band from the west to the east, and above it one from the north to the south."""
    reach = SIDE / 2
    across = ((0, CROSSED_AT[west], reach, 0), (SIDE, CROSSED_AT[east], -reach, 0))
    down = ((CROSSED_AT[north], 0, 0, reach), (CROSSED_AT[south], SIDE, 0, -reach))
    rows = []
    for j in range(SIDE):
        row = bytearray()
        for i in range(SIDE):
            texel = GROUND
            for ends in (across, down):
                # Along a border all tiles show the same: straight bands, by where the edge is crossed.
                d = distance(i + 0.5, j + 0.5, ends)
                if i < 2 or i >= SIDE - 2:
                    d = abs(j + 0.5 - CROSSED_AT[west if i < 2 else east]) if ends is across else d
                if j < 2 or j >= SIDE - 2:
                    d = abs(i + 0.5 - CROSSED_AT[north if j < 2 else south]) if ends is down else d
                texel = texel if d > BAND else RIM if d > BAND - LINE else BODY
            row += bytes(texel)
        rows.append(bytes(row))
    return rows


def write_png(file, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", SIDE, SIDE, 8, 2, 0, 0, 0)
    with open(file, "wb") as stream:
        stream.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                     chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows), 9)) + chunk(b"IEND", b""))


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: draw_tiles.py FOLDER")
    folder = sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    colors = [{"north": n, "east": e, "south": s, "west": w} for n in (0, 1) for e in (0, 1) for s in (0, 1) for w in (0, 1)]
    for number, sides in enumerate(colors):
        write_png(os.path.join(folder, f"tile_{number:02d}.png"), tile(**sides))
    with open(os.path.join(folder, "colors.json"), "w", encoding="utf-8") as stream:
        json.dump(colors, stream, indent=1)
        stream.write("\n")


if __name__ == "__main__":
    main()
