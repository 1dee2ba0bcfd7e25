"""tilepack validate: a good pack passes, every corruption of it fails with exit code 5 and its rule."""

import json
import os
import shutil
import unittest

import jsonschema

from command import SOURCE, CommandCase
from png_image import read_png, write_png


class Validate(CommandCase):
    def setUp(self):
        super().setUp()
        with open(os.path.join(SOURCE, "lib/tilepack/check/report.schema.json"), encoding="utf-8") as stream:
            self.schema = json.load(stream)
        self.noise_png("sample.png")
        self.run_tilepack("bake", "sample.png", "-o", "good", "--tile-size", 16, "--virtual-size", 16, "--effort", 0,
                          "--mapping", "permutation")
        self.restore()

    def restore(self):
        shutil.rmtree(self.path("pack"), ignore_errors=True)
        shutil.copytree(self.path("good"), self.path("pack"))

    def rules(self, code):
        """The rules that speak, from a report that keeps its schema."""
        report = json.loads(self.run_tilepack("validate", "pack", "--format", "json", code=code).stdout)
        jsonschema.validate(report, self.schema)
        self.assertEqual(report["passed"], code == 0)
        severities = [issue["severity"] for issue in report["issues"]]
        for severity in ("error", "warning", "note"):
            self.assertEqual(report["counts"][severity + "s"], severities.count(severity))
        return {issue["rule"] for issue in report["issues"]} - {"TP701"}  # sets of noise are poor: advice_test has that note

    def edit(self, change):
        document = self.read_json("pack/pack.json")
        change(document)
        self.write_json("pack/pack.json", document)

    def invert_texel(self, name, x, y):
        rows, channels, bits = read_png(self.path("pack", name))
        for c in range(channels):
            rows[y][x * channels + c] ^= 255
        write_png(self.path("pack", name), rows, channels, bits)

    def test_a_baked_pack_passes(self):
        self.assertEqual(self.rules(0), set())
        text = self.run_tilepack("validate", "pack/pack.json").stdout
        self.assertRegex(text, r"passed\. 0 errors, 0 warnings, . notes? \(16 tiles, 1 map, 5 images looked at\)\n$")

    def test_each_corruption_is_caught(self):
        def field(path, value):
            def change(document):
                *parents, last = path
                for step in parents:
                    document = document[step]
                document[last] = value
            return lambda: self.edit(change)

        def swap_cells(document):
            cells = document["layout"]["cells"]
            for key in ("column", "row"):
                cells[3][key], cells[12][key] = cells[12][key], cells[3][key]

        def double_entry(document):
            table = document["mapping"]["table"]
            table[0] = table[1]

        with open(self.path("good", "color_0.png"), "rb") as stream:
            whole = stream.read()
        wrong = self.path("pack", "color_0.png")
        corruptions = {
            "not JSON": ("TP101", lambda: self.write("pack/pack.json", "{")),
            "missing field": ("TP102", lambda: self.edit(lambda document: document.pop("mips"))),
            "unknown field": ("TP103", field(["layouts"], {})),
            "wrong type": ("TP104", field(["tile_size"], "32")),
            "out of range": ("TP105", field(["colors", "corner"], 9)),
            "overflow": ("TP105", field(["tile_size", 0], 2**40)),
            "contradiction": ("TP106", field(["tile_size"], [8, 8])),
            "missing file": ("TP201", lambda: os.unlink(self.path("pack", "color_2.png"))),
            "empty file": ("TP202", lambda: self.write("pack/color_2.png", "")),
            "truncated file": ("TP202", lambda: self.write("pack/color_0.png", whole[:-100])),
            "wrong size": ("TP203", lambda: shutil.copy(self.path("pack", "color_1.png"), wrong)),
            "wrong channels": ("TP204", lambda: write_png(wrong, [[0] * 64] * 64, 1)),
            "wrong depth": ("TP205", lambda: write_png(wrong, [[0] * 192] * 64, 3, 16)),
            "path out of the folder": ("TP206", field(["maps", 0, "levels", 0, "file"], "../good/color_0.png")),
            "file named twice": ("TP207", field(["maps", 0, "levels", 1, "file"], "color_0.png")),
            "tiles swapped": ("TP308", lambda: self.edit(swap_cells)),
            "border texel": ("TP403", lambda: self.invert_texel("color_0.png", 8, 0)),
            "border texel of a coarser level": ("TP409", lambda: self.invert_texel("color_1.png", 8, 3)),
            "no permutation": ("TP501", lambda: self.edit(double_entry)),
        }
        for name, (rule, spoil) in corruptions.items():
            with self.subTest(name):
                self.restore()
                spoil()
                self.assertIn(rule, self.rules(5))

    def corrupted(self, *options):
        """A pack of these bake options, and a function that spoils a field of it and expects a rule."""
        shutil.rmtree(self.path("good"))
        self.run_tilepack("bake", "sample.png", "-o", "good", "--tile-size", 16, "--virtual-size", 16, "--effort", 0,
                          *options)
        self.restore()
        self.assertEqual(self.rules(0), set())

        def expect(rule, path, change):
            with self.subTest(path=path, change=change):
                self.restore()
                document = self.read_json("pack/pack.json")
                place = document
                *parents, last = path
                for step in parents:
                    place = place[step]
                if change is None:
                    del place[last]
                else:
                    place[last] = change(place) if callable(change) else change
                self.write_json("pack/pack.json", document)
                self.assertIn(rule, self.rules(5))

        return expect

    def test_each_corruption_of_a_turned_pack_is_caught(self):
        expect = self.corrupted("--set", "sequential", "--scheme", "2,2")
        cells = ["layout", "cells"]
        expect("TP106", [*cells, 3, "origin"], [0.3, 0.3])  # between the places of the scheme
        expect("TP105", [*cells, 3, "origin"], [1.5, 0.5])
        expect("TP105", [*cells, 3, "origin"], [0.5])
        expect("TP305", [*cells, 3, "origin"], lambda _: self.read_json("pack/pack.json")["layout"]["cells"][4]["origin"])
        expect("TP106", [*cells, 3, "angle"], 44.9)
        expect("TP105", [*cells, 3, "angle"], 90)
        expect("TP102", [*cells, 3, "angle"], None)
        expect("TP106", [*cells, 3, "tile"], 4)  # a tile twice
        expect("TP106", [*cells, 3], None)  # a tile missing
        expect("TP106", ["layout", "gutter"], 3)
        expect("TP105", ["layout", "gutter"], -1)
        expect("TP106", ["layout", "k"], 1)
        expect("TP106", ["layout", "squares"], 2)
        expect("TP106", ["layout", "size"], [92, 92])
        expect("TP105", ["layout", "matching"], "perhaps")
        expect("TP102", ["maps", 0, "round_trip_psnr", "lanczos"], None)
        expect("TP104", ["maps", 0, "round_trip_psnr", "lanczos"], "30 dB")
        expect("TP106", ["tile_size"], [16, 8])
        expect("TP203", ["maps", 0, "levels", 0, "file"], "color_1.png")

        def swap(cells):
            cells[1]["origin"], cells[2]["origin"] = cells[2]["origin"], cells[1]["origin"]
            return cells[1]

        expect("TP308", [*cells, 1], swap)

    def test_each_corruption_of_a_layered_pack_is_caught(self):
        expect = self.corrupted("--layout", "array", "--border", 4)
        cells = ["layout", "cells"]
        expect("TP305", [*cells, 3, "layer"], 4)
        expect("TP105", [*cells, 3, "layer"], -1)
        expect("TP106", [*cells, 3, "layer"], 16)
        expect("TP106", [*cells, 3, "tile"], 4)
        expect("TP106", [*cells, 3], None)
        expect("TP106", ["layout", "layers"], 15)
        expect("TP106", ["layout", "border"], 2)
        expect("TP106", ["layout", "border"], 3)
        expect("TP105", ["layout", "border"], -1)
        expect("TP106", ["mips", "tile_levels"], 4)
        self.restore()
        self.invert_texel("color_0.png", 10, 25)  # above the tile of layer 1
        self.assertIn("TP408", self.rules(5))
        self.restore()
        self.invert_texel("color_1.png", 0, 13)
        self.assertIn("TP408", self.rules(5))

    def test_stray_files_are_a_note(self):
        self.write("pack/thumbs.db", "")
        self.assertEqual(self.rules(0), {"TP208"})
        shutil.copytree(self.path("pack"), self.path("pack", "inner"))
        self.assertEqual(self.rules(0), {"TP208"})
        self.assertIn("inner/", self.run_tilepack("validate", "pack").stdout)

    def test_text_says_what_where_and_how_to_mend(self):
        os.unlink(self.path("pack", "color_2.png"))
        text = self.run_tilepack("validate", "pack", code=5).stdout
        for part in ("error TP201: a file of the pack is missing\n", "  where     color_2.png\n", "  fix       ",
                     "FAILED. 1 error, 0 warnings, 0 notes"):
            self.assertIn(part, text)
        self.assertNotIn("\x1b", text)

    def test_reports_do_not_depend_on_threads(self):
        for x in range(0, 64, 3):
            self.invert_texel("color_0.png", x, 16)
        one = self.run_tilepack("validate", "pack", "--jobs", 1, code=5)
        four = self.run_tilepack("validate", "pack", "--jobs", 4, code=5)
        self.assertEqual(one.stdout, four.stdout)

    def test_nothing_to_check(self):
        for name in (".", "nothing", "pack/color_0.png/pack.json"):
            self.refused("validate", name, code=2)
        self.refused("validate", code=1, saying="PACK")
        self.refused("validate", "pack", "--format", "xml", code=1)
        self.refused("validate", "pack/color_0.png", code=2, saying="is no pack")

    def test_rules_are_listed(self):
        text = self.run_tilepack("validate", "--list-rules").stdout
        rules = json.loads(self.run_tilepack("validate", "--list-rules", "--format", "json").stdout)["rules"]
        self.assertGreater(len(rules), 30)
        for rule in rules:
            self.assertIn(rule["rule"] + " " + rule["severity"], text)


if __name__ == "__main__":
    unittest.main()
