"""Values of options: what is no number, or out of range, is named with the range, in all verbs alike."""

import unittest

from command import CommandCase

USAGE = 1
NO_NUMBERS = ("x", "nan", "1e999", "-1e999", "0x10", "5 ", "")


class OptionValues(CommandCase):
    def setUp(self):
        super().setUp()
        self.noise_png("sample.png")
        self.run_tilepack("bake", "sample.png", "-o", "pack", "--tile-size", 16, "--effort", 0)

    def refuses(self, command, option, values, allowed):
        for value in values:
            with self.subTest(command[0], option=option, value=value):
                message = self.refused(*command, option, value, code=USAGE)
                self.assertEqual(message, f"tilepack {command[0]}: error: {option}: '{value}' is not allowed; "
                                          f"it must be {allowed}\n")

    def test_whole_numbers(self):
        bake = ("bake", "sample.png", "-o", "out")
        pack = ("pack", "sample.png", "-o", "out", "--colors", "colors.json")
        inspect, validate, bench = ("inspect", "pack"), ("validate", "pack"), ("bench", "pack")
        render = ("render", "pack", "-o", "out.png")
        view = (*render, "--camera", "0,2,0,0,0,-6,0,1,0,60")
        for command in (bake, pack, validate, render, bench):
            self.refuses(command, "--jobs", (*NO_NUMBERS, "-1", "1025", "1.5", "010"),
                         "a whole number of 0 to 1024 (0: as many as the machine has)")
        for command, option, lowest, highest, note in (
                (bake, "--flatten", 0, 100, ", or auto"), (bake, "--effort", 0, 9, ""), (bake, "--jump-weight", 0, 1000, ""),
                (inspect, "--tiles", 1, 64, ""), (inspect, "--level", 0, 30, ""), (inspect, "--worst", 0, 1000, ""),
                (validate, "--lookups", 16, 1000000, ""), (bench, "--lookups", 16, 1000000, ""),
                (bench, "--rounds", 1, 1000, ""), (render, "--level", 0, 30, ""),
                (view, "--reseed", 0, 65536, " (0: only at the near end)"),
                (("layouts",), "--tiles", 1, 65535, ""), (("layouts",), "--up-to", 1, 4096, ""),
                (("layouts",), "--tile-size", 1, 4096, ""),
                (("layouts",), "--gutter", 0, 4096, ", and at most the tile's side")):
            self.refuses(command, option, (*NO_NUMBERS, lowest - 1, highest + 1, "99999999999999999999"),
                         f"a whole number of {lowest} to {highest}{note}")

    def test_numbers(self):
        pack = ("pack", "sample.png", "-o", "out", "--colors", "colors.json")
        compare = ("compare", "sample.png", "sample.png")
        render = ("render", "pack", "-o", "out.png")
        view = (*render, "--camera", "0,2,0,0,0,-6,0,1,0,60")
        for command, option, wrong, allowed in (
                (pack, "--tolerance", ("-0.1", "1.1"), "a number of 0 to 1"),
                (compare, "--max-difference", ("-1", "inf"), "a number of 0 to 1e+38"),
                (compare, "--min-psnr", ("-1001", "1001"), "a number of -1000 to 1000 dB"),
                (compare, "--min-ssim", ("-1.1", "1.1"), "a number of -1 to 1"),
                (compare, "--gain", ("0", "1001"), "a number of 0.001 to 1000"),
                (render, "--scale", ("0", "-1", "inf"), "a number above 0, up to 65536 (1: a pixel a texel)"),
                (render, "--corner-width", ("-1", "4097"), "a number of 0 to 4096"),
                (view, "--repeat", ("0", "1e7"), "a number of 1e-06 to 1000000 tiles a unit"),
                (view, "--span-error", ("0", "1001"), "a number above 0, up to 1000 pixels")):
            self.refuses(command, option, (*NO_NUMBERS, *wrong), allowed)

    def test_words(self):
        for command, option, allowed in ((("bake", "sample.png", "-o", "out"), "--encoding", "srgb|linear"),
                                         (("bake", "--list-presets"), "--report-format", "text|json"),
                                         (("inspect", "pack"), "--format", "text|json"),
                                         (("validate", "pack"), "--format", "text|json|csv"),
                                         (("compare", "a", "b"), "--format", "text|json"),
                                         (("layouts",), "--format", "text|json")):
            self.refuses(command, option, ("xml", "text|json", ""), allowed)
            if "text" in allowed:
                self.refuses(command, option, ("tex", "TEXT"), allowed + "; did you mean 'text'?")

    def test_messages_of_rendering_name_options(self):
        render = ("render", "pack", "-o", "out.png")
        view = (*render, "--camera", "0,2,0,0,0,-6,0,1,0,60")
        for arguments, saying in (((*render, "--camera", "1,2"), "--camera: '1,2'"),
                                  ((*render, "--rect", "0,0,70000,9"), "70000 pixels wide; at most 65536"),
                                  ((*render, "--rect", "0,0,9,9", "--scale", "9999"), "--scale"),
                                  ((*view, "--size", "0x10"), "--size: 0 x 10"),
                                  ((*view, "--background", "1"), "--background: 1 value;"),
                                  ((*view, "--span", "newtn"), ("--span: 'newtn'", "did you mean 'newton'?")),
                                  ((*view, "--filter", "nearest"), "--filter: 'nearest'"),
                                  (("inspect", "pack", "--corner-picture", "c.png"), "--corner-picture: ")):
            with self.subTest(arguments):
                self.refused(*arguments, code=USAGE, saying=saying)

    def test_help_is_free_of_what_the_parser_calls_things(self):
        for verb in ("bake", "pack", "inspect", "validate", "render", "compare", "layouts", "bench"):
            page = self.run_tilepack(verb, "--help").stdout
            for word in ("REQUIRED", "TEXT", "INT", "FLOAT", "{"):
                with self.subTest(verb, word=word):
                    self.assertNotIn(word, page.replace('{"', ""))
        self.assertIn("-o,--output DIR (required)", self.run_tilepack("pack", "--help").stdout)


if __name__ == "__main__":
    unittest.main()
