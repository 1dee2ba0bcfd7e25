"""Makes the pictures of the sample scenes, from hashes and arithmetic alone: the same bytes everywhere.

    python3 make_pictures.py [FOLDER]     into FOLDER/made, beside the scenes unless told otherwise
"""

import math
import os
import struct
import sys
import zlib

SIDE = 64  # texels of a pattern


def write_png(path, width, height, channels, pixels):
    """pixels: a function of (x, y) to `channels` numbers of 0 to 1."""
    rows = bytearray()
    for y in range(height):
        rows.append(0)
        for x in range(width):
            value = pixels(x, y)
            for c in range(channels):
                rows.append(max(0, min(255, int((value[c] if channels > 1 else value) * 255 + 0.5))))
    kind = {1: 0, 3: 2, 4: 6}[channels]

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    with open(path, "wb") as stream:
        stream.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b""))


def hashed(x, y, seed):
    h = (x * 0x85EBCA6B + y * 0xC2B2AE35 + seed * 0x9E3779B1) & 0xFFFFFFFF
    for shift, odd in ((15, 0x2C1B3C6D), (12, 0x297A2D39)):
        h = ((h ^ (h >> shift)) * odd) & 0xFFFFFFFF
    return ((h ^ (h >> 15)) & 0xFFFFFF) / 0xFFFFFF


def noise(x, y, cells, seed):
    """Value noise on a torus of SIDE texels with so many cells a side."""
    u, v = x * cells / SIDE, y * cells / SIDE
    i, j = math.floor(u), math.floor(v)
    a, b = u - i, v - j
    a, b = a * a * (3 - 2 * a), b * b * (3 - 2 * b)
    corner = lambda p, q: hashed((i + p) % cells, (j + q) % cells, seed)
    return (corner(0, 0) * (1 - a) + corner(1, 0) * a) * (1 - b) + (corner(0, 1) * (1 - a) + corner(1, 1) * a) * b


def mixed(a, b, t):
    return tuple(p + (q - p) * t for p, q in zip(a, b))


def smooth(low, high, value):
    t = max(0.0, min(1.0, (value - low) / (high - low)))
    return t * t * (3 - 2 * t)


