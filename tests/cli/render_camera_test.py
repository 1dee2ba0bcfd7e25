"""`tilepack render --camera`: pictures against projection done here, and what goes wrong."""

import os
import shutil
import subprocess
import tempfile
import unittest

from png_image import read_png
from render_test import TILEPACK, SmallPack

DOWN = "3,3,3,3,0,3,0,0,-1,90"  # straight down from height 3: 48 pixels see 6 tiles of 8 texels
ACROSS = "0,1,0,0,0.5,-5,0.3,1,0,60"
FLOOR = """v 0 0 0
v 6 0 0
v 6 0 6
v 0 0 6
vt 0 0
vt 6 0
vt 6 -6
vt 0 -6
f 1/1 2/2 3/3 4/4
"""


class RenderCamera(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.pack = os.path.join(self.folder, "pack")
        SmallPack(self.pack)
        self.view = os.path.join(self.folder, "view.png")

    def run_render(self, *options, output=None):
        command = [TILEPACK, "render", self.pack, "-o", output or self.view, *options]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def picture(self, *options):
        done = self.run_render(*options)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.view, "rb") as file:
            return file.read()

    def refused(self, code, text, *options):
        done = self.run_render(*options)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(text, done.stderr)
        self.assertFalse(os.path.exists(self.view))

    def mesh(self, text):
        path = os.path.join(self.folder, "mesh.obj")
        with open(path, "w", encoding="ascii") as file:
            file.write(text)
        return path

    def assert_near(self, options, other_options):
        self.picture(*options)
        seen = read_png(self.view)
        self.picture(*other_options)
        other = read_png(self.view)
        worst = max(abs(a - b) for row, other_row in zip(seen[0], other[0]) for a, b in zip(row, other_row))
        self.assertLessEqual(worst, 1)

    def test_looking_down_shows_the_texture(self):
        self.assert_near(["--camera", DOWN, "--size", "48x48"], ["--rect", "0,0,48,48"])

    def test_a_mesh_shows_the_texture(self):
        obj = self.mesh(FLOOR)
        self.assert_near(["--camera", DOWN, "--size", "48x48", "--mesh", obj], ["--rect", "0,0,48,48"])

    def test_same_bytes_for_any_number_of_threads(self):
        for options in (["--span", "newton"], ["--span", "euler2", "--span-error", "0.1"],
                        ["--filter", "anisotropic", "--span", "affine", "--reseed", "8"],
                        ["--filter", "elliptical", "--border", "mirror"]):
            view = ["--camera", ACROSS, "--size", "200x150", *options]
            one = self.picture(*view, "--jobs", "1")
            self.assertEqual(one, self.picture(*view, "--jobs", "4"))
            self.assertEqual(one, self.picture(*view))

    def test_methods_differ_a_little_and_precision_hardly(self):
        view = ["--camera", ACROSS, "--size", "200x150", "--span"]
        exact = self.picture(*view, "exact")
        self.assertNotEqual(exact, self.picture(*view, "euler1"))
        self.assertNotEqual(exact, self.picture(*view, "affine"))
        self.picture(*view, "newton-general", "--precision", "f64")
        self.picture(*view, "estimate")

    def test_background(self):
        self.picture("--camera", "0,1,0,0,9,-1,0,1,1,30", "--size", "4x4", "--background", "0,1,0.2")
        self.assertEqual(read_png(self.view)[0][2][:3], [0, 255, 51])

    def test_repeat_scales_the_ground(self):
        near = self.picture("--camera", DOWN, "--size", "48x48")
        self.assertEqual(near, self.picture("--camera", "1.5,1.5,1.5,1.5,0,1.5,0,0,-1,90", "--size", "48x48",
                                            "--repeat", "2"))

    def test_usage_errors(self):
        size = ["--size", "8x8"]
        self.refused(1, "ten numbers", "--camera", "1,2,3", *size)
        self.refused(1, "same place", "--camera", "0,1,0,0,1,0,0,1,0,60", *size)
        self.refused(1, "1e9", "--camera", "inf,1,0,0,0,0,0,1,0,60", *size)
        self.refused(1, "the eye", "--camera", "nan,1,0,0,0,0,0,1,0,60", *size)
        self.refused(1, "179.999", "--camera", "0,1,0,0,0,-1,0,1,0,180", *size)
        self.refused(1, "1..65536", "--camera", ACROSS, "--size", "0x8")
        self.refused(1, "WIDTHxHEIGHT", "--camera", ACROSS, "--size", "8")
        self.refused(1, "did you mean 'newton'", "--camera", ACROSS, *size, "--span", "newten")
        self.refused(1, "65536", "--camera", ACROSS, *size, "--span", "euler1", "--reseed", "-4")
        self.refused(1, "up to 1000", "--camera", ACROSS, *size, "--span-error", "-1")
        self.refused(1, "one of the two", "--camera", ACROSS, *size, "--span-error", "1", "--reseed", "4")
        self.refused(1, "f32|f64", "--camera", ACROSS, *size, "--precision", "f16")
        self.refused(1, "anisotropic", "--camera", ACROSS, *size, "--filter", "nearest")
        self.refused(1, "1e-06 to 1000000", "--camera", ACROSS, *size, "--repeat", "0")
        self.refused(1, "3 channels", "--camera", ACROSS, *size, "--background", "1")
        self.refused(1, "numbers with commas", "--camera", ACROSS, *size, "--background", "a")
        self.refused(1, "--camera", "--span", "newton")
        self.refused(1, "--rect", "--camera", ACROSS, "--rect", "0,0,8,8")

    def test_bad_meshes(self):
        view = ["--camera", ACROSS, "--size", "8x8", "--mesh"]
        self.refused(2, "OBJ", *view, os.path.join(self.folder, "none.obj"))
        self.refused(2, "OBJ", *view, self.folder)
        self.refused(3, "mesh.obj:2: a 'v' line needs 3 numbers", *view, self.mesh("v 0 0 0\nv 1\n"))
        self.refused(3, "no face", *view, self.mesh(""))


if __name__ == "__main__":
    unittest.main()
