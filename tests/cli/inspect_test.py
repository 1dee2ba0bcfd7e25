"""tilepack inspect: the summary in text and JSON, pictures as PNG and SVG."""

import base64
import json
import os
import unittest
import xml.etree.ElementTree as xml

import jsonschema

from command import SOURCE, CommandCase
from png_image import read_png


def magnified(rows, channels, factor):
    """Each texel as factor x factor pixels."""
    result = []
    for row in rows:
        texels = [row[i : i + channels] for i in range(0, len(row), channels)]
        result += [[value for texel in texels for _ in range(factor) for value in texel]] * factor
    return result


class Inspect(CommandCase):
    def setUp(self):
        super().setUp()
        with open(os.path.join(SOURCE, "lib/tilepack/report/inspect.schema.json"), encoding="utf-8") as stream:
            self.schema = json.load(stream)
        self.noise_png("sample.png")
        self.run_tilepack("bake", "sample.png", "-o", "pack", "--tile-size", 32, "--colors", "2x3", "--virtual-size",
                          "100x50", "--seed", 9, "--effort", 0)

    def summary(self, *options):
        summary = json.loads(self.run_tilepack("inspect", "pack", "--format", "json", *options).stdout)
        jsonschema.validate(summary, self.schema)
        return summary

    def test_json(self):
        summary = self.summary()
        self.assertEqual(summary["tile_size"], [32, 32])
        self.assertEqual(summary["colors"], {"horizontal": 2, "vertical": 3})
        self.assertEqual(len(summary["tiles"]), 36)
        self.assertEqual(summary["layout"], {"kind": "tile-index", "columns": 9, "rows": 4})
        self.assertEqual(summary["mapping"]["virtual_size"], [100, 50])
        self.assertEqual(summary["generator"]["seed"], 9)
        sides = (32, 16, 8, 4, 2, 1)
        self.assertEqual(summary["bytes"]["memory"], sum(9 * s * 4 * s * 3 for s in sides))
        self.assertEqual(summary["bytes"]["stored_whole"], sum(100 * s * 50 * s * 3 for s in sides))
        on_disk = {name: len(data) for name, data in self.contents("pack").items()}
        self.assertEqual(summary["bytes"]["files"], sum(on_disk.values()))
        self.assertEqual(summary["bytes"]["file_count"], len(on_disk))
        for level in summary["maps"][0]["levels"]:
            self.assertEqual(level["bytes"], on_disk[level["file"]])
        self.assertEqual(len(summary["seams"]["worst"]), 3)
        self.assertEqual(len(self.summary("--worst", 7)["seams"]["worst"]), 7)

    def test_figures_of_synthesis(self):
        stored = self.read_json("pack/pack.json")
        self.assertEqual(self.summary()["synthesis"], stored["synthesis"])
        line = next(l for l in self.run_tilepack("inspect", "pack").stdout.splitlines() if l.startswith("synthesis "))
        figures = stored["synthesis"]
        self.assertEqual(
            line, f"synthesis {100 * figures['coverage']:.0f} % of the sample shown, as varied as "
            f"{figures['distinct_tiles']:.1f} tiles; steps across cuts {figures['cut_mean']:.1f} (95 % below "
            f"{figures['cut_p95']:.1f}), in the sample {figures['sample_step']:.1f}, across borders "
            f"{figures['border_mean']:.1f}")
        del stored["synthesis"]  # as of tiles drawn by hand
        self.write_json("pack/pack.json", stored)
        self.assertNotIn("synthesis", self.summary())
        self.assertNotIn("synthesis", self.run_tilepack("inspect", "pack").stdout)

    def test_bake_says_the_same(self):
        for arguments in (("--set", "sequential", "--scheme", "2,2"), ("--interior", "quilt", "--corner-pack")):
            with self.subTest(arguments):
                done = self.run_tilepack("bake", "sample.png", "-o", "pack", "--tile-size", 16, "--virtual-size", 8,
                                         "--effort", 0, *arguments, "--report-format", "json")
                made, summary = json.loads(done.stdout), self.summary()
                self.assertEqual(made.get("rotated"), summary["layout"].get("rotated"))
                corners = summary.get("corner_pack")
                if corners:
                    del corners["maps"]
                self.assertEqual(made.get("corner_pack"), corners)
                self.assertEqual("rotated" in made, "--scheme" in arguments)
                self.assertEqual("corner_pack" in made, "--corner-pack" in arguments)
                for one, other in zip(made["maps"], summary["maps"], strict=True):
                    del other["levels"]
                    self.assertEqual(one, other)
                for name, value in summary["synthesis"].items():
                    self.assertEqual(made["synthesis"][name], value)

    def test_text(self):
        done = self.run_tilepack("inspect", "pack/pack.json")
        for part in ("36 of 32 x 32 texels, 2 horizontal and 3 vertical edge colors", "tile-index, 9 x 4 cells",
                     "100 x 50 tiles = 3200 x 1600 texels", "seed 9", "step across over step inside tiles"):
            self.assertIn(part, done.stdout)
        self.assertEqual(done.stderr, "")

    def test_png_pictures(self):
        self.summary("--picture", "p.png", "--preview", "e.png", "--tiles", 3)
        first, _, _ = read_png(self.path("p.png"))
        self.assertEqual((len(first[0]), len(first)), (9 * 96 * 3, 4 * 96))  # magnified three times
        preview, _, _ = read_png(self.path("e.png"))
        self.assertEqual((len(preview[0]), len(preview)), (3 * 96 * 3, 3 * 96))
        self.summary("--picture", "again.png")
        self.assertEqual(self.contents()["p.png"], self.contents()["again.png"])

    def test_bare_level_is_the_file(self):
        self.summary("--picture", "bare.png", "--bare", "--level", 1)
        level, channels, _ = read_png(self.path("pack", "color_1.png"))
        self.assertEqual(read_png(self.path("bare.png"))[0], magnified(level, channels, 6))

    def test_svg_picture(self):
        self.summary("--picture", "p.svg")
        root = xml.parse(self.path("p.svg")).getroot()
        space = "{http://www.w3.org/2000/svg}"
        self.assertEqual(sorted(int(text.text) for text in root.iter(space + "text")), list(range(36)))
        self.assertGreater(len(list(root.iter(space + "polygon"))), 36 * 4)
        data = next(root.iter(space + "image")).get("href").split(",", 1)[1]
        self.write("inside.png", base64.b64decode(data))
        level, channels, _ = read_png(self.path("pack", "color_0.png"))
        self.assertEqual(read_png(self.path("inside.png"))[0], magnified(level, channels, 3))

    def test_bad_arguments(self):
        self.refused("inspect", "nothing", code=2)
        self.refused("inspect", "pack", "--map", "colour", code=1, saying="'color'")
        self.refused("inspect", "pack", "--level", "9", "--picture", "x.png", code=1, saying="0 to 5")
        self.refused("inspect", "pack", "--level", "9", code=1, saying="0 to 5")
        self.refused("inspect", "pack", "--picture", "x.jpg", code=1, saying=".png")
        self.refused("inspect", "pack", "--picture", "pack/pack.json/x.svg", code=4, saying="x.svg")
        self.refused("inspect", "pack", "--picture", "pack/pack.json/x.png", code=4, saying="x.png")
        self.refused("inspect", "pack", "--tiles", "0", code=1, saying="tiles")


if __name__ == "__main__":
    unittest.main()
