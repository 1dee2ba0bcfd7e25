"""Samples packs by what lib/tilepack/pack/FORMAT.md says alone, and compares with tilepack render."""

import json
import os
import re
import unittest

from command import SOURCE, CommandCase
from png_image import read_png

M32, M64 = 2**32 - 1, 2**64 - 1


def mixed(w):
    w ^= w >> 30
    w = w * 0xBF58476D1CE4E5B9 & M64
    w ^= w >> 27
    w = w * 0x94D049BB133111EB & M64
    return w ^ w >> 31


def mix_word(seed, axis, x, y):
    increment = 0x9E3779B97F4A7C15
    start = mixed(seed) + (2 * axis + 1) * increment
    a, b = mixed(start & M64), mixed(start + increment & M64)
    k = (a & M32, a >> 32, b & M32, b >> 32)

    def mix_round(v, odd):
        v = v * odd & M32
        return v ^ v >> 15

    y ^= mix_round(x + k[0] & M32, 0x85EBCA6B)
    x ^= mix_round(y + k[1] & M32, 0xC2B2AE35)
    y ^= mix_round(x + k[2] & M32, 0x9E3779B1)
    x ^= mix_round(y + k[3] & M32, 0x27D4EB2F)
    return x


def mix_color(seed, axis, x, y, colors):
    return (mix_word(seed, axis, x, y) >> 16) * colors >> 16


def even_color(seed, pattern, x, y, colors):
    word = mix_word(seed, 2, x >> 6, y >> 6)
    u, v = (x + word) & 63, (y + (word >> 6)) & 63
    if word >> 12 & 1:
        u = 63 - u
    if word >> 13 & 1:
        v = 63 - v
    if word >> 14 & 1:
        u, v = v, u
    return (int(pattern[v][u]) + ((word >> 16) * colors >> 16)) % colors


def even_variant(seed, variants, x, y):
    word = mix_word(seed, 2, x >> 6, y >> 6)
    u, v = (x + word) & 63, (y + (word >> 6)) & 63
    if word >> 12 & 1:
        u = (62 - u) & 63
    if word >> 13 & 1:
        v = (62 - v) & 63
    if word >> 14 & 1:
        u, v = v, u
    return int(variants[v][u])


def tile_index(a, b):
    if a < b:
        return b * b + 2 * a
    if a == b:
        return (a + 1)**2 - 2 if a > 0 else 0
    return a * a + 2 * b - 1 if b > 0 else (a + 1)**2 - 1


