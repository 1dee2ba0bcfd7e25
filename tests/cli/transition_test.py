"""tilepack bake --transition: materials as corner colors, from files and folders, and what is refused."""

import json
import os
import re
import unittest

import jsonschema

from command import SOURCE, CommandCase
from png_image import read_png, write_png

SMALL = ("--tile-size", 16, "--effort", 0, "--virtual-size", 8)


class Transition(CommandCase):
    def setUp(self):
        super().setUp()
        self.toned("dark.png", 0)
        self.toned("bright.png", 180)

    def toned(self, name, least, width=64, height=64, channels=3, seed=1):
        """Noise of values least to least + 60, so that a value tells its material."""
        self.noise_png("noise.png", width, height, channels, seed=seed)
        rows, _, _ = read_png(self.path("noise.png"))
        write_png(self.path(name), [[least + v * 60 // 255 for v in row] for row in rows], channels)
        os.remove(self.path("noise.png"))
        return name

    def bake(self, *arguments, materials=("dark.png", "bright.png"), output="out", **options):
        return self.run_tilepack("bake", "--transition", *materials, "-o", output, *SMALL, *arguments, **options)

    def pack(self, output="out"):
        return self.read_json(output + "/pack.json")

    def test_writes_a_pack_whose_corner_colors_are_materials(self):
        said = self.bake().stdout
        self.assertIn("64 tiles of 16 x 16 texels", said)
        self.assertRegex(said, r"(?s)quality.*\d+ % dark, \d+ % bright")
        pack = self.pack()
        self.assertEqual((pack["materials"], pack["colors"], pack["variants"]), (["dark", "bright"], {"corner": 2}, 4))
        with open(os.path.join(SOURCE, "lib/tilepack/pack/pack.schema.json"), encoding="utf-8") as stream:
            jsonschema.Draft202012Validator(json.load(stream)).validate(pack)
        self.run_tilepack("validate", "out")
        self.run_tilepack("render", "out", "-o", "seen.png", "--rect=0,0,64,64")
        self.assertIn("materials 0 dark (orange in pictures), 1 bright (blue in pictures)",
                      self.run_tilepack("inspect", "out").stdout)
        shown = json.loads(self.run_tilepack("inspect", "out", "--format", "json").stdout)
        self.assertEqual(shown["materials"], ["dark", "bright"])

    def test_four_colors_are_two_for_each_material(self):
        self.bake("--colors", 4)
        pack = self.pack()
        self.assertEqual((pack["materials"], len(pack["tiles"])), (["dark", "dark", "bright", "bright"], 256))
        self.assertNotIn("variants", pack)
        self.run_tilepack("validate", "out")

    def test_texels_are_of_one_sample_or_the_other(self):
        self.bake("--mips", "none", "--variants", 1)
        pack = self.pack()
        rows, channels, _ = read_png(self.path("out/color_0.png"))
        for cell in pack["layout"]["cells"]:
            tile = pack["tiles"][cell["tile"]]
            corners = [tile[name] for name in ("nw", "ne", "sw", "se")]
            values = [v for row in rows[16 * cell["row"]:16 * cell["row"] + 16]
                      for v in row[16 * channels * cell["column"]:16 * channels * (cell["column"] + 1)]]
            self.assertTrue(all(v <= 60 or v >= 180 for v in values))
            bright = sum(v >= 180 for v in values) / len(values)
            if sum(corners) in (0, 4):
                self.assertEqual(bright, sum(corners) / 4)
            else:
                self.assertAlmostEqual(bright, sum(corners) / 4, delta=0.35)

    def test_same_bytes_for_one_and_three_threads(self):
        self.bake("--jobs", 1, output="one")
        self.bake("--jobs", 3, output="three")
        self.assertEqual(self.contents("one"), self.contents("three"))
        self.bake("--seed", 1, output="other")
        self.assertNotEqual(self.contents("one")["color_0.png"], self.contents("other")["color_0.png"])

    def test_three_materials_of_unequal_size_with_maps_in_folders(self):
        for name, least, side in (("sand", 0, 48), ("moss", 90, 64), ("rock", 180, 56)):
            os.mkdir(self.path(name))
            self.toned(f"{name}/{name}_albedo.png", least, side, side)
            self.toned(f"{name}/{name}_height.png", least, side, side, channels=1, seed=2)
        self.bake("--variants", 1, "--mips", "none", materials=("sand", "moss/", "rock"))
        pack = self.pack()
        self.assertEqual(pack["materials"], ["sand", "moss", "rock"])
        self.assertEqual([m["name"] for m in pack["maps"]], ["color", "height"])
        colors, _, _ = read_png(self.path("out/color_0.png"))
        heights, _, _ = read_png(self.path("out/height_0.png"))
        unlike = sum(colors[y][3 * x] // 90 != heights[y][x] // 90
                     for y in range(len(heights)) for x in range(len(heights[0])))
        self.assertEqual(unlike, 0, "color and height show different materials")
        self.run_tilepack("validate", "out")

    def test_a_report_shows_each_material(self):
        self.bake("--report", "out.html", "--variants", 2)
        with open(self.path("out.html"), encoding="utf-8") as stream:
            page = stream.read()
        self.assertIn("dark to bright", page)
        self.assertIn("<h2>Materials</h2>", page)
        self.assertTrue(re.search(r"<td>1</td><td>bright</td><td>64 x 64</td>", page))
        facts = json.loads(self.bake("--report-format", "json").stdout)
        self.assertEqual([m["name"] for m in facts["transition"]["materials"]], ["dark", "bright"])

    def test_what_does_not_go_together_is_said(self):
        self.toned("grey.png", 90, channels=1)
        for materials, options, code, saying in (
                (("dark.png",), (), 1, ("--transition", "2 to 4 materials", "1 is given")),
                (("dark.png",) * 5, (), 1, ("2 to 4 materials", "5 are given")),
                ((), (), 1, "2 to 4 materials"),
                (("dark.png", "grey.png"), (), 3, ("grey.png", "1 channel")),
                (("dark.png", "missing.png"), (), 2, "missing.png"),
                (("dark.png", "bright.png"), ("--coloring", "edge"), 1, ("--coloring", "--transition")),
                (("dark.png", "bright.png"), ("--colors", 3), 1, ("--colors", "of 2 materials", "use 2, or 4")),
                (("dark.png", "bright.png"), ("--map", "height=grey.png"), 1, ("--map", "folder")),
                (("dark.png", "bright.png"), ("--apply-advice",), 1, "--apply-advice"),
                (("dark.png", "bright.png"), ("--tile-size", 128), 3, ("dark.png", "too few")),
                (("dark.png", "bright.png"), ("--variants", 9), 1, "1 to 8")):
            with self.subTest(materials=materials, options=options):
                self.refused("bake", "--transition", *materials, "-o", "no", *SMALL, *options, code=code, saying=saying)
        self.refused("bake", "dark.png", "bright.png", "-o", "no", *SMALL, code=1,
                     saying=("unexpected argument 'bright.png'", "--transition"))

    def test_a_grade_can_be_required(self):
        done = self.run_tilepack("bake", "--transition", "dark.png", "bright.png", "-o", "no", *SMALL, "--require",
                                 "good", code=5)
        self.assertIn("quality", done.stdout)
        self.assertFalse(os.path.exists(self.path("no")))


if __name__ == "__main__":
    unittest.main()
