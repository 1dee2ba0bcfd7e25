"""What a sample's file leaves in doubt is said, and the options that messages name are there."""

import os
import unittest

from command import SOURCE, CommandCase


class InputNotes(CommandCase):
    sample = os.path.join(SOURCE, "samples/pebbles.png")

    def test_texels_are_limited_before_memory_is_taken(self):
        self.refused("bake", self.sample, "-o", "pack", "--max-texels", "1000", code=3, saying="--max-texels 262144")
        self.run_tilepack("bake", self.sample, "-o", "pack", "--max-texels", 10**9, "--tile-size", 16, "--effort", 0)

    def test_channels_go_by_name(self):
        self.run_tilepack("bake", self.sample, "-o", "floats", "--tile-size", 32, "--effort", 0, "--format", "exr")
        exr = self.path("floats", "color_0.exr")
        self.run_tilepack("bake", exr, "-o", "red", "--channels", "R", "--tile-size", 16, "--effort", 0)
        self.assertEqual(self.read_json("red/pack.json")["maps"][0]["channels"], 1)
        self.refused("bake", exr, "-o", "pack", "--channels", "R,Q", code=1, saying="--channels")


if __name__ == "__main__":
    unittest.main()
