"""Slips of the hand: what a command that is nearly right says, and what it leaves alone."""

import os
import stat
import subprocess
import unittest

from command import CommandCase, noise_png

USAGE, CONTENT, CANNOT_WRITE = 1, 3, 4
SMALL = ("--tile-size", 16, "--effort", 0, "--virtual-size", 8)


class Slips(CommandCase):
    def setUp(self):
        super().setUp()
        self.noise_png("a.png", 48, 48)
        self.run_tilepack("bake", "a.png", "-o", "p", *SMALL)

    def test_texts_are_no_images(self):
        self.write("photo.JPG", "years of work")
        for words in (("shader", "p", "--lang", "glsl", "-o"), ("bake", "a.png", "-o", "new", *SMALL, "--depfile"), ("render", "p", "-o", "v.png", "--depfile"),
                      ("inspect", "p", "--index-map")):
            for name in ("photo.JPG", "photo.exr", "x.tga", "x.tiff", "x.psd", "x.gif"):
                with self.subTest(words, name=name):
                    self.refused(*words, name, code=USAGE, saying=f"'{name}' ends as an image does, and a text would be written there")
        self.refused("shader", "p", "--lang", "c", "-o", "x.json", code=USAGE, saying="ends in '.json'")
        for name in ("x", "x.glsl", "x.h", "x.txt", "x.inc.frag"):
            self.run_tilepack("shader", "p", "--lang", "glsl", "-o", name)

    def test_a_pack_is_no_sample(self):
        for words in (("p",), ("p/",), ("p/pack.json",), ("--transition", "a.png", "p")):
            with self.subTest(words):
                self.refused("bake", *words, "-o", "new", code=CONTENT, saying=("is a pack already", "`tilepack render p", "`tilepack compose`"))

    def test_the_ending_that_most_samples_have(self):
        os.mkdir(self.path("in"))
        for names, most in ((["a.Png", "z.jpg"], ".jpg"), (["b.png", "c.PNG", "d.png"], ".png"), (["e.jpg", "f.jpg", "g.jpg", "h.jpg"], ".jpg")):
            for name in names:
                self.write(f"in/{name}", noise_png(8, 8, 3, 8, 1))
            if names[0] == "a.Png":
                continue
            self.refused("bake", "in", "-o", "new", code=CONTENT, saying=f'"samples": "in/*{most}"')

    def test_the_seed_of_drawn_tiles(self):
        words = " ".join(self.run_tilepack("pack", "--help").stdout.split())
        self.assertNotIn("gives other tiles", words)
        self.assertIn("they are as they were drawn", words)
        self.assertIn("gives other tiles", " ".join(self.run_tilepack("bake", "--help").stdout.split()))

    def test_where_to(self):
        self.refused("bake", "a.png", code=USAGE, saying="--output is required: `tilepack bake a.png -o a.pack`")
        self.refused("bake", "--transition", "a.png", "a.png", code=USAGE, saying="`tilepack bake --transition a.png a.png -o a.pack`")
        self.refused("render", "p", code=USAGE, saying="--output is required: add -o FILE")
        for words in (("bake", "a.png"), ("render", "p"), ("view", "p"), ("shader", "p", "--lang", "c")):
            self.refused(*words, "-o", "", code=USAGE, saying="--output: is empty; name a f")

    def test_a_size_that_fits(self):
        self.refused("bake", "a.png", "-o", "new", "--mapping", "index", "--virtual-size", "65536x65536", code=USAGE, saying="such as 8192x8192")

    def test_the_sample_is_no_place_for_anything(self):
        for words in (("-o", "a.png"), ("-o", "new", "--depfile", "a.png"), ("-o", "./a.png"), ("-o", self.path("a.png"))):
            self.refused("bake", "a.png", *words, code=USAGE, saying="would replace a file that is worked from")
        self.write_json("c.json", [{"nw": 0, "ne": 0, "sw": 0, "se": 0}])
        self.refused("pack", "a.png", "--colors", "c.json", "-o", "a.png", code=USAGE, saying="would replace a file that is worked from")
        self.refused("pack", "a.png", "--colors", "c.json", "-o", "new", "--depfile", "new/pack.json", code=USAGE, saying="would replace")

    def test_closed_streams(self):
        for streams in (">&-", "<&- >&-", "<&- >&- 2>&-"):
            for quiet, code in (("-q", 0), ("", CANNOT_WRITE)):
                with self.subTest(streams, quiet=quiet):
                    line = f"exec '{self.program}' bake a.png -o new --tile-size 16 --effort 0 --virtual-size 8 {quiet} {streams}"
                    done = subprocess.run(["sh", "-c", line], cwd=self.folder, stderr=subprocess.PIPE, text=True)
                    self.assertEqual(done.returncode, code, done.stderr)
                    if not quiet and "2>" not in streams:
                        self.assertIn("stdout: is closed; ", done.stderr)
                        self.assertIn("new is whole and in place", done.stderr)
                    self.run_tilepack("validate", "new")

    def test_devices_and_pipes_stay(self):
        os.mkfifo(self.path("pipe"))
        os.symlink("pipe", self.path("link"))
        for name in ("pipe", "link"):
            for words in (("shader", "p", "--lang", "c", "-o"), ("bake", "a.png", "-o", "new", *SMALL, "--depfile"), ("render", "p", "-o", "v.png", "--depfile")):
                with self.subTest(words, name=name):
                    done = self.run_tilepack(*words, name, code=CANNOT_WRITE)
                    self.assertIn("is a device or a pipe, which a file would replace", done.stderr)
        self.assertTrue(stat.S_ISFIFO(os.stat(self.path("pipe")).st_mode) and os.path.islink(self.path("link")))

    def test_sizes_come_before_notes(self):
        self.noise_png("n.png", 32, 48)
        message = self.refused("bake", "a.png", "-o", "new", *SMALL, "--map", "normal=n.png", code=CONTENT)
        self.assertIn("the maps of a material have one size", message)

    def test_a_limit_on_files(self):
        line = f"ulimit -f 1; exec '{self.program}' bake a.png -o new --tile-size 32 --effort 0"
        done = subprocess.run(["sh", "-c", line], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, CANNOT_WRITE, done.stderr)
        self.assertIn("raise the largest size of files (ulimit -f)", done.stderr)

    def test_capitals(self):
        for words in (("render", "p", "-o", "v.PNG", "--rect", "0,0,8,8"), ("render", "p", "-o", "v.EXR", "--rect", "0,0,8,8"), ("inspect", "p", "--picture", "s.SVG"),
                      ("view", "p", "-o", "v.HTML"), ("render", "p", "-o", "c.png", "--camera", "0,2,0,0,0,-6,0,1,0,60", "--size", "16X12"),
                      ("bake", "a.png", "-o", "new", "--tile-size", "16X16", "--coloring", "edge", "--colors", "2X2", "--effort", "0", "--report", "r.Html")):
            with self.subTest(words):
                self.run_tilepack(*words)
        for words, meant in ((("shader", "p", "--lang", "GLSL"), "glsl"), (("bake", "a.png", "-o", "q", "--mips", "BOX"), "box"),
                             (("render", "p", "-o", "v.png", "--filter", "Nearest"), "nearest"), (("bake", "a.png", "-o", "q", "--require", "Good"), "good")):
            with self.subTest(words):
                self.refused(*words, code=USAGE, saying=f"did you mean '{meant}'?")

    def test_help_and_version(self):
        listing = self.run_tilepack("help").stdout
        for words in (("help", "--help"), ("help", "-h")):
            self.assertEqual(self.run_tilepack(*words).stdout, listing)
        for word in ("version", "-v", "-V"):
            self.refused(word, code=USAGE, saying="`tilepack --version` prints the version")

    def test_small_pages_have_a_size(self):
        self.assertRegex(self.run_tilepack("view", "p", "-o", "v.html").stdout, r", \d+ kB, ")

    def test_targets_are_for_developers(self):
        self.assertNotIn("MISSED", self.run_tilepack("bench", "p", "--lookups", 16).stdout)
        self.assertRegex(self.run_tilepack("bench", "p", "--lookups", 16, "--targets").stdout, r"\(at least [\d.]+: (met|MISSED)\)")


if __name__ == "__main__":
    unittest.main()
