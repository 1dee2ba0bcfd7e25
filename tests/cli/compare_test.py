"""tilepack compare: figures, limits, exit codes, packs and difference pictures."""

import json
import math
import os
import random
import unittest

import jsonschema

from command import SOURCE, CommandCase
from png_image import read_png, write_png


class Compare(CommandCase):
    def setUp(self):
        super().setUp()
        with open(os.path.join(SOURCE, "lib/tilepack/measure/compare.schema.json"), encoding="utf-8") as stream:
            self.schema = json.load(stream)
        source = random.Random(3)
        rows = [[source.randint(20, 230) for _ in range(64 * 3)] for _ in range(64)]
        for name in ("a.png", "same.png"):
            write_png(self.path(name), rows, 3)
        write_png(self.path("small.png"), rows[:32], 3)
        rows[10][20 * 3] += 4
        write_png(self.path("b.png"), rows, 3)

    def compare(self, a, b, *options, code):
        done = self.run_tilepack("compare", a, b, "--format", "json", *options, code=code)
        report = json.loads(done.stdout)
        jsonschema.validate(report, self.schema)
        self.assertEqual(report["within"], code == 0)
        return report

    def test_equal_images(self):
        report = self.compare("a.png", "same.png", code=0)
        self.assertTrue(report["equal"])
        self.assertIsNone(report["parts"][0]["psnr"])
        self.assertIn("a.png and same.png: equal\n", self.run_tilepack("compare", "a.png", "same.png").stdout)

    def test_one_changed_texel(self):
        part = self.compare("a.png", "b.png", code=5)["parts"][0]
        self.assertEqual([part["largest"][key] for key in ("x", "y", "channel")], [20, 10, 0])
        self.assertAlmostEqual(part["largest"]["difference"], 4, places=4)
        self.assertEqual(part["differing_texels"], 1)
        rms = 4 / math.sqrt(64 * 64 * 3)
        self.assertAlmostEqual(part["rms"], rms, places=5)
        self.assertAlmostEqual(part["psnr"], 20 * math.log10(255 / rms), places=3)

    def test_limits(self):
        self.compare("a.png", "b.png", "--max-difference", "4.001", code=0)
        self.compare("a.png", "b.png", "--max-difference", "3.999", code=5)
        self.compare("a.png", "b.png", "--min-psnr", "60", code=0)
        self.compare("a.png", "b.png", "--min-psnr", "60", "--min-ssim", "1", code=5)
        text = self.run_tilepack("compare", "a.png", "b.png", "--max-difference", "5").stdout
        self.assertIn("different, within the limits", text)

    def test_other_sizes_are_different(self):
        report = self.compare("a.png", "small.png", "--max-difference", "255", code=5)
        self.assertIn("64 x 32", report["parts"][0]["mismatch"])

    def test_difference_picture(self):
        self.compare("a.png", "b.png", "--picture", "difference.png", "--gain", "10", code=5)
        rows, channels, _ = read_png(self.path("difference.png"))
        self.assertEqual((len(rows), len(rows[0]), channels), (64, 192, 3))
        self.assertEqual(rows[10][60:63], [40, 0, 0])
        self.assertEqual(sum(map(sum, rows)), 40)
        self.refused("compare", "a.png", "small.png", "--picture", "none.png", code=3)

    def test_packs(self):
        for seed in (1, 2):
            self.run_tilepack("bake", "a.png", "-o", f"pack{seed}", "--tile-size", 16, "--effort", 0, "--seed", seed)
        report = self.compare("pack1", "pack1/pack.json", code=0)
        self.assertEqual([part["name"] for part in report["parts"]], [f"color, level {i}" for i in range(5)])
        report = self.compare("pack1", "pack2", code=5)
        self.assertIn("mapping: it chooses other tiles", report["facts"])
        self.refused("compare", "a.png", "pack1", code=1, saying=["pack1", "a.png"])
        self.refused("compare", "pack1", "pack1", "--picture", "p.png", code=1, saying="two images")

    def test_bad_arguments(self):
        self.refused("compare", "a.png", code=1)
        self.refused("compare", "a.png", "none.png", code=2, saying="none.png")
        self.refused("compare", "a.png", "b.png", "--max-difference", "-1", code=1)
        self.refused("compare", "a.png", "b.png", "--gain", "0", code=1)
        self.refused("compare", "a.png", "b.png", "--picture", "p.jpg", code=1, saying="p.jpg")


if __name__ == "__main__":
    unittest.main()
