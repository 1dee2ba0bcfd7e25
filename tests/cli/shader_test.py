"""`tilepack shader`: what every language's text is like, and what is refused."""

import os
import re
import shutil
import unittest

from shader_case import PACKS, ShaderCase

LANGUAGES = "glsl hlsl wgsl gdshader osl tsl c".split()


class ShaderTest(ShaderCase):
    def test_the_text_begins_with_its_command_and_the_content_and_is_stable(self):
        self.bake("even")
        os.mkdir(self.path("elsewhere"))
        shutil.copytree(self.path("even.pack"), self.path("elsewhere", "even.pack"))
        hashes = set()
        for language in LANGUAGES:
            with self.subTest(language):
                self.run_tilepack("shader", "even.pack", "--lang", language, "-o", "out.txt")
                with open(self.path("out.txt"), encoding="utf-8") as file:
                    text = file.read()
                self.assertEqual(text, self.text("elsewhere/even.pack/pack.json", language))
                first, second = text.splitlines()[:2]
                self.assertIn(f"Made by: tilepack shader even.pack --lang {language}", first)
                hashes.add(re.search(r"Content of the pack: ([0-9a-f]{16})", second).group(1))
        self.assertEqual(len(hashes), 1)
        with open(self.path("even.pack", "color_2.png"), "r+b") as file:
            file.seek(-1, os.SEEK_END)
            file.write(b"\0")
        self.assertNotIn(hashes.pop(), self.text("even.pack", "glsl"))

    def test_names_begin_as_told_and_a_shader_holds_two_packs(self):
        self.bake("even")
        for language in LANGUAGES:
            with self.subTest(language):
                body = self.text("even.pack", language, "--name", "rock").split("\n\n", 1)[1]
                self.assertIn("rock_", body)
                self.assertNotIn("tilepack", body)

    def test_a_text_holds_nothing_that_the_pack_does_not_use(self):
        text = self.text(self.bake("mix"), "glsl")
        for absent in ("pattern", "permuted", "places", "even", "corner_", "fraction_"):
            self.assertNotIn("tilepack_" + absent, text)
        for absent in ("usampler2D", "sampler2DArray", "corners,"):
            self.assertNotIn(absent, text)
        self.assertEqual(text.count("textureGrad("), 1)

    def test_what_a_language_can_not_express_is_refused_with_the_way_out(self):
        self.bake("index")
        self.bake("array")
        for language in ("osl", "gdshader"):
            self.refused("shader", "index.pack", "--lang", language, code=3, saying=[language, "--mapping mix"])
        self.refused("shader", "array.pack", "--lang", "osl", code=3, saying=["texture arrays", "--layout de-bruijn"])
        self.bake("even3")
        PACKS["layers"] = ["--layout", "array", "--colors", "4", "--tile-size", "4"]
        self.addCleanup(PACKS.pop, "layers")
        self.bake("layers")
        self.assertIn("array of 256 layers", self.text("layers.pack", "wgsl"))
        self.refused("shader", "index.pack", "--lang", "gsls", code=1, saying="glsl")
        self.refused("shader", "index.pack", "--lang", "glsl", "--name", "2d", code=1, saying=["--name", "'2d'"])
        self.refused("shader", "index.pack", "--lang", "glsl", "-o", "index.pack/pack.json", code=1, saying="--output")
        self.refused("shader", "index.pack", code=1, saying="--lang")

    def test_more_layers_than_webgpu_has_are_refused(self):
        PACKS["layers"] = ["--layout", "array", "--coloring", "edge", "--colors", "5x4", "--tile-size", "4"]
        self.addCleanup(PACKS.pop, "layers")
        self.bake("layers")
        self.refused("shader", "layers.pack", "--lang", "wgsl", code=3, saying=["256 layers", "--layout"])
        self.text("layers.pack", "glsl")


if __name__ == "__main__":
    unittest.main()
