"""Bad arguments to tilepack: each with its exit code, one clear message, and nothing left behind."""

import unittest

from command import CommandCase

SMALL = ("--tile-size", 16, "--effort", 0, "--virtual-size", 8)
USAGE, CANNOT_READ, INVALID = 1, 2, 3


class Arguments(CommandCase):
    def test_verbs(self):
        self.refused(code=USAGE, saying="a verb is missing")
        self.refused("bak", code=USAGE, saying="did you mean 'bake'?")
        self.refused("help", "rendr", code=USAGE)
        self.refused("xyzzy", code=USAGE, saying="tilepack help")

    def test_flags(self):
        self.refused("bake", "a.png", "-o", "out", "--colours", 2, code=USAGE, saying="did you mean '--colors'?")
        self.refused("bake", "a.png", "b.png", "-o", "out", code=USAGE,
                     saying=("unexpected argument 'b.png'", "--map ROLE=FILE"))
        self.refused("bake", "a.png", code=USAGE, saying="--output is required")
        self.refused("bake", "-o", "out", code=USAGE, saying="SAMPLE is required")
        self.refused("bake", "a.png", "-o", "out", "--seed", code=USAGE, saying="write --seed N")
        self.refused("bake", "a.png", "-o", "out", "--report", code=USAGE, saying="write --report FILE.html")
        self.refused("bake", "a.png", "-o", "out", "--jobs", -1, code=USAGE, saying="--jobs")

    def test_values_out_of_range(self):
        sample = self.noise_png("sample.png")
        # tests/pack/bake_fields_test.cpp tries many more values; here it counts that they reach the user.
        wrong = {
            "--tile-size": ("0", "-16", "99999999999999999999", "1.5"),
            "--colors": ("0", "-1", "99999999999999999999", "2x9"),
            "--guard": ("-1",), "--effort": ("10",), "--seed": ("9007199254740992",), "--virtual-size": ("0",),
            "--coloring": ("edges",), "--layout": ("grid",), "--mips": ("sinc",), "--mapping": ("hash",),
            "--format": ("jpg",), "--depth": ("u32",), "--encoding": ("gamma",), "--interior": ("none",),
        }
        for flag, values in wrong.items():
            for value in values:
                with self.subTest(flag=flag, value=value):
                    self.refused("bake", sample, "-o", "out", flag, value, code=USAGE, saying=(flag, value))
        self.refused("bake", sample, "-o", "out", "--tile-size=", code=USAGE, saying="--tile-size")
        self.refused("bake", sample, "-o", "out", "--colors", "9", code=USAGE,
                     saying=("1 to 4", "1 to 8", "--coloring edge"))
        for flag, value in (("--gain", "0"), ("--gain", "nan"), ("--max-difference", "-1"), ("--max-difference", "x")):
            message = self.refused("compare", sample, sample, flag, value, code=USAGE, saying=(flag, f"'{value}'"))
            self.assertLess(len(message), 120)

    def test_the_format_of_images_is_not_that_of_the_summary(self):
        for arguments in (("bake", "a.png", "-o", "out"), ("bake", "--list-presets"),
                          ("pack", "a.png", "-o", "out", "--colors", "colors.json")):
            for word in ("tiff", "png|exr", ""):
                with self.subTest(arguments, word=word):
                    self.refused(*arguments, "--format", word, code=USAGE,
                                 saying=(f"--format: '{word}' is not allowed", "text or json", "--image-format"))

    def test_values_that_contradict_each_other(self):
        sample = self.noise_png("sample.png")
        for arguments in (("--coloring", "edge", "--layout", "de-bruijn"), ("--coloring", "corner", "--layout", "tile-index"),
                          ("--coloring", "corner", "--colors", "5"), ("--coloring", "corner", "--colors", "2x2"),
                          ("--format", "png", "--depth", "f16"), ("--format", "exr", "--depth", "u8"),
                          ("--mapping", "permutation", "--virtual-size", "5000"), ("--mapping", "index", "--virtual-size", "20000"),
                          ("--guard", "9"), ("--tile-size", "4096", "--colors", "8")):
            with self.subTest(arguments):
                self.refused("bake", sample, "-o", "out", *SMALL, *arguments, code=USAGE)
        # Too many texels in sides that are allowed, and a side too long for few texels.
        for arguments, texture in ((("--tile-size", "2048", "--colors", "4"), "32768 x 32768"),
                                   (("--tile-size", "32", "--colors", "8", "--layout", "array"), "32 x 131072")):
            with self.subTest(arguments):
                self.refused("bake", sample, "-o", "out", *SMALL, *arguments, code=USAGE,
                             saying=(texture, "268435456 texels, and 65536 a side"))

    def test_maps(self):
        sample = self.noise_png("sample.png")
        for option in ("normal", "=a.png", "normal=", "a:b:c=x", "norml=a.png"):
            with self.subTest(option):
                self.refused("bake", sample, "-o", "out", "--map", option, code=USAGE, saying="--map")
        self.refused("bake", sample, "-o", "out", "--map", "norml=a.png", code=USAGE, saying="did you mean 'normal'?")
        self.refused("bake", sample, "-o", "out", "--map", "dirt=a.png", code=USAGE, saying="dirt:data=FILE")
        self.refused("bake", sample, "-o", "out", "--map", "color=sample.png", code=USAGE, saying=("two maps", "NAME:ROLE=FILE"))
        self.refused("bake", sample, "-o", "out", "--map", "../x:data=sample.png", code=USAGE)
        self.noise_png("small.png", 32, 64)
        self.refused("bake", sample, "-o", "out", *SMALL, "--map", "height=small.png", code=INVALID,
                     saying=("32 x 64", "64 x 64"))

    def test_presets(self):
        sample = self.noise_png("sample.png")
        self.refused("bake", sample, "-o", "out", "--preset", "terain", code=USAGE, saying="did you mean 'terrain'?")
        self.refused("bake", sample, "-o", "out", "--preset", "no.json", code=CANNOT_READ, saying="no.json")
        texts = {
            '{"purpose": "p", "cost": "c", "tilesize": 8}': 'did you mean "tile-size"?',
            '{"purpose": "p", "cost": "c", "effort": 11}': "whole number of 0 to 9",
            '{"purpose": "p", "cost": "c", "effort": "much"}': "effort",
            '{"purpose": "p", "cost": "c", "effort": 1e99}': "effort",
            '{"purpose": 1, "effort": 1}': "purpose",
            '{"purpose": "p", "cost": "c", "effort": 1, "effort": 2}': "stands twice",
            "{": "no valid JSON",
            "": "no valid JSON",
        }
        for text, saying in texts.items():
            with self.subTest(text):
                self.write("mine.json", text)
                self.refused("bake", sample, "-o", "out", "--preset", "mine.json", code=INVALID,
                             saying=("mine.json", saying))


if __name__ == "__main__":
    unittest.main()
