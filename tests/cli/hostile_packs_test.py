"""Packs with a bad pack.json: every verb that reads packs ends with a documented code and one message."""

import json
import os
import random
import shutil
import subprocess
import unittest

from command import TILEPACK, CommandCase

SMALL = ("--tile-size", 16, "--effort", 0, "--virtual-size", 8)


class PackFiles(CommandCase):
    """A pack.json changed at random, in ways a fixed seed repeats: every verb that reads packs must end with a
    documented exit code and one message."""

    def setUp(self):
        super().setUp()
        self.run_tilepack("bake", self.noise_png("sample.png"), "-o", "out", *SMALL, "--mapping", "index")
        self.verbs = []
        listing = self.run_tilepack("help").stdout
        for verb, arguments in (("inspect", ()), ("validate", ()), ("render", ("-o", "view.png", "--rect", "0,0,8,8"))):
            if f"\n  {verb} " in listing:
                self.verbs.append((verb, arguments))

    def read_with(self, verb, arguments):
        done = subprocess.run([TILEPACK, verb, "out", *arguments], cwd=self.folder, capture_output=True, text=True,
                              timeout=120)
        self.assertIn(done.returncode, (0, 2, 3, 5), done.stderr)
        if done.returncode in (2, 3):
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        return done

    def refuses(self, text, saying=()):
        self.write("out/pack.json", text)
        for verb, arguments in self.verbs:
            with self.subTest(verb=verb, text=text[:60]):
                done = self.read_with(verb, arguments)
                self.assertNotEqual(done.returncode, 0)
                for part in saying:
                    self.assertIn(part, done.stdout + done.stderr)

    def test_texts_that_are_no_packs(self):
        good = self.contents("out")["pack.json"].decode()
        self.refuses("")
        self.refuses("[" * 100000)
        self.refuses("null")
        self.refuses("[]")
        self.refuses('{"format": "tilepack"}', ["version"])
        self.refuses(good[:len(good) // 2])
        self.refuses(good + good)
        self.refuses(good.replace('"version": 1', '"version": 1, "version": 1'), ["stands twice"])
        self.refuses(good.replace('"version": 1', '"version": 1e400'))
        self.write("out/pack.json", good.replace('"version": 1', '"version": 2'))
        self.refused("inspect", "out", code=3, saying=("is 2", "reads 1", "newer tilepack"))
        self.refuses(good.replace("[16, 16]", "[16, 18446744073709551616]"), ["tile_size"])
        self.refuses(good.replace("[16, 16]", "[-16, 16]"), ["tile_size[0]", "-16", "1 to 4096"])
        self.refuses(good.replace("color_0.png", "../sample.png"), ["maps[0].levels[0].file", "leads out of the folder"])
        self.refuses(good.replace("color_0.png", "/etc/passwd"), ["maps[0].levels[0].file", "is an absolute path"])
        self.refuses(good.replace("color_0.png", "..\\\\sample.png"), ["maps[0].levels[0].file", "holds a backslash"])

    def test_a_huge_pack_json(self):
        with open(self.path("out/pack.json"), "ab") as stream:
            stream.truncate((16 << 20) + 1)
        for verb, arguments in self.verbs:
            with self.subTest(verb):
                done = self.run_tilepack(verb, "out", *arguments, code=3)
                self.assertIn("is 16777217 bytes long; a pack.json has at most 16777216", done.stderr)

    def test_a_pack_json_that_is_no_file(self):
        os.remove(self.path("out/pack.json"))
        os.mkdir(self.path("out/pack.json"))
        for verb, arguments in self.verbs:
            with self.subTest(verb):
                self.refused(verb, "out", *arguments, code=2, saying=("out/pack.json", "is no plain file"))
        self.refused("bake", "sample.png", "-o", "out", *SMALL, code=4, saying="no readable tile pack")

    def test_a_corner_pack_that_was_not_measured(self):
        self.run_tilepack("bake", "sample.png", "-o", "corners", *SMALL, "--interior", "quilt", "--corner-pack")
        pack = self.read_json("corners/pack.json")
        del pack["corner_pack"]["width"]
        self.write_json("corners/pack.json", pack)
        self.refused("inspect", "corners", code=3, saying=("corner_pack", '"width" is missing', "bake it again"))

    def test_an_image_is_no_pack(self):
        self.noise_png("photo.png")
        for verb in ("inspect", "validate"):
            self.refused(verb, "photo.png", code=2, saying=["photo.png", "is no pack", "pack.json"])

    def test_links_that_lead_out(self):
        shutil.copy(self.path("out/color_0.png"), self.path("elsewhere.png"))
        os.remove(self.path("out/color_0.png"))
        os.symlink("../elsewhere.png", self.path("out/color_0.png"))
        for verb, arguments in self.verbs:
            with self.subTest(verb):
                if verb == "inspect":
                    continue  # may do without the images
                done = self.read_with(verb, arguments)
                self.assertNotEqual(done.returncode, 0)
                self.assertIn("symbolic link", done.stdout + done.stderr)

    def test_random_changes(self):
        good = self.read_json("out/pack.json")
        raw = self.contents("out")["pack.json"]
        source = random.Random(7)
        for turn in range(24):
            if turn % 2:
                text = json.dumps(mutated(good, source)).encode()
            else:
                text = bytearray(raw)
                for _ in range(source.randint(1, 4)):
                    text[source.randrange(len(text))] = source.randrange(256)
                text = bytes(text)
            self.write("out/pack.json", text)
            verb, arguments = self.verbs[turn % len(self.verbs)] if self.verbs else ("help", ())
            with self.subTest(turn=turn, verb=verb):
                if self.verbs:
                    self.read_with(verb, arguments)


def mutated(value, source):
    """The value with one to three places replaced by something else of JSON."""
    strange = [None, True, -1, 0, 1, 7, 255, 65536, 2**31, 2**53, 2**63, -2**63, 2**64, 1.5, -0.0, 1e308, "", "..",
               "../x", "color_0.png", "\u0000", "é" * 300, [], {}, [[]], [1, 2], {"kind": "mix"}]
    copy = json.loads(json.dumps(value))
    for _ in range(source.randint(1, 3)):
        node = copy
        while True:
            keys = list(node.keys()) if isinstance(node, dict) else list(range(len(node)))
            if not keys:
                break
            key = source.choice(keys)
            if isinstance(node[key], (dict, list)) and node[key] and source.random() < 0.8:
                node = node[key]
                continue
            action = source.random()
            if action < 0.15:
                del node[key]
            elif action < 0.25 and isinstance(node, dict):
                node[source.choice(["extra", "size", "file", "tile"])] = source.choice(strange)
            else:
                node[key] = source.choice(strange)
            break
    return copy


if __name__ == "__main__":
    unittest.main()
