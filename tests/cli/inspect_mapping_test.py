"""tilepack inspect --mapping: statistics of hash tables and of the mixing hash, as text, JSON and a picture."""

import json
import unittest

from command import CommandCase
from png_image import read_png


class InspectMapping(CommandCase):
    def bake(self, *options):
        self.noise_png("sample.png")
        self.run_tilepack("bake", "sample.png", "-o", "pack", "--tile-size", 16, "--effort", 0, "--virtual-size", 64,
                          "--seed", 3, *options)

    def report(self):
        return json.loads(self.run_tilepack("inspect", "pack", "--mapping", "--format", "json").stdout)

    def test_the_default_shows_no_pattern(self):
        self.bake()
        report = self.report()
        self.assertEqual(report["window"], [64, 64])
        self.assertEqual(report["mappings"][0]["faults"], [])
        names = [each["name"] for each in report["mappings"]]
        self.assertEqual((names[0], names[-1]), ("even", "mix"))
        self.assertEqual(len(names), len(set(names)))
        self.assertIn("no fault found", self.run_tilepack("inspect", "pack", "--mapping").stdout)

    def test_tables_of_8_to_4096_entries(self):
        self.bake("--coloring", "edge")
        tables = {each["table_size"]: each for each in self.report()["mappings"] if each["kind"] == "permutation"}
        self.assertEqual(sorted(tables), [8, 16, 32, 64, 65, 128, 256, 512, 1024, 2048, 4096])
        vertical = {size: each["families"][2] for size, each in tables.items()}
        self.assertEqual(vertical[64]["name"], "vertical edges")
        self.assertIn(vertical[64]["period"]["columns"], (8, 16, 32))  # 2y mod 64 repeats after 32 rows
        self.assertEqual(vertical[65]["period"]["columns"], 0)
        self.assertEqual(vertical[128]["period"]["columns"], 0)
        copied = tables[128]["families"][1]["longest_repeat"]["columns"]
        self.assertGreater(copied["length"], 55)

    def test_faults_of_a_table_are_named(self):
        self.bake("--mapping", "permutation")
        self.assertEqual(self.report()["mappings"][0]["name"], "permutation 128")
        self.assertIn("occur twice", self.run_tilepack("inspect", "pack", "--mapping").stdout)

    def test_picture(self):
        self.bake()
        self.run_tilepack("inspect", "pack", "--mapping", "--picture", "mapping.png")
        rows, channels, _ = read_png(self.path("mapping.png"))
        self.assertEqual(channels, 3)
        self.assertGreater(len(rows[0]) // channels, 4 * 192)
        self.assertGreater(len(rows), 4 * 192)

    def test_corner_coloring_and_index_maps(self):
        self.bake("--mapping", "index")
        self.assertEqual(len(self.report()["mappings"][0]["families"]), 1)


if __name__ == "__main__":
    unittest.main()
