"""Bad samples to bake: each with its exit code, one clear message, and nothing left behind."""

import math
import os
import re
import unittest

from command import CommandCase, float_exr

SMALL = ("--tile-size", 16, "--effort", 0, "--virtual-size", 8)
CANNOT_READ, INVALID = 2, 3


class Samples(CommandCase):
    def bake_refused(self, sample, code, saying=()):
        return self.refused("bake", sample, "-o", "out", *SMALL, code=code, saying=saying)

    def test_files_that_are_no_images(self):
        self.bake_refused("missing.png", CANNOT_READ, ["missing.png", "No such file"])
        self.bake_refused(self.write("empty.png", ""), CANNOT_READ, ["empty.png", "is empty (0 bytes)"])
        self.bake_refused(self.write("text.png", "this is no image\n" * 100), CANNOT_READ,
                          ["text.png", "is no PNG, JPEG, TIFF, EXR"])
        self.bake_refused(self.write("no_suffix", b"\0" * 1000), CANNOT_READ, ["no_suffix", "by its first bytes"])

    def test_truncated_files(self):
        self.noise_png("whole.png")
        whole = self.contents()["whole.png"]
        for share in (0.01, 0.2, 0.5, 0.99):
            with self.subTest(share):
                self.bake_refused(self.write("cut.png", whole[:int(len(whole) * share)]), CANNOT_READ,
                                  ["cut.png", "is truncated: its content goes on after"])
        exr = float_exr(64, 64, lambda x, y: x * 0.1)
        self.bake_refused(self.write("cut.exr", exr[:len(exr) // 2]), CANNOT_READ, ["cut.exr", "truncated or damaged"])

    def test_samples_too_small(self):
        self.bake_refused(self.noise_png("dot.png", 1, 1), INVALID, ["dot.png", "1 x 1", "no tile fits"])
        message = self.bake_refused(self.noise_png("small.png", 12, 64), INVALID, ["small.png", "12 x 64"])
        # The message says what would fit, and it does; one more does not.
        fits = int(re.search(r"--tile-size (\d+)", message).group(1))
        self.assertEqual(fits, 12)
        self.refused("bake", "small.png", "-o", "out", "--tile-size", fits + 1, code=INVALID, saying="small.png")
        self.run_tilepack("bake", "small.png", "-o", "out", "--effort", 0, "--tile-size", fits)
        self.refused("bake", self.noise_png("tiny.png", 3, 3), "-o", "none", "--tile-size", "auto", code=INVALID,
                     saying=["tiny.png", "3 x 3", "no tile fits"])

    def test_maps_of_unequal_sizes(self):
        self.noise_png("color.png", 32, 32)
        self.noise_png("rough.png", 32, 31)
        self.refused("bake", "color.png", "--map", "roughness=rough.png", "-o", "out", *SMALL, code=INVALID,
                     saying=["color.png", "rough.png", "32 x 31", "32 x 32"])

    def test_values_that_are_no_numbers(self):
        for value in (math.nan, math.inf, -math.inf):
            with self.subTest(value):
                exr = float_exr(64, 64, lambda x, y: value if (x, y) == (5, 7) else 0.5)
                self.bake_refused(self.write("bad.exr", exr), INVALID, ["texel (5, 7)", "only finite values"])

    def test_values_too_large(self):
        exr = float_exr(64, 64, lambda x, y: -3e38 if (x, y) == (5, 7) else 3e38)
        self.bake_refused(self.write("bad.exr", exr), INVALID, ["(0, 0)", "1e+30"])
        exr = float_exr(64, 64, lambda x, y: 70000.0 if (x, y) == (5, 7) else 0.5)
        self.write("bright.exr", exr)
        self.refused("bake", "bright.exr", "-o", "out", *SMALL, "--depth", "f16", code=INVALID,
                     saying=["bright.exr", "70000 at texel (5, 7)", "-65504 to 65504", "--depth f32"])
        self.run_tilepack("bake", "bright.exr", "-o", "out", *SMALL)
        self.run_tilepack("validate", "out")
        exr = float_exr(64, 64, lambda x, y: 1e30 if (x + y) % 3 else -1e30)
        self.run_tilepack("bake", self.write("far.exr", exr), "-o", "far", *SMALL, "--mips", "least-squares")
        self.run_tilepack("validate", "far")

    def test_a_normal_map_of_one_channel(self):
        self.noise_png("color.png")
        self.noise_png("grey.png", channels=1)
        self.refused("bake", "color.png", "-o", "out", *SMALL, "--map", "normal=grey.png", code=INVALID,
                     saying=["grey.png", "1 channel", "height"])

    def test_a_folder_or_a_device_is_no_sample(self):
        os.mkdir(self.path("folder"))
        self.refused("bake", "folder", "-o", "out", code=INVALID, saying="no color map")
        self.refused("bake", "folder/rock", "-o", "out", code=CANNOT_READ, saying="folder/rock")
        self.refused("bake", "nowhere/rock", "-o", "out", code=CANNOT_READ, saying="nowhere/rock")
        self.refused("bake", "/dev/null", "-o", "out", code=CANNOT_READ, saying="is not a regular file")


if __name__ == "__main__":
    unittest.main()
