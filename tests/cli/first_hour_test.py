"""What someone trips over who uses tilepack for the first time: messages that say the way out, help, quiet, folders."""

import os
import re
import unittest

from command import CommandCase
from png_image import read_png

SMALL = ("--tile-size", 16, "--effort", 0, "--virtual-size", 8)


class FirstHour(CommandCase):
    def test_messages_say_what_was_meant(self):
        g = self.noise_png("g.png")
        self.write_json("p.json", {"tile-size": 64})
        cases = (
            (("bake", g, "--out", "a.pack"), "did you mean '--output' (-o)?"),
            (("bake", g, "-o", "a", "--tilesize", "64"), "did you mean '--tile-size'?"),
            (("bake", g, "-o", "a", "--report-formt", "json"), "unknown option '--report-formt'"),
            (("bake", g, "-o", "a", "--map", ":data=g.png"), "the name before ':' is empty"),
            (("bake", g, "-o", "a", "--map", ":data=g.png"), "NAME:ROLE=FILE"),
            (("bake", g, "-o", "a", "--map", "gravel.png=normal"), "--map normal=gravel.png"),
            (("bake", g, "-o", "a", "--map", "normal", "g.png"), "no '=': write --map normal=g.png"),
            (("bake", "--map", "normal", "g.png", "-o", "a"), "'normal' has no '='"),
            (("bake", "*.png", "-o", "a"), "a bake takes one sample"),
            (("bake", g, "g.png", "-o", "a"), "one sample a bake"),
            (("layouts", "18"), "--tiles 18"),
            (("gravel.png",), "tilepack bake gravel.png -o gravel.pack"),
            (("textures/gravel.png",), "tilepack bake textures/gravel.png -o gravel.pack"),
            ((".",), "tilepack bake . -o material.pack"),
            (("insp",), "did you mean 'inspect'?"),
            (("-q", "bake", "g.png", "-o", "a"), "options come after it: tilepack bake -q g.png -o a"),
            (("--quiet", "g.png"), "'--quiet' is no verb, and one is missing; `tilepack help` lists them"),
        )
        for arguments, saying in cases:
            with self.subTest(arguments=arguments):
                self.refused(*arguments, code=1, saying=saying)
        for guess in ("--bad", "--xyz", "--quux"):
            with self.subTest(guess=guess):
                self.assertNotIn("did you mean", self.refused("bake", g, "-o", "a", guess, code=1))
        self.assertNotIn("report-format", self.refused("bake", g, "-o", "a", "--report-formt", "json", code=1).replace("report-formt", ""))

    def test_texts_that_are_not_there_are_said_not_to_be_there(self):
        self.noise_png("g.png")
        self.refused("batch", "nope.json", code=2, saying="nope.json: there is no such file")
        self.refused("compose", "nope.json", "-o", "a.png", code=2, saying="nope.json: there is no such file")
        self.refused("pack", "g.png", "-o", "a", "--colors", "nope.json", code=2, saying="there is no such file, which would be the list of colors")
        os.mkdir(self.path("folder"))
        self.refused("batch", "folder", code=2, saying="is a file, and this a folder")

    def test_what_was_made_is_said_in_a_line(self):
        self.run_tilepack("bake", self.noise_png("g.png"), "-o", "g.pack", *SMALL)
        for arguments, said in (
                (("render", "g.pack", "-o", "a.png", "--rect", "0,0,40,30"), "a.png: 40 x 30 pixels of the color map\n"),
                (("render", "g.pack", "-o", "b.png", "--camera", "0,1,0,0,1,-6,0,1,0,60", "--size", "64x48"), "b.png: 64 x 48 pixels, as a camera sees them\n"),
                (("shader", "g.pack", "-o", "g.glsl", "--lang", "glsl"), None),
                (("view", "g.pack", "-o", "g.html"), None)):
            with self.subTest(arguments=arguments):
                done = self.run_tilepack(*arguments)
                self.assertEqual(done.stderr, "")
                self.assertRegex(done.stdout, rf"\A{re.escape(arguments[3])}: .+\n\Z")
                self.assertEqual(done.stdout, said or done.stdout)
                quiet = self.run_tilepack(*arguments, "-q")
                self.assertEqual((quiet.stdout, quiet.stderr), ("", ""))
        # What is asked for on stdout is all that stands there.
        text = self.run_tilepack("shader", "g.pack", "--lang", "glsl").stdout
        with open(self.path("g.glsl"), encoding="utf-8") as stream:
            self.assertEqual(text, stream.read())

    def test_a_folder_of_unlike_pictures_is_no_material(self):
        os.mkdir(self.path("art"))
        for name in ("gravel", "sand", "rock_albedo", "rock_normal"):
            self.noise_png(f"art/{name}.png")
        done = self.run_tilepack("bake", "art", "-o", "a", *SMALL)
        self.assertIn("art is taken as the material 'rock' (2 of its images); gravel.png, sand.png are passed over", done.stderr)
        self.assertIn('"samples": "art/*.png"', done.stderr)
        self.assertNotIn("passed over", self.run_tilepack("bake", "art/rock", "-o", "a", *SMALL).stderr)
        os.remove(self.path("art/rock_normal.png"))
        self.refused("bake", "art", "-o", "b", *SMALL, code=3,
                     saying=("rock_albedo.png, and gravel.png, sand.png", "name the one to bake", '"samples": "art/*.png"'))
        self.run_tilepack("bake", "art/rock", "-o", "b", *SMALL)
        os.remove(self.path("art/rock_albedo.png"))
        self.refused("bake", "art", "-o", "c", *SMALL, code=3, saying=("gravel.png, sand.png", '"samples": "art/*.png"'))
        # Pictures of the material as a whole are no samples.
        os.mkdir(self.path("moss"))
        for name in ("moss_color", "moss_preview", "sphere"):
            self.noise_png(f"moss/{name}.png")
        self.assertNotIn("passed over", self.run_tilepack("bake", "moss", "-o", "d", *SMALL).stderr)

    def test_a_pack_named_in_place_of_a_verb_is_inspected(self):
        self.run_tilepack("bake", self.noise_png("g.png"), "-o", "g.pack", *SMALL)
        for name in ("g.pack", "g.pack/pack.json"):
            self.refused(name, code=1, saying=f"`tilepack inspect {name}`")

    def test_a_preset_of_ones_own_needs_only_what_it_sets(self):
        self.write_json("p.json", {"tile-size": 16, "effort": 0, "format": "exr"})
        self.run_tilepack("bake", self.noise_png("g.png"), "-o", "out", "--preset", "p.json")
        self.assertIn("color_0.exr", os.listdir(self.path("out")))

    def test_format_is_what_is_printed_and_the_old_spellings_go_on(self):
        g = self.noise_png("g.png")
        plain = self.run_tilepack("bake", g, "-o", "a", *SMALL, "--image-format", "exr", "--format", "json")
        self.assertEqual(plain.stdout[0], "{")
        self.assertNotIn("now", plain.stderr)
        for old, say in ((("--format", "exr", "--report-format", "json"), "--image-format exr"),
                         (("--image-format", "exr", "--report-format", "json"), "--format json"),
                         (("--format", "exr", "--format", "json"), "--image-format exr")):
            with self.subTest(old=old):
                done = self.run_tilepack("bake", g, "-o", "a", *SMALL, *old)
                self.assertEqual(done.stdout, plain.stdout)
                self.assertIn(say, done.stderr)

    def test_quiet_is_quiet(self):
        g = self.noise_png("g.png")
        done = self.run_tilepack("bake", g, "-o", "a", *SMALL, "-q")
        self.assertEqual((done.stdout, done.stderr), ("", ""))
        self.assertEqual(self.run_tilepack("bake", g, "-o", "a", *SMALL, "-q", "--format", "json").stdout[0], "{")
        self.assertIn("16 tiles", self.run_tilepack("bake", g, "-o", "a", *SMALL, "-q", "--format", "text").stdout)

    def test_folders_of_outputs_are_made(self):
        g = self.noise_png("g.png")
        self.run_tilepack("bake", g, "-o", "packs/a", *SMALL, "--report", "pages/of/a.html", "--depfile", "deps/a.d")
        self.run_tilepack("render", "packs/a", "-o", "views/a.png")
        self.run_tilepack("inspect", "packs/a", "--picture", "pictures/a.svg", "--preview", "pictures/b.png")
        self.run_tilepack("compare", g, g, "--picture", "differences/a.png")
        for file in ("pages/of/a.html", "deps/a.d", "views/a.png", "pictures/a.svg", "pictures/b.png", "differences/a.png"):
            self.assertTrue(os.path.isfile(self.path(file)), file)
        # A command that fails leaves none behind.
        self.refused("bake", g, "-o", "b", "--tile-size", "4096", "--report", "none/of/b.html", code=3)

    def test_help_shows_what_is_needed_first(self):
        text = self.run_tilepack("bake", "--help").stdout
        self.assertIn("Usage: tilepack bake SAMPLE... -o DIR [OPTIONS]", text)
        self.assertIn("-o,--output DIR (required)", text)
        headings = re.findall(r"^([A-Z][\w ]+):$", text, re.MULTILINE)
        self.assertEqual(headings[:2], ["Positionals", "Most used"])
        self.assertLess(headings.index("General"), headings.index("Presets"))
        for word in ("default auto", "default 5", "terrain ", "roughness", "NAME:ROLE=FILE", "--image-format png|exr", "--format text|json"):
            self.assertIn(word, text)
        self.assertNotIn("report-format", text)
        self.assertLessEqual(max(map(len, text.splitlines())), 110)

    def test_every_description_begins_with_a_capital_letter(self):
        verbs = re.findall(r"^  (\w+) ", self.run_tilepack("help").stdout, re.MULTILINE)
        self.assertGreater(len(verbs), 7)
        for verb in verbs:
            if verb == "help":
                continue
            text = self.run_tilepack(verb, "--help").stdout.split("\nExample:")[0]
            with self.subTest(verb=verb):
                self.assertRegex(text, r"\A[A-Z]")
                for line in text.splitlines():
                    if found := re.match(r"  -\S+.*?\s{2,}(\S)", line):
                        self.assertFalse(found.group(1).islower(), line)

    def test_many_tiles_are_told_of_before_they_are_made(self):
        done = self.run_tilepack("bake", self.noise_png("g.png"), "-o", "a", "--colors", "4", *SMALL)
        self.assertIn("256 tiles are to be made", done.stderr)
        self.assertIn("--colors 3 makes 81", done.stderr)

    def test_auto_says_where_nothing_repeats(self):
        g = self.noise_png("g.png")
        asked = self.run_tilepack("bake", g, "-o", "a", "--effort", "0", "--tile-size", "auto")
        self.assertIn("no repeat was found", asked.stderr)
        self.assertNotIn("no repeat", self.run_tilepack("bake", g, "-o", "a", "--effort", "0").stderr)

    def test_a_camera_shows_a_sky_above_the_ground(self):
        self.run_tilepack("bake", self.noise_png("g.png"), "-o", "a", *SMALL, "--map", "data=g.png")
        view = ("--camera", "0,1,0,0,1,-6,0,1,0,60", "--size", "64x48")
        self.run_tilepack("render", "a", "-o", "v.png", *view)
        rows = read_png(self.path("v.png"))[0]
        top, above = rows[0][:3], rows[20][:3]
        self.assertGreater(top[2], top[0])                # blue
        self.assertGreater(sum(above), sum(top))          # paler at the horizon
        self.run_tilepack("render", "a", "-o", "n.png", *view, "--map", "data")
        self.assertEqual(set(read_png(self.path("n.png"))[0][0]), {0})  # data is not painted over
        self.run_tilepack("render", "a", "-o", "b.png", *view, "--background", "0,0,0")
        self.assertEqual(set(read_png(self.path("b.png"))[0][0]), {0})
        self.run_tilepack("render", "a", "-o", "s.png", *view, "--map", "data", "--background", "sky")
        self.assertGreater(read_png(self.path("s.png"))[0][0][2], 0)
        self.run_tilepack("render", "a", "-o", "t.png", *view, "--filter", "anisotropic")
        self.assertEqual(read_png(self.path("t.png"))[0], rows)


if __name__ == "__main__":
    unittest.main()
