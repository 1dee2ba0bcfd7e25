"""tilepack layouts: the table and the advice, in text and JSON."""

import json
import unittest

from command import CommandCase


class Layouts(CommandCase):
    def table(self, *arguments):
        return json.loads(self.run_tilepack("layouts", "--format", "json", *arguments).stdout)

    def test_lists_the_counts_of_the_paper_up_to_200(self):
        def reachable(count):
            prime = 2
            while count > 1:
                power = 0
                while count % prime == 0:
                    count //= prime
                    power += 1
                if prime % 4 == 3 and power % 2:
                    return False
                prime += 1
            return True

        listed = [row["tiles"] for row in self.table()["layouts"]]
        self.assertEqual(listed, [n for n in range(1, 201) if reachable(n)])

    def test_every_plan_holds_its_tiles_and_says_what_it_wastes(self):
        for row in self.table("--tile-size", "96")["layouts"]:
            self.assertEqual([p["wasted_texels"] for p in row["plans"]],
                             sorted(p["wasted_texels"] for p in row["plans"]))
            for plan in row["plans"]:
                width, height = plan["size"]
                self.assertEqual(plan["squares"] * (plan["n"] ** 2 + plan["k"] ** 2), row["tiles"])
                self.assertEqual(width * height, row["tiles"] * 96 * 96 + plan["wasted_texels"])
                self.assertGreaterEqual(plan["wasted_texels"], 0)
                self.assertEqual(width, plan["squares"] * height)

    def test_padding_is_what_powers_of_two_would_waste(self):
        rows = {row["tiles"]: row for row in self.table("--up-to", "20")["layouts"]}
        self.assertEqual(rows[5]["padded_percent"], 37.5)
        self.assertEqual(rows[16]["padded_percent"], 0.0)

    def test_advice_names_schemes_and_neighbouring_counts(self):
        text = self.run_tilepack("layouts", "--tiles", "18").stdout
        self.assertIn("--scheme 3,3", text)
        self.assertIn("17 and 20", text)

    def test_power_of_two_sides(self):
        for plan in json.loads(self.run_tilepack("layouts", "--tiles", "13", "--power-of-two", "--format",
                                                 "json").stdout)["plans"]:
            for side in plan["size"]:
                self.assertEqual(side & (side - 1), 0)

    def test_measures_what_turning_loses(self):
        self.noise_png("sample.png", 128, 128)
        plans = json.loads(self.run_tilepack("layouts", "--tiles", "10", "--tile-size", "48", "--sample",
                                             "sample.png", "--format", "json").stdout)["plans"]
        for plan in plans:
            psnr = plan["psnr"]
            self.assertEqual(list(psnr), ["bilinear", "bicubic", "lanczos"])
            self.assertLess(psnr["bilinear"], psnr["bicubic"])
            self.assertLess(psnr["bicubic"], psnr["lanczos"])
        copied = json.loads(self.run_tilepack("layouts", "--tiles", "8", "--tile-size", "48", "--sample",
                                              "sample.png", "--format", "json").stdout)["plans"][0]
        self.assertIsNone(copied["psnr"]["lanczos"])
        self.refused("layouts", "--sample", "sample.png", code=1, saying="--tiles")

    def test_counts_without_a_scheme_name_the_next_ones(self):
        self.refused("layouts", "--tiles", "7", code=1, saying=["7 tiles", "5 and 8"])
        self.refused("layouts", "--tiles", "0", code=1)
        self.refused("layouts", "--tiles", "5", "--gutter", "-1", code=1)


if __name__ == "__main__":
    unittest.main()
