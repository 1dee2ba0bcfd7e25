"""Single files that public bug reports are about: alpha, channels, profiles. The files lie beside the project."""

import os
import unittest

from command import SOURCE, CommandCase
from png_image import read_png

CASES = os.path.join(SOURCE, "..", "shared", "cases")
SMALL = ["--tile-size", 16, "--effort", 0, "--mips", "box"]


class InputCases(CommandCase):
    def case(self, name):
        path = os.path.join(CASES, name)
        if not os.path.exists(path):
            self.skipTest(name + " is not there")
        return path

    def maps(self, *arguments):
        said = self.run_tilepack("bake", *arguments, "-o", "pack", *SMALL).stderr
        return said, self.read_json("pack/pack.json")["maps"]

    def test_associated_alpha_is_divided_out(self):
        said, maps = self.maps(self.case("premult_rgba.exr"), "--format", "png", "--depth", "u16")
        self.assertEqual(maps[0]["channels"], 4)
        for level in maps[0]["levels"]:
            rows, channels, _ = read_png(self.path("pack", level["file"]))
            for row in rows:
                for at in range(0, len(row), channels):
                    if row[at + 3] > 100: # of 65535
                        self.assertGreater(row[at], 65535 * 0.99, "red is 1 under all alpha")

    def test_a_depth_is_no_alpha(self):
        case = self.case("rgb_and_z.exr")
        self.refused("bake", case, "-o", "pack", *SMALL, code=3, saying=["Z", "--channels R,G,B"])
        self.assertEqual(self.maps(case, "--channels", "R,G,B")[1][0]["channels"], 3)

    def test_channels_go_by_name_behind_a_prefix(self):
        case = self.case("LeR_LeG_LeB.exr")
        self.maps(case)
        by_name = self.contents("pack")
        self.maps(case, "--channels", "LeR,LeG,LeB")
        self.assertEqual(by_name["color_0.exr"], self.contents("pack")["color_0.exr"])

    def test_whole_numbers_are_refused(self):
        self.refused("bake", self.case("id_uint.exr"), "-o", "pack", *SMALL, code=3, saying="whole numbers")

    def test_profiles_and_gamma(self):
        said, maps = self.maps(self.case("iccp_gama1.png"))
        self.assertEqual(maps[0]["encoding"], "srgb")
        self.assertNotIn("gAMA", said)
        said, maps = self.maps(self.case("gama1_only.png"))
        for text in ["gAMA", "--encoding srgb"]:
            self.assertIn(text, said)
        self.assertEqual(self.maps(self.case("gama1_only.png"), "--encoding", "srgb")[1][0]["encoding"], "srgb")

    def test_other_pictures_are_turned_and_read(self):
        _, maps = self.maps(self.case("color.png"), "--map", "height=" + self.case("height_minwhite16.tif"))
        self.assertEqual((maps[1]["depth"], maps[1]["channels"]), ("u16", 1))
        self.maps(self.case("exif6_96x96.jpg"))


if __name__ == "__main__":
    unittest.main()
