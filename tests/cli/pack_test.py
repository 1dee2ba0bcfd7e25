"""tilepack pack: tiles drawn by hand, their colors in a JSON list."""

import itertools
import json
import struct
import unittest
import zlib

from command import CommandCase

SIDE = 32


def gray_png(rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    data = b"".join(b"\0" + bytes(row) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data)) +
            chunk(b"IEND", b""))


def line_art(north, east, south, west, side=SIDE):
    """Lines from the middle of the tile to its edges: where they meet an edge tells its color, as in the tiles drawn
    by hand in GPU Gems 2: color 0 meets it at a third of its length, color 1 at two thirds."""
    rows = [[255] * side for _ in range(side)]

    def meeting(color):
        return side // 3 if color == 0 else 2 * side // 3

    ends = [(meeting(north), 0), (side - 1, meeting(east)), (meeting(south), side - 1), (0, meeting(west))]
    middle = side // 2
    for end_x, end_y in ends:
        for step in range(4 * side + 1):
            share = step / (4 * side)
            x = end_x + (middle - end_x) * share
            y = end_y + (middle - end_y) * share
            # The last texels run straight into the border, so that all tiles of a color agree there.
            if end_y in (0, side - 1) and abs(y - end_y) < 2:
                x = end_x
            if end_x in (0, side - 1) and abs(x - end_x) < 2:
                y = end_y
            rows[int(y)][int(x)] = 0
    return rows


