"""PNG files need neither OpenImageIO nor the module that holds it; what does need it says so when it's broken."""

import os
import subprocess
import unittest

from command import SOURCE, TILEPACK, CommandCase


class Module(CommandCase):
    sample = os.path.join(SOURCE, "samples/pebbles.png")

    def broken(self):
        """An environment in which the loader finds a broken module before the right one."""
        os.makedirs(self.path("broken"))
        self.write("broken/libtilepack_openimageio.so", "no library")
        return {"env": {**os.environ, "LD_LIBRARY_PATH": self.path("broken")}}

    def test_png_is_baked_checked_and_rendered_without_it(self):
        without = self.broken()
        self.run_tilepack("bake", self.sample, "-o", "pack", "--tile-size", 32, "--effort", 0, **without)
        self.run_tilepack("validate", "pack", **without)
        self.run_tilepack("inspect", "pack", "--picture", "pack.png", **without)
        self.run_tilepack("inspect", "pack", "--picture", "pack.svg", **without)
        self.run_tilepack("render", "pack", "-o", "plane.png", **without)
        self.run_tilepack("compare", "plane.png", "plane.png", **without)

    def test_nothing_of_openimageio_is_linked(self):
        libraries = subprocess.run(["ldd", TILEPACK], capture_output=True, text=True, check=True).stdout
        self.assertIn("libpng", libraries)
        self.assertNotIn("OpenImageIO", libraries)
        self.assertLess(len(libraries.splitlines()), 40)

    def test_a_broken_module_is_named_with_the_way_out(self):
        self.run_tilepack("bake", self.sample, "-o", "pack", "--tile-size", 32, "--effort", 0)
        without = self.broken()
        for arguments in (["bake", self.sample, "-o", "floats", "--tile-size", 32, "--effort", 0, "--format", "exr"],
                          ["render", "pack", "-o", "plane.exr"]):
            self.refused(*arguments, code=6, saying=["libtilepack_openimageio.so", "LD_LIBRARY_PATH", "PNG"], **without)


if __name__ == "__main__":
    unittest.main()