def layers(x, y, seed, finest=32):
    return 0.5 * noise(x, y, finest, seed) + 0.3 * noise(x, y, finest // 2, seed + 1) + 0.2 * noise(x, y, finest // 4, seed + 2)


def by_margin(x, y, shared, own):
    """`shared` at the border, `own` inside: so that all patterns of a family continue each other."""
    inside = min(x + 0.5, y + 0.5, SIDE - 0.5 - x, SIDE - 0.5 - y)
    return shared + (own - shared) * smooth(3, 12, inside)


def grass(x, y, number):
    value = by_margin(x, y, layers(x, y, 10), layers(x, y, 100 + 7 * number))
    color = mixed((0.16, 0.27, 0.08), (0.42, 0.55, 0.19), value)
    kind = number // 4  # 0: plain, 1: tufts, 2: white flowers, 3: red ones
    for k in range(5 if kind else 0):
        cx, cy = 14 + 36 * hashed(k, number, 3), 14 + 36 * hashed(k, number, 4)
        d = math.hypot(x - cx, y - cy)
        if kind == 1:
            color = mixed(color, (0.30, 0.44, 0.10), 0.8 * smooth(7, 3, d) * noise(x, y, 32, k))
        else:
            petal = 2.6 + 0.9 * math.cos(5 * math.atan2(y - cy, x - cx))
            color = mixed(color, (0.93, 0.92, 0.86) if kind == 2 else (0.78, 0.16, 0.12), smooth(petal + 0.7, petal - 0.7, d))
            color = mixed(color, (0.92, 0.72, 0.15), smooth(1.6, 0.6, d))
    return color


def sand(x, y, number):
    value = by_margin(x, y, layers(x, y, 20), layers(x, y, 300 + 7 * number))
    color = mixed((0.66, 0.55, 0.38), (0.86, 0.77, 0.58), value)
    if number % 2:
        for k in range(3):
            cx, cy, r = 14 + 36 * hashed(k, number, 5), 14 + 36 * hashed(k, number, 6), 2.5 + 3 * hashed(k, number, 7)
            d = math.hypot(x - cx, y - cy) / r
            color = mixed(color, (0.40, 0.33, 0.24), 0.7 * smooth(1.5, 0.9, math.hypot(x - cx - 1, y - cy - 1) / r))
            color = mixed(color, mixed((0.50, 0.46, 0.42), (0.74, 0.70, 0.64), smooth(cy + r, cy - r, y + x - cx)), smooth(1.1, 0.9, d))
    return color


def shore(x, y, code):
    """Transition tile: the materials at nw, ne, sw, se are the digits of `code`, 1 for grass."""
    nw, ne, sw, se = (code >> 3) & 1, (code >> 2) & 1, (code >> 1) & 1, code & 1
    u, v = (x + 0.5) / SIDE, (y + 0.5) / SIDE
    here = (nw * (1 - u) + ne * u) * (1 - v) + (sw * (1 - u) + se * u) * v
    edge = here + 0.5 * (layers(x, y, 30, 16) - 0.5)
    color = mixed(sand(x, y, 0), grass(x, y, 0), smooth(0.47, 0.53, edge))
    return mixed(color, (0.20, 0.20, 0.08), 0.45 * smooth(0.10, 0.0, abs(edge - 0.47)))


def leaf(x, y, kind):
    u, v = (x + 0.5) / SIDE * 2 - 1, (y + 0.5) / SIDE * 2 - 1
    along = (u + 0.9) / 1.75
    color = ((0.55, 0.33, 0.10), (0.70, 0.48, 0.12), (0.60, 0.18, 0.09), (0.42, 0.47, 0.14))[kind]
    if not 0 <= along <= 1:
        return (*color, 0 if along > 1 or abs(v) > 0.04 or u < -0.97 else 1)
    half = (0.42, 0.34, 0.5, 0.28)[kind] * math.sin(math.pi * along ** (0.8, 0.7, 1.0, 0.9)[kind])
    half *= 1 + (0.0, 0.10, 0.22, 0.0)[kind] * math.cos((0, 30, 18, 0)[kind] * along)
    vein = max(smooth(0.035, 0.01, abs(v)), 0.6 * smooth(0.05, 0.0, abs((along * 7 - abs(v) * 6) % 1 - 0.5)))
    shade = mixed(color, mixed(color, (1, 0.9, 0.5), 0.35), noise(x, y, 16, 40 + kind))
    shade = mixed(shade, tuple(0.55 * c for c in color), 0.7 * vein)
    return (*shade, smooth(half + 0.03, half - 0.03, abs(v)))


def lamp(x, y, frame, frames, side):
    light = math.sin(math.pi * frame / frames) if frame else 0.0
    u, v = (x + 0.5) / side * 2 - 1, (y + 0.5) / side * 2 - 1
    d = math.hypot(u, v)
    color = mixed((0.035, 0.035, 0.04), mixed((0.20, 0.03, 0.03), (1.0, 0.20, 0.10), light), smooth(0.80, 0.68, d))
    return mixed(color, (1.0, 0.85, 0.7), light * smooth(0.5, 0.0, d))


def flower(x, y, frame, frames):
    u, v = (x + 0.5) / SIDE * 2 - 1, (y + 0.5) / SIDE * 2 - 1
    open_ = frame / (frames - 1)
    d, angle = math.hypot(u, v), math.atan2(v, u)
    reach = 0.14 + open_ * (0.34 + 0.30 * abs(math.cos(2.5 * angle)))
    color, alpha = (0.25, 0.42, 0.12), smooth(0.17, 0.12, d)
    if open_ > 0:
        cover = smooth(reach + 0.03, reach - 0.03, d)
        color = mixed(color, mixed((0.62, 0.20, 0.62), (0.96, 0.75, 0.93), d / 0.8), cover)
        alpha = max(alpha, cover)
    return (*mixed(color, (0.97, 0.80, 0.20), smooth(0.15, 0.10, d) * open_), alpha)


def beetle(x, y):
    """It looks to the east."""
    u, v = (x + 0.5) / SIDE * 2 - 1, (y + 0.5) / SIDE * 2 - 1
    body, head = math.hypot(u / 0.60, v / 0.42), math.hypot((u - 0.62) / 0.24, v / 0.26)
    legs = min(abs(math.hypot(u - f, abs(v) - 0.62) - 0.30) for f in (-0.42, 0.0, 0.42)) if 0.3 < abs(v) < 0.80 else 1
    color, alpha = (0.07, 0.06, 0.06), max(smooth(1.05, 0.95, head), smooth(0.06, 0.03, legs))
    shell = mixed((0.60, 0.05, 0.04), (0.92, 0.30, 0.18), smooth(1.0, -0.4, body + 0.6 * v))
    spot = min(math.hypot(u - p, abs(v) - q) for p, q in ((-0.30, 0.20), (0.10, 0.22), (0.34, 0.0)))
    shell = mixed(shell, color, max(smooth(0.12, 0.08, spot), smooth(0.035, 0.015, abs(v))))
    cover = smooth(1.04, 0.96, body)
    return (*mixed(color, shell, cover), max(alpha, cover))


LETTERS = {"W": "10001 10001 10001 10101 10101 11011 10001", "A": "01110 10001 10001 11111 10001 10001 10001",
           "N": "10001 11001 10101 10101 10011 10001 10001", "G": "01111 10000 10000 10111 10001 10001 01111",
           "T": "11111 00100 00100 00100 00100 00100 00100", "I": "11111 00100 00100 00100 00100 00100 11111",
           "L": "10000 10000 10000 10000 10000 10000 11111", "E": "11111 10000 10000 11110 10000 10000 11111",
           "S": "01111 10000 10000 01110 00001 00001 11110", " ": "00000 " * 7}


def message(words, columns=64, rows=16):
    width = 6 * len(words) - 1
    left, top = (columns - width) // 2, (rows - 7) // 2

    def lit(x, y):
        column, row = x - left, y - top
        if not (0 <= column < width and 0 <= row < 7) or column % 6 == 5:
            return 1.0
        return 1.0 - int(LETTERS[words[column // 6]].split()[row][column % 6])

    return lit, columns, rows


def island(x, y, side=128):
    """The land of the landscape: 0 pebbles, 1 cracked mud, 2 meadow, 3 rock."""
    u, v = (x + 0.5) / side * 2 - 1, (y + 0.5) / side * 2 - 1
    x, y = x * SIDE / side, y * SIDE / side
    height = 0.9 - math.hypot(u, v) + 0.8 * (layers(x, y, 50, 16) - 0.5) + 0.35 * (noise(x, y, 4, 53) - 0.5)
    return 3 if height > 0.55 else 2 if height > 0.12 else 1 if height > -0.04 else 0


def main():
    folder = os.path.join(sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__)), "made")
    os.makedirs(folder, exist_ok=True)

    def picture(name, side, channels, pixels):
        write_png(os.path.join(folder, name), side, side, channels, pixels)

    for n in range(16):
        picture(f"grass_{n}.png", SIDE, 3, lambda x, y: grass(x, y, n))
        picture(f"shore_{n}.png", SIDE, 3, lambda x, y: shore(x, y, n))
    for n in range(8):
        picture(f"sand_{n}.png", SIDE, 3, lambda x, y: sand(x, y, n))
        picture(f"flower_{n}.png", SIDE, 4, lambda x, y: flower(x, y, n, 8))
    for n in range(4):
        picture(f"leaf_{n}.png", SIDE, 4, lambda x, y: leaf(x, y, n))
    for n in range(12):
        picture(f"lamp_{n}.png", 16, 3, lambda x, y: lamp(x, y, n, 12, 16))
    picture("beetle.png", SIDE, 4, beetle)
    for name, words in (("wang", "WANG"), ("tiles", "TILES")):
        lit, columns, rows = message(words)
        write_png(os.path.join(folder, f"{name}.png"), columns, rows, 1, lit)
    picture("island.png", 128, 1, lambda x, y: island(x, y) / 255)


if __name__ == "__main__":
    main()