class Pack(CommandCase):
    def draw(self, tiles, draw=line_art):
        names = []
        for i, tile in enumerate(tiles):
            names.append(self.write(f"tile_{i:03}.png", gray_png(draw(*tile))))
        self.write_json("colors.json", [dict(zip(("north", "east", "south", "west"), tile)) for tile in tiles])
        return names

    def test_packed_kinds_are_roles_as_of_bake(self):
        names = []
        for i, tile in enumerate(self.complete()):
            names.append(self.noise_png(f"orm_{i:02}.png", SIDE, SIDE, seed=1))
        self.write_json("colors.json", [dict(zip(("north", "east", "south", "west"), tile)) for tile in self.complete()])
        for role, contents in (("orm", ["ao", "roughness", "metallic"]), ("arm", ["ao", "roughness", "metallic"]),
                               ("rma", ["roughness", "metallic", "ao"]), ("mrao", ["metallic", "roughness", "ao"])):
            with self.subTest(role):
                self.run_tilepack("pack", *names, "-o", role, "--colors", "colors.json", "--virtual-size", "8", "--role", role)
                made = self.read_json(f"{role}/pack.json")["maps"][0]
                self.assertEqual((made["name"], made["role"], made["contents"], made["encoding"]), (role, "data", contents, "linear"))
        self.run_tilepack("pack", *names, "-o", "n", "--colors", "colors.json", "--virtual-size", "8", "--role", "normal-dx")
        made = self.read_json("n/pack.json")["maps"][0]
        self.assertEqual((made["name"], made["role"], made["normal_y"]), ("normal", "normal", "down"))
        self.run_tilepack("pack", *names, "-o", "m", "--colors", "colors.json", "--virtual-size", "8", "--role", "orm", "--name", "mine")
        self.assertEqual(self.read_json("m/pack.json")["maps"][0]["name"], "mine")
        self.refused("pack", *names, "-o", "x", "--colors", "colors.json", "--role", "omr", code=1, saying=("--role", "did you mean 'orm'?", "mrao"))

    def complete(self):
        return list(itertools.product((0, 1), repeat=4))

    def pack(self, *arguments, code=0):
        return self.run_tilepack("pack", *arguments, "-o", "out", "--colors", "colors.json", "--virtual-size", "8",
                                 code=code)

    def test_line_art_packs_validates_and_renders(self):
        self.pack(*self.draw(self.complete()))
        pack = self.read_json("out/pack.json")
        self.assertEqual(pack["layout"]["kind"], "tile-index")
        self.assertEqual(len(pack["tiles"]), 16)
        self.assertGreaterEqual(pack["mips"]["guard"], 1)
        self.run_tilepack("validate", "out")
        self.run_tilepack("render", "out", "-o", "view.png", "--rect", "0,0,128,128")

    def test_the_order_of_the_drawings_does_not_matter(self):
        names = self.draw(self.complete())
        self.pack(*names)
        first = self.contents("out")
        tiles = self.complete()
        order = [7, 3, 12, 0, 15, 1, 9, 4, 2, 14, 6, 5, 11, 8, 10, 13]
        self.write_json("colors.json",
                        [dict(zip(("north", "east", "south", "west"), tiles[i])) for i in order])
        self.pack(*[names[i] for i in order])
        self.assertEqual(self.contents("out"), first)

    def test_incomplete_sets_go_into_rotated_textures_and_arrays(self):
        # Two tiles for each north and west color: the sequential set of eight.
        tiles = [(n, (w + j) % 2, (n + j) % 2, w) for n in (0, 1) for w in (0, 1) for j in (0, 1)]
        names = self.draw(tiles)
        for layout in (("rotated",), ("rotated", "--scheme", "2,2"), ("rotated", "--gutter", "3"), ("array",),
                       ("array", "--border", "4")):
            with self.subTest(layout):
                self.pack(*names, "--layout", *layout, "--mapping", "index")
                self.run_tilepack("validate", "out")
                self.run_tilepack("render", "out", "-o", "view.png", "--rect", "0,0,64,64", "--scale", "2")
                self.run_tilepack("inspect", "out", "--picture", "pack.png")

    def test_says_what_turning_loses_and_whether_neighbours_match(self):
        tiles = [(n, (w + j) % 2, (n + j) % 2, w) for n in (0, 1) for w in (0, 1) for j in (0, 1)]
        names = self.draw(tiles)
        turned = ("--layout", "rotated", "--scheme", "2,2", "--mapping", "index")
        text = self.pack(*names, *turned).stdout
        self.assertIn("2² + 2² by 45.00°", text)
        self.assertIn("neighbours match across all borders: no gutter", text)
        stored = self.read_json("out/pack.json")
        self.assertEqual(stored["layout"]["matching"], "found")
        psnr = stored["maps"][0]["round_trip_psnr"]
        self.assertEqual(list(psnr), ["bilinear", "bicubic", "lanczos"])
        self.assertLess(10, psnr["bilinear"])
        self.assertLess(psnr["bilinear"], psnr["lanczos"])
        self.assertIn(f"lanczos {psnr['lanczos']:.2f} dB", text)
        report = json.loads(self.pack(*names, *turned, "--report-format", "json").stdout)
        self.assertEqual(report["maps"][0]["round_trip_psnr"], psnr)
        self.assertEqual(report["rotated"]["matching"], "found")
        seen = json.loads(self.run_tilepack("inspect", "out", "--format", "json").stdout)
        self.assertEqual(seen["maps"][0]["round_trip_psnr"], psnr)
        self.assertEqual(seen["layout"]["rotated"]["matching"], "found")

        # Packs of before these fields were written.
        del stored["layout"]["matching"], stored["maps"][0]["round_trip_psnr"]
        self.write_json("out/pack.json", stored)
        self.run_tilepack("validate", "out")
        seen = json.loads(self.run_tilepack("inspect", "out", "--format", "json").stdout)
        self.assertEqual(seen["layout"]["rotated"]["matching"], "found")
        self.assertNotIn("round_trip_psnr", seen["maps"][0])
        self.assertIn("not measured", self.run_tilepack("inspect", "out").stdout)
        cells = stored["layout"]["cells"]
        cells[1]["origin"], cells[2]["origin"] = cells[2]["origin"], cells[1]["origin"]
        self.write_json("out/pack.json", stored)
        seen = json.loads(self.run_tilepack("inspect", "out", "--format", "json").stdout)
        self.assertEqual(seen["layout"]["rotated"]["matching"], "not-found")

        # Side by side the same tiles are copied, and nothing is lost.
        text = self.pack(*names, "--layout", "rotated", "--mapping", "index").stdout
        self.assertIn("lanczos exact", text)
        self.assertIsNone(self.read_json("out/pack.json")["maps"][0]["round_trip_psnr"]["lanczos"])

    def test_says_where_no_arrangement_matches(self):
        names = self.draw([(0, 0, 0, 0), (1, 1, 1, 1)])
        text = self.pack(*names, "--layout", "rotated", "--scheme", "1,1", "--mapping", "index").stdout
        self.assertIn("no arrangement has neighbours that all match: gutter 2", text)
        self.assertEqual(self.read_json("out/pack.json")["layout"]["matching"], "none")
        self.run_tilepack("validate", "out")
        self.assertIn("gutter 5", self.pack(*names, "--layout", "rotated", "--scheme", "1,1", "--mapping", "index",
                                            "--gutter", 5).stdout)

    def test_the_index_map_is_there_as_json(self):
        tiles = [(n, (w + j) % 2, (n + j) % 2, w) for n in (0, 1) for w in (0, 1) for j in (0, 1)]
        self.pack(*self.draw(tiles), "--layout", "array", "--mapping", "index")
        self.run_tilepack("inspect", "out", "--index-map", "map.json")
        rows = self.read_json("map.json")["tiles"]
        self.assertEqual((len(rows), len(rows[0])), (8, 8))
        for y in range(8):
            for x in range(8):
                here, east, south = (tiles[rows[b % 8][a % 8]] for a, b in ((x, y), (x + 1, y), (x, y + 1)))
                self.assertEqual(here[1], east[3])
                self.assertEqual(here[2], south[0])

    def test_corner_colors(self):
        def plain(*_):
            return [[90] * SIDE for _ in range(SIDE)]

        names = self.draw(self.complete(), plain)
        self.write_json("colors.json", [dict(zip(("nw", "ne", "sw", "se"), tile)) for tile in self.complete()])
        self.pack(*names)
        self.assertEqual(self.read_json("out/pack.json")["layout"]["kind"], "de-bruijn")
        self.run_tilepack("validate", "out")

    def test_says_where_drawings_disagree_and_by_how_much(self):
        names = self.draw(self.complete())
        rows = line_art(*self.complete()[5])
        rows[20][SIDE - 1] = 204  # on the east border of tile 5, whose color 1 tile 4 has too
        self.write(names[5], gray_png(rows))
        before = self.contents()
        done = self.pack(*names, code=5)
        self.assertIn("tile 5, east border (color 1)", done.stdout)
        self.assertIn(f"({SIDE - 1}, 20)", done.stdout)
        self.assertIn("0.2000", done.stdout)
        self.assertEqual(self.contents(), before)
        self.pack(*names, "--tolerance", "0.21")

    def test_color_lists_that_miss_or_repeat_a_combination(self):
        tiles = self.complete()
        self.refused("pack", *self.draw(tiles[:-1]), "-o", "out", "--colors", "colors.json", code=3,
                     saying=["no tile has north 1, east 1, south 1, west 1", "rotated and array"])
        self.refused("pack", *self.draw(tiles[:-1] + tiles[:1]), "-o", "out", "--colors", "colors.json", code=3,
                     saying="tiles 0 and 15 have the same edge colors")

    def test_bad_lists_sizes_and_counts(self):
        names = self.draw(self.complete())

        def refused(saying, code=3, tiles=names, arguments=()):
            self.refused("pack", *tiles, "-o", "out", "--colors", "colors.json", *arguments, code=code, saying=saying)

        self.write("odd.png", gray_png([[1] * SIDE for _ in range(SIDE + 1)]))
        refused(["odd.png", f"{SIDE} x {SIDE + 1}", "one size"], tiles=names[:-1] + ["odd.png"])
        refused("16 entries, and there are 15", tiles=names[:-1])
        refused("missing", code=2, tiles=names[:-1] + ["missing.png"])
        good = self.read_json("colors.json")
        for value, saying in ((8, "8"), (-1, "-1"), (1.5, "1.5"), ("0", '"0"'), (None, "null")):
            changed = json.loads(json.dumps(good))
            changed[3]["east"] = value
            self.write_json("colors.json", changed)
            refused(["[3].east", saying])
        changed = json.loads(json.dumps(good))
        changed[3]["top"] = 1
        self.write_json("colors.json", changed)
        refused("top")
        self.write_json("colors.json", [{"nw": 0, "ne": 0, "sw": 0, "se": 4}] * 16)
        refused("se")
        self.write("colors.json", "[{")
        refused("colors.json")
        self.write_json("colors.json", [])
        refused("colors.json")

    def test_counts_that_no_scheme_reaches_name_the_next_ones(self):
        tiles = self.complete()[:7]
        names = self.draw(tiles)
        self.refused("pack", *names, "-o", "out", "--colors", "colors.json", "--layout", "rotated", "--mapping",
                     "index", code=1, saying=["7 tiles", "5 and 8", "array"])


if __name__ == "__main__":
    unittest.main()