class Sampler:
    """Nearest texels of level 0 of the first map."""

    def __init__(self, pack, folder):
        self.pack = pack
        self.mapping = pack["mapping"]
        self.rows, self.channels, _ = read_png(f"{folder}/{pack['maps'][0]['levels'][0]['file']}")
        if self.mapping["kind"] == "index":
            self.ids = read_png(f"{folder}/{self.mapping['file']}")[0]

    def lattice(self, family, x, y):
        width, height = self.mapping["virtual_size"]
        x, y = x % width, y % height
        name = {"H": "horizontal", "V": "vertical", "C": "corner"}[family]
        colors = self.pack["colors"][name]
        if self.mapping["kind"] == "mix":
            return mix_color(self.mapping["seed"], "HVC".index(family), x, y, colors)
        if self.mapping["kind"] == "even":
            return even_color(self.mapping["seed"], self.mapping["pattern"], x, y, colors)
        table = self.mapping["table"]
        entry = lambda i: table[i % len(table)]
        if family == "V":
            return entry(x + entry(2 * y)) % colors
        return entry(entry(x) + y) % colors

    def variant(self, x, y):
        count = self.pack.get("variants", 1)
        width, height = self.mapping["virtual_size"]
        x, y = x % width, y % height
        if count == 1:
            return 0
        if self.mapping["kind"] == "mix":
            return mix_color(self.mapping["seed"], 3, x, y, count)
        if self.mapping["kind"] == "even":
            return even_variant(self.mapping["seed"], self.mapping["variants"], x, y)
        table = self.mapping["table"]
        entry = lambda i: table[i % len(table)]
        return entry(entry(entry(x) + y) + x) % count

    def tile(self, x, y):
        colors = self.pack["colors"]
        if self.mapping["kind"] == "index":
            width, height = self.mapping["virtual_size"]
            return self.ids[y % height][x % width]
        if self.pack["coloring"] == "corner":
            nw, ne = self.lattice("C", x, y), self.lattice("C", x + 1, y)
            sw, se = self.lattice("C", x, y + 1), self.lattice("C", x + 1, y + 1)
            k = colors["corner"]
            return ((nw * k + ne) * k + sw) * k + se + self.variant(x, y) * k**4
        north, south = self.lattice("H", x, y), self.lattice("H", x, y + 1)
        west, east = self.lattice("V", x, y), self.lattice("V", x + 1, y)
        kh, kv = colors["horizontal"], colors["vertical"]
        return ((north * kv + east) * kh + south) * kv + west + self.variant(x, y) * (kh * kv)**2

    def texel(self, x, y):
        width, height = self.pack["tile_size"]
        cell = self.pack["layout"]["cells"][self.tile(x // width, y // height)]
        column, row = cell["column"] * width + x % width, cell["row"] * height + y % height
        return self.rows[row][column * self.channels:(column + 1) * self.channels]


class Format(CommandCase):
    def test_packs_sampled_by_the_page(self):
        sample = self.noise_png("sample.png", 64, 48)
        for arguments in (("--mapping", "mix"), ("--mapping", "permutation", "--colors", "2x3"), ("--mapping", "index"), (), ("--colors", 3, "--virtual-size", "70x90", "--seed", 5),
                          ("--mapping", "mix", "--colors", "3x1", "--seed", 2**53 - 1), ("--tile-size", "12x10"),
                          ("--variants", 2, "--virtual-size", "200x150"), ("--variants", 3, "--mapping", "mix", "--colors", "1x2"),
                          ("--variants", 2, "--mapping", "permutation"), ("--variants", 5, "--mapping", "index", "--colors", 1)):
            with self.subTest(arguments):
                self.run_tilepack("bake", sample, "-o", "out", "--tile-size", 8, "--effort", 0, "--virtual-size",
                                  "7x5", *arguments)
                x, y, width, height = -13, 21, 90, 70  # past the borders of the virtual texture on all sides
                self.run_tilepack("render", "out", "-o", "view.png", "--rect", f"{x},{y},{width},{height}",
                                  "--filter", "nearest")
                rows, _, _ = read_png(self.path("view.png"))
                sampler = Sampler(self.read_json("out/pack.json"), self.path("out"))
                for j in range(height):
                    expected = [v for i in range(width) for v in sampler.texel(x + i, y + j)]
                    self.assertEqual(rows[j], expected, f"row {j}")

    def test_the_examples_of_the_page(self):
        with open(os.path.join(SOURCE, "lib/tilepack/pack/FORMAT.md"), encoding="utf-8") as stream:
            page = stream.read().split("## Example", 1)[1]
        # An ellipsis stands for entries left out.
        corner, edge = (json.loads(re.sub(r",\s*…", "", text)) for text in re.findall(r"```json\n(.*?)```", page, re.DOTALL))
        sample = self.noise_png("sample.png", 128, 128)
        for example, options in ((corner, ("--tile-size", 128)), (edge, ("--coloring", "edge", "--tile-size", 128))):
            self.run_tilepack("bake", sample, "-o", "out", "--effort", 0, *options)
            written = self.read_json("out/pack.json")
            if example is corner:
                self.assertEqual(list(example), list(written))
            self.shown_in(example, written, "pack.json")

    def shown_in(self, example, written, where):
        """Every field and item of the example stands in what was written, figures of synthesis apart."""
        self.assertIs(type(example), type(written), where)
        if isinstance(example, dict):
            for name, value in example.items():
                self.assertIn(name, written, where)
                if "synthesis" not in where:
                    self.shown_in(value, written[name], f"{where}: {name}")
        elif where.endswith(": maps"):
            for one, other in zip(example, written, strict=True):
                self.shown_in(one, other, where)
        elif isinstance(example, list):
            for item in example:
                self.assertIn(item, written, where)
        else:
            self.assertEqual(example, written, where)

    def test_grid_cells_follow_the_closed_form(self):
        self.run_tilepack("bake", self.noise_png("sample.png"), "-o", "out", "--tile-size", 8, "--effort", 0,
                          "--colors", "3x2")
        pack = self.read_json("out/pack.json")
        for tile, cell in zip(pack["tiles"], pack["layout"]["cells"]):
            self.assertEqual((cell["column"], cell["row"]),
                             (tile_index(tile["west"], tile["east"]), tile_index(tile["north"], tile["south"])))


if __name__ == "__main__":
    unittest.main()
