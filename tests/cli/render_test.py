"""`tilepack render` against a pack written here by hand, texel by texel."""

import json
import os
import random
import re
import shutil
import subprocess
import tempfile
import unittest

from png_image import read_png, write_png

TILEPACK = os.environ["TILEPACK"]
TILE = 8
LEVELS = 4
WIDTH, HEIGHT = 16, 12  # of the virtual texture, in tiles
STRIP = {(0, 0): 0, (0, 1): 1, (1, 1): 2, (1, 0): 3}  # TileIndex1D for two colors


class SmallPack:
    """16 tiles of 8 x 8 random texels with two edge colors, maps `color` and `height`, permutation hash."""

    def __init__(self, folder):
        rng = random.Random(5)
        os.makedirs(folder)
        self.table = rng.sample(range(32), 32)
        self.levels = {}
        tiles, cells = [], []
        for n in range(2):
            for e in range(2):
                for s in range(2):
                    for w in range(2):
                        cells.append({"tile": len(tiles), "column": STRIP[w, e], "row": STRIP[n, s]})
                        tiles.append({"id": len(tiles), "north": n, "east": e, "south": s, "west": w})
        maps = []
        for name, role, encoding, channels, bits in (
            ("color", "color", "srgb", 3, 8),
            ("height", "height", "linear", 1, 16),
        ):
            files = []
            for level in range(LEVELS):
                side = 4 * TILE >> level
                rows = [[rng.randrange(1 << bits) for _ in range(side * channels)] for _ in range(side)]
                self.levels[name, level] = rows
                file = "%s_%d.png" % (name, level)
                write_png(os.path.join(folder, file), rows, channels, bits)
                files.append({"file": file, "size": [side, side]})
            maps.append({"name": name, "role": role, "encoding": encoding, "depth": "u%d" % bits,
                         "channels": channels, "levels": files})
        pack = {
            "format": "tilepack",
            "version": 1,
            "generator": {"name": "tilepack", "version": "0", "options": {}, "seed": 0},
            "tile_size": [TILE, TILE],
            "coloring": "edge",
            "colors": {"horizontal": 2, "vertical": 2},
            "tiles": tiles,
            "layout": {"kind": "tile-index", "columns": 4, "rows": 4, "cells": cells},
            "maps": maps,
            "mapping": {"kind": "permutation", "virtual_size": [WIDTH, HEIGHT], "table": self.table},
            "mips": {"filter": "box", "sanitize": "edges", "guard": 0, "tile_levels": LEVELS},
        }
        with open(os.path.join(folder, "pack.json"), "w") as file:
            json.dump(pack, file)

    def horizontal(self, x, y):  # [Wei04, Eq. 2]
        p = self.table
        return p[(p[x % WIDTH] + y % HEIGHT) % 32] % 2

    def vertical(self, x, y):
        p = self.table
        return p[(x % WIDTH + p[2 * (y % HEIGHT) % 32]) % 32] % 2

    def texel(self, name, level, x, y, channels):
        side = TILE >> level
        cx, cy = x // side, y // side
        column = STRIP[self.vertical(cx, cy), self.vertical(cx + 1, cy)]
        row = STRIP[self.horizontal(cx, cy), self.horizontal(cx, cy + 1)]
        at = (column * side + x % side) * channels
        return self.levels[name, level][row * side + y % side][at : at + channels]


class Render(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.pack_folder = os.path.join(cls.folder, "pack")
        cls.pack = SmallPack(cls.pack_folder)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.out = tempfile.mkdtemp(dir=self.folder)
        self.file = os.path.join(self.out, "picture.png")

    def run_render(self, *options, output=None, pack=None):
        command = [TILEPACK, "render", pack or self.pack_folder, "-o", output or self.file, *options]
        return subprocess.run(command, capture_output=True, text=True)

    def rendered(self, *options):
        result = self.run_render(*options)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, rf"\A{re.escape(self.file)}: \d+ x \d+ pixels of the \w+ map\n\Z")
        self.assertEqual(result.stderr, "")
        return read_png(self.file)

    def refused(self, code, *options, output=None, pack=None, says=""):
        result = self.run_render(*options, output=output, pack=pack)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertIn(says, result.stderr)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.assertEqual(os.listdir(self.out), [], "something was left behind")

    def assert_window(self, got, name, level, rect, channels):
        x, y, width, height = rect
        for j in range(height):
            wanted = []
            for i in range(width):
                wanted += self.pack.texel(name, level, x + i, y + j, channels)
            self.assertEqual(got[j], wanted, "row %d" % j)
        self.assertEqual(len(got), height)

    def test_default_is_the_first_8_by_8_tiles(self):
        rows, channels, bits = self.rendered()
        self.assertEqual((channels, bits), (3, 8))
        self.assert_window(rows, "color", 0, (0, 0, 8 * TILE, 8 * TILE), 3)

    def test_any_window_of_any_level(self):
        for level, rect in ((0, (-5, -9, 40, 30)), (1, (30, 20, 50, 50)), (3, (-7, 3, 20, 20)),
                            (0, (WIDTH * TILE - 3, HEIGHT * TILE - 3, 6, 6))):
            rows, _, _ = self.rendered("--level", str(level), "--rect=%d,%d,%d,%d" % rect)
            self.assert_window(rows, "color", level, rect, 3)

    def test_what_lies_beyond_the_border(self):
        width, height = WIDTH * TILE, HEIGHT * TILE
        places = {
            "wrap": lambda i, n: i % n,
            "clamp": lambda i, n: min(max(i, 0), n - 1),
            "mirror": lambda i, n: i % (2 * n) if i % (2 * n) < n else 2 * n - 1 - i % (2 * n),
        }
        for border, place in places.items():
            rows, _, _ = self.rendered("--border", border, "--rect=-9,-5,150,110")
            for j in (0, 3, 5, 50, 109):
                wanted = []
                for i in range(150):
                    wanted += self.pack.texel("color", 0, place(i - 9, width), place(j - 5, height), 3)
                self.assertEqual(rows[j], wanted, "%s, row %d" % (border, j))

    def test_elliptical_at_scale_1_is_the_texels_and_far_away_the_mean(self):
        rows, _, _ = self.rendered("--rect=3,4,20,10", "--filter", "elliptical")
        for j, row in enumerate(rows):  # by way of linear light: a code off at most
            for got, wanted in zip(row, sum((self.pack.texel("color", 0, 3 + i, 4 + j, 3) for i in range(20)), [])):
                self.assertLessEqual(abs(got - wanted), 1)
        rows, _, _ = self.rendered("--rect=0,0,3200,1600", "--scale", "0.01", "--filter", "elliptical")
        self.assertEqual((len(rows), len(rows[0])), (16, 96))
        for c in range(3):
            column = [value for row in rows for value in row[c::3]]
            self.assertLess(max(column) - min(column), 60)  # texels of the coarsest level span 0..255

    def test_rect_may_be_a_separate_argument(self):
        rows, _, _ = self.rendered("--rect", "-3,-4,9,8")
        self.assert_window(rows, "color", 0, (-3, -4, 9, 8), 3)

    def test_another_map_keeps_its_depth(self):
        rows, channels, bits = self.rendered("--map", "height", "--rect=0,0,20,20")
        self.assertEqual((channels, bits), (1, 16))
        self.assert_window(rows, "height", 0, (0, 0, 20, 20), 1)

    def test_magnified_nearest_repeats_texels(self):
        rows, _, _ = self.rendered("--rect=-2,5,10,10", "--scale", "3", "--filter", "nearest")
        self.assertEqual((len(rows), len(rows[0])), (30, 90))
        for y in range(30):
            for x in range(30):
                wanted = self.pack.texel("color", 0, -2 + x // 3, 5 + y // 3, 3)
                self.assertEqual(rows[y][3 * x : 3 * x + 3], wanted)

    def test_half_scale_is_the_next_level(self):
        rows, _, _ = self.rendered("--map", "height", "--rect=16,8,32,32", "--scale", "0.5")
        self.assert_window(rows, "height", 1, (8, 4, 16, 16), 1)

    def test_fractional_scale(self):
        rows, _, _ = self.rendered("--rect=0,0,30,20", "--scale", "1.25", "--filter", "bilinear")
        self.assertEqual((len(rows), len(rows[0])), (25, 38 * 3))

    def test_encoding_can_be_asked_for(self):
        plain, _, _ = self.rendered("--rect=0,0,9,9")
        linear, _, _ = self.rendered("--rect=0,0,9,9", "--encoding", "linear")

        def decoded(code):
            v = code / 255
            return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4

        for a, b in zip(sum(plain, []), sum(linear, [])):
            self.assertLessEqual(abs(decoded(a) * 255 - b), 0.51)

    def test_exr_is_written(self):
        file = os.path.join(self.out, "picture.exr")
        result = self.run_render(output=file)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(file, "rb") as exr:
            self.assertEqual(exr.read(4), b"\x76\x2f\x31\x01")
        self.assertEqual(os.listdir(self.out), ["picture.exr"])

    def test_threads_change_nothing(self):
        files = []
        for jobs in ("1", "4"):
            self.rendered("--scale", "0.7", "--jobs", jobs)
            with open(self.file, "rb") as file:
                files.append(file.read())
        self.assertEqual(files[0], files[1])

    def test_pack_json_names_the_pack_too(self):
        result = self.run_render("--rect=0,0,4,4", pack=os.path.join(self.pack_folder, "pack.json"))
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_unknown_map(self):
        self.refused(1, "--map", "colour", says="color, height")

    def test_level_not_stored(self):
        self.refused(1, "--level", "4", says="levels 0 to 3")
        self.refused(1, "--level", "-1", says="0 to 30")

    def test_bad_windows(self):
        for rect in ("0,0,0,5", "0,0,5,-1", "1,2,3", "1,2,3,4,5", "a,b,c,d", "0,0,70000,1", "0,0,99999999999,1",
                     "0,0,99999999999999999999,1", "1e3,0,5,5", ""):
            self.refused(1, "--rect=" + rect)
        self.refused(1, "--rect=%d,0,5,5" % (1 << 60), says="2^50")

    def test_bad_scales(self):
        for scale in ("0", "-1", "nan", "inf", "1e30", "two"):
            self.refused(1, "--scale", scale)

    def test_bad_filter_and_encoding(self):
        self.refused(1, "--border", "repeat", says="wrap, clamp and mirror")
        self.refused(1, "--filter", "cubic", says="nearest, bilinear, trilinear and elliptical")
        self.refused(1, "--encoding", "rec709", says="srgb or linear")

    def test_output_that_is_no_picture(self):
        for name in ("picture.jpg", "picture", "picture.PNG.txt"):
            self.refused(1, output=os.path.join(self.out, name), says=".png or .exr")

    def test_output_that_cannot_be_written(self):
        self.refused(4, output=os.path.join(self.folder, "pack", "pack.json", "picture.png"))
        folder = os.path.join(self.folder, "folder.png")
        os.makedirs(folder, exist_ok=True)
        self.refused(4, output=folder)

    def test_pack_that_is_not_there(self):
        self.refused(2, pack=os.path.join(self.folder, "nowhere"))


if __name__ == "__main__":
    unittest.main()
