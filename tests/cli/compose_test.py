"""`tilepack compose`, and `inspect` and `validate` of scenes: the sample scenes as their pictures show them, frames, reports, what goes wrong."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import jsonschema

from command import SOURCE, TILEPACK, CommandCase
from png_image import read_png, write_png

SCENES = os.path.join(SOURCE, "samples/scenes")
# Scene, options of its picture in samples/pictures/scenes.
SHOWN = {
    "aperiodic_tiling": ["--rect", "0,0,512,384", "--scale", "0.5"],
    "controlled_tiling": ["--rect", "512,256,1024,768", "--scale", "0.25"],
    "sparse_convolution": ["--rect", "0,0,512,384", "--scale", "0.5"],
    "controlled_convolution": ["--rect", "1024,256,1536,1152", "--scale", "0.1666666667"],
    "message_board": ["--rect", "256,0,512,256", "--scale", "0.5", "--time", "20"],
    "walking_sprites": ["--rect", "128,128,768,576", "--scale", "0.3333333333", "--time", "3"],
    "opening_flowers": ["--rect", "512,640,1024,768", "--scale", "0.25", "--time", "30"],
    "sharp_border": ["--rect", "512,256,1024,768", "--scale", "0.25"],
    "landscape": ["--rect", "0,0,256,256", "--level", "12"],
    "landscape_near": ["--rect", "368128,659200,1024,768", "--scale", "0.25"],
    "landscape_view": ["--camera", "1437,2.2,2582,1439,0.6,2574,0,1,0,60", "--size", "384x192"],
}


def file_of(scene):
    return scene.replace("_view", "").replace("_near", "") + ".json"


class Made:
    """The sample scenes with the pictures and packs that they name, made once for all tests."""

    folder = None

    @classmethod
    def scenes(cls):
        if cls.folder is None:
            cls.folder = tempfile.mkdtemp(prefix="tilepack_scenes_")
            for name in os.listdir(SCENES):
                if name.endswith((".json", ".py")):
                    shutil.copy(os.path.join(SCENES, name), cls.folder)
            subprocess.run([sys.executable, os.path.join(cls.folder, "make_pictures.py"), cls.folder], check=True)
            subprocess.run(["sh", os.path.join(SCENES, "bake_packs.sh"), os.path.join(cls.folder, "made")], check=True,
                           env={**os.environ, "TILEPACK": TILEPACK}, stdout=subprocess.DEVNULL)
        return cls.folder


def tearDownModule():
    if Made.folder:
        shutil.rmtree(Made.folder, ignore_errors=True)


class SampleScenes(CommandCase):
    def compose(self, scene, output, *options):
        return self.run_tilepack("compose", os.path.join(Made.scenes(), file_of(scene)), "-o", output, *options)

    def test_each_is_sound_and_shows_what_the_documentation_shows(self):
        for scene, options in SHOWN.items():
            with self.subTest(scene):
                self.run_tilepack("validate", os.path.join(Made.scenes(), file_of(scene)))
                self.compose(scene, "now.png", *options)
                shown = os.path.join(SOURCE, "samples/pictures/scenes", scene + ".png")
                compared = subprocess.run([TILEPACK, "compare", shown, self.path("now.png"), "--format", "json"], capture_output=True, text=True, check=False)
                self.assertIn(compared.returncode, (0, 5), compared.stderr)
                if compared.returncode == 5:  # the last bits of filters differ between processors
                    self.assertGreater(json.loads(compared.stdout)["parts"][0]["psnr"], 40, compared.stdout)

    def test_each_keeps_the_schema(self):
        with open(os.path.join(SOURCE, "lib/tilepack/scene/scene.schema.json"), encoding="utf-8") as stream:
            schema = json.load(stream)
        jsonschema.Draft7Validator.check_schema(schema)
        names = [name for name in os.listdir(SCENES) if name.endswith(".json")]
        self.assertGreater(len(names), 8)
        for name in names:
            with open(os.path.join(SCENES, name), encoding="utf-8") as stream:
                jsonschema.validate(json.load(stream), schema)

    def test_the_same_bytes_for_any_number_of_threads(self):
        for scene in ("controlled_convolution", "landscape_view"):
            self.compose(scene, "one.png", *SHOWN[scene], "--jobs", "1")
            self.compose(scene, "two.png", *SHOWN[scene], "--jobs", "2")
            self.assertEqual(self.contents()["one.png"], self.contents()["two.png"], scene)

    def test_frames_are_the_pictures_of_their_times(self):
        done = self.compose("walking_sprites", "out/walk.png", "--rect", "128,128,768,576", "--scale", "0.125", "--frames", "9..12", "--format", "json")
        self.assertEqual(json.loads(done.stdout)["frames"], 4)
        self.assertEqual(sorted(os.listdir(self.path("out"))), [f"walk_{i:04}.png" for i in range(9, 13)])
        self.compose("walking_sprites", "eleven.png", "--rect", "128,128,768,576", "--scale", "0.125", "--time", "11")
        files = self.contents()
        self.assertEqual(files["out/walk_0011.png"], files["eleven.png"])
        self.assertEqual(len({files[f"out/walk_{i:04}.png"] for i in range(9, 13)}), 4)
        self.compose("walking_sprites", "half.png", "--rect", "128,128,768,576", "--scale", "0.125", "--frames", "2..2", "--step", "0.5", "--time", "10")
        self.assertEqual(self.contents()["half_0002.png"], files["eleven.png"])

    def lit(self, time):
        """The lamps of the board that are not at rest at a time: those with any bright texel."""
        self.compose("message_board", "board.png", "--time", str(time))
        rows, channels, _ = read_png(self.path("board.png"))
        return {(x // 16, y // 16) for y, row in enumerate(rows) for x in range(1024) if row[x * channels] > 150}

    def test_the_board_shows_two_messages_and_then_neither(self):
        frames = range(24)
        wang = set().union(*(self.lit(t) for t in frames))
        tiles = set().union(*(self.lit(70 + t) for t in range(10)))
        dark = self.lit(150)
        self.assertIn((20, 8), wang)  # the first stroke of the W
        self.assertNotIn((20, 8), tiles)
        self.assertGreater(len(wang), 60)
        self.assertGreater(len(tiles), 60)
        self.assertLess(len(dark), 10)

    def test_only_what_is_looked_at_is_read(self):
        done = self.compose("landscape", "near.png", "--rect", "524288,524288,64,64", "--format", "json")
        report = json.loads(done.stdout)
        read = {file["file"]: file["openings"] for file in report["files"]}
        self.assertEqual({name for name, count in read.items() if count}, {"made/island.png", "made/rock.pack"})
        self.assertIn("made/meadow.pack", read)
        used = {node["name"]: node["used"] for node in report["nodes"]}
        self.assertTrue(used["rock"])
        self.assertFalse(used["meadow"])
        # From afar every material shows, at its coarsest levels alone.
        done = self.compose("landscape", "far.png", "--rect", "0,0,64,64", "--level", "14", "--format", "json")
        far = json.loads(done.stdout)
        self.assertLess(far["bytes"]["held"], 4_000_000)
        text = self.compose("landscape", "near.png", "--rect", "524288,524288,64,64").stdout
        self.assertRegex(text, r"nodes skipped  .*meadow")
        self.assertRegex(text, r"files skipped  .*made/meadow.pack")

    def test_the_graph_is_drawn_and_told(self):
        scene = os.path.join(Made.scenes(), "controlled_convolution.json")
        told = json.loads(self.run_tilepack("inspect", scene, "--format", "json", "--picture", "graph.png").stdout)
        self.assertEqual(told["size"], [4096, 4096])
        self.assertEqual({n["name"] for n in told["nodes"] if n["name"] == "kind" and "amount" in n["from"]}, {"kind"})
        rows, _, _ = read_png(self.path("graph.png"))
        self.assertGreater(len({tuple(row) for row in rows}), 100)
        self.run_tilepack("inspect", scene, "--picture", "graph.svg")
        with open(self.path("graph.svg"), encoding="utf-8") as stream:
            svg = stream.read()
        for node in told["nodes"]:
            self.assertIn(f">{node['name']}</text>", svg)
        self.assertIn("controlled_convolution.json: scene of 4096 x 4096 texels", self.run_tilepack("inspect", scene).stdout)
        self.refused("inspect", scene, "--preview", "x.png", code=1, saying="--preview: is for packs")


class SmallScene(CommandCase):
    def setUp(self):
        super().setUp()
        write_png(self.path("a.png"), [[200, 40, 40] * 8] * 8, 3)
        write_png(self.path("b.png"), [[40, 40, 200] * 8] * 8, 3)
        self.nodes = {"cells": {"block": "tile-map", "cells": [8, 8]},
                      "which": {"block": "indirection-map", "grid": "cells", "map": [[(x + y) % 2 for x in range(8)] for y in range(8)]},
                      "look": {"block": "reference-texture", "patterns": ["a.png", "b.png"], "pattern": "which", "place": "cells", "seamless": False}}

    def scene(self, nodes=None, **more):
        return self.write_json("s.json", {"format": "tilepack-scene", "version": 1, "size": [64, 64], "nodes": nodes or self.nodes, "output": "look", **more})

    def test_texels_are_where_the_map_says(self):
        self.run_tilepack("compose", self.scene(), "-o", "s.png")
        rows, channels, _ = read_png(self.path("s.png"))
        self.assertEqual((len(rows), channels), (64, 4))
        for y in range(64):
            for x in range(64):
                want = [200, 40, 40, 255] if (x // 8 + y // 8) % 2 == 0 else [40, 40, 200, 255]
                self.assertEqual(rows[y][4 * x:4 * x + 4], want, (x, y))
        self.run_tilepack("compose", "s.json", "-o", "half.png", "--scale", "0.0625")
        rows, _, _ = read_png(self.path("half.png"))
        red, green, blue = rows[1][4:7]  # a pixel that covers 2 x 2 cells: the mean in linear light
        self.assertEqual(red, blue)
        self.assertGreater(red, 120)
        self.assertEqual(green, 40)
        self.run_tilepack("compose", "s.json", "-o", "view.png", "--camera", "0.1,1,0.1,0,0,-1,0,1,0,60", "--size", "64x48")
        self.run_tilepack("compose", "s.json", "-o", "linear.exr", "--level", "2", "--rect=-3,2,8,8", "--filter", "elliptical")

    def test_a_depfile_names_all_that_is_read(self):
        self.run_tilepack("compose", self.scene(), "-o", "s.png", "--depfile", "s.d")
        with open(self.path("s.d"), encoding="utf-8") as stream:
            rule = stream.read()
        for name in ("s.png", "s.json", "a.png", "b.png"):
            self.assertIn(name, rule)
        self.refused("compose", "s.json", "-o", "a.png", code=1, saying="'a.png' would replace a file that is worked from")

    def test_what_is_wrong_is_said_by_compose_and_numbered_by_validate(self):
        n = self.nodes
        cases = [
            ("TP805", {**n, "look": {**n["look"], "place": "which"}}, "nodes.look.place: takes a grid or a place"),
            ("TP802", {**n, "look": {"block": "reference-texture", "patterns": ["a.png"]}}, 'the input "place" is missing'),
            ("TP803", {**n, "look": {**n["look"], "block": "texture"}}, "nodes.look.block: \"texture\" is no block"),
            ("TP804", {**n, "look": {**n["look"], "pattern": "whihc"}}, 'did you mean "which"?'),
            ("TP806", {**n, "look": {"block": "layers", "textures": ["two"]}, "two": {"block": "layers", "textures": ["look"]}}, "is made from itself"),
            ("TP807", {**n, "cells": {"block": "tile-map", "cells": [7, 8]}}, "7 columns don't divide the 64 texels"),
            ("TP808", {**n, "which": {"block": "probability-map", "grid": "cells", "probabilities": [0.5, 0.6]}}, "sum to 1.1; they must sum to 1"),
            ("TP809", {**n, "which": {"block": "virtual-indirection-map", "grid": "cells", "count": 3}}, "gives numbers up to 2, and there are 2 patterns"),
            ("TP811", {**n, "look": {**n["look"], "patterns": ["a.png", "none.png"]}}, "none.png: cannot be opened"),
            ("TP812", {**n, "which": {"block": "indirection-map", "grid": "cells", "map": "a.png"}}, "a.png: has 3 channels"),
        ]
        for rule, nodes, saying in cases:
            with self.subTest(rule):
                self.scene(nodes)
                code = 2 if rule == "TP811" else 3
                message = self.refused("compose", "s.json", "-o", "s.png", code=code, saying=saying)
                self.assertIn("s.json:1: nodes.", message)
                report = json.loads(self.run_tilepack("validate", "s.json", "--format", "json", code=5).stdout)
                self.assertIn(rule, [issue["rule"] for issue in report["issues"]])
                if rule in ("TP803", "TP804"):  # what would show the rest is not known
                    self.assertNotIn("TP813", [issue["rule"] for issue in report["issues"]])
        big = {**n, "cells": {"block": "tile-map", "cells": [2**20, 2**20]}}
        self.write_json("s.json", {"format": "tilepack-scene", "version": 1, "size": [2**24, 2**24], "nodes": big, "output": "look"})
        self.refused("compose", "s.json", "-o", "s.png", code=3, saying="1048576 x 1048576 cells would be stored, and 2^28 are the most")
        self.assertIn("TP810", self.run_tilepack("validate", "s.json", code=5).stdout)
        self.write("s.json", '{"format": "tilepack-scene", ')
        self.assertIn("TP801", self.run_tilepack("validate", "s.json", code=5).stdout)
        self.write("s.json", json.dumps({"format": "tilepack-scene", "version": 1, "size": [64, 64], "nodes": n, "output": "look", "sead": 3}, indent=1))
        line = 1 + self.contents()["s.json"].decode().split('"sead"')[0].count("\n")
        self.refused("compose", "s.json", "-o", "s.png", code=3, saying=f's.json:{line}: sead: unknown field; did you mean "seed"?')
        self.assertIn(f"s.json:{line}", self.run_tilepack("validate", "s.json", code=5).stdout)
        self.scene({**n, "left": {"block": "time"}})
        self.assertIn("TP813", self.run_tilepack("validate", "s.json").stdout)

    def test_options_that_make_no_sense_are_refused(self):
        self.scene()
        for options, saying in ((["--frames", "5"], "is no sequence"), (["--frames", "5..2"], "is no sequence"), (["--step", "2"], "goes with --frames"),
                                (["--map", "height"], "--map"), (["--filter", "bicubic"], "--filter"), (["--size", "9x9"], "camera views only"),
                                (["--rect", "1,2"], "is no window"), (["--frames", "0..200000"], "at most 100000")):
            with self.subTest(options):
                self.refused("compose", "s.json", "-o", "s.png", *options, code=1, saying=saying)
        self.refused("validate", "s.json", "--against-reference", code=1, saying="is for packs")

    def test_a_batch_makes_it_again_when_a_picture_that_it_names_changes(self):
        self.scene()
        self.write_json("m.json", {"format": "tilepack-manifest", "version": 1, "jobs": [{"verb": "compose", "scene": "s.json", "output": "s.png"}]})
        self.run_tilepack("batch", "m.json", "-q")
        before = self.contents()["s.png"]
        self.run_tilepack("batch", "m.json", "-q")
        write_png(self.path("b.png"), [[40, 220, 40] * 8] * 8, 3)
        self.run_tilepack("batch", "m.json", "-q")
        self.assertNotEqual(self.contents()["s.png"], before)


class WrongKinds(CommandCase):
    def test_a_pack_is_no_scene_and_a_scene_no_pack(self):
        self.noise_png("a.png", 48, 48)
        self.run_tilepack("bake", "a.png", "-o", "p", "--tile-size", "16", "--effort", "0")
        self.write_json("s.json", {"format": "tilepack-scene", "version": 1, "size": [64, 64], "nodes": {"p": {"block": "pack", "file": "p"}}, "output": "p"})
        self.refused("compose", "p", "-o", "x.png", code=3, saying=["render shows packs"])
        self.refused("shader", "s.json", "--lang", "c", code=3, saying=["this is a scene", "compose draws it"])

    def test_patterns_of_two_sizes_are_found_without_drawing(self):
        self.noise_png("a.png", 32, 32)
        self.noise_png("b.png", 32, 16)
        self.write_json("s.json", {"format": "tilepack-scene", "version": 1, "size": [64, 64], "nodes": {
            "cells": {"block": "tile-map", "cells": [2, 2]},
            "look": {"block": "reference-texture", "patterns": ["a.png", "b.png"], "pattern": 0, "place": "cells"}}, "output": "look"})
        found = self.run_tilepack("validate", "s.json", code=5)
        self.assertIn("patterns of a set have one size", found.stdout)


class Transitions(CommandCase):
    def test_tiles_of_a_transition_follow_a_map_of_materials(self):
        side, tile, cells = 48, 16, 8
        for name, least in (("dark.png", 10), ("bright.png", 150)):
            rows = [[least + (x * 37 + y * 61 + x * y * 13) % 90 for x in range(side)] for y in range(side)]
            write_png(self.path(name), rows, 1)
        write_png(self.path("land.png"), [[int(x >= cells // 2) for x in range(cells)] for _ in range(cells)], 1)
        for colors in ("2", "4"):
            with self.subTest(colors=colors):
                self.run_tilepack("bake", "--transition", "dark.png", "bright.png", "-o", "t" + colors, "--tile-size", str(tile), "--effort", "0", "--colors",
                                  colors, "--flatten", "0")
                self.write_json("s.json", {"format": "tilepack-scene", "version": 1, "size": [cells * tile] * 2, "nodes": {
                    "land": {"block": "areas-map", "map": "land.png"}, "cells": {"block": "tile-map", "cells": [cells, cells]},
                    "join": {"block": "transition-tiles", "grid": "cells", "material": "land", "pack": "t" + colors}}, "output": "join"})
                self.run_tilepack("compose", "s.json", "-o", "s.png", "--rect", f"0,0,{cells * tile},{cells * tile}")
                rows, channels, _ = read_png(self.path("s.png"))
                value = lambda x, y: rows[y][x * channels]
                plain = [(x, y) for y in range(cells) for x in range(cells // 2 - 1)]
                for x, y in plain: # corners of one material: its texels alone
                    for dy in range(tile):
                        for dx in range(tile):
                            self.assertLess(value(x * tile + dx, y * tile + dy), 101)
                            self.assertGreater(value((x + cells // 2) * tile + dx, y * tile + dy), 149)
                shown = {tuple(value(x * tile + dx, y * tile + dy) for dy in range(tile) for dx in range(tile)) for x, y in plain}
                self.assertGreater(len(shown), 2, "variants, or colors of a material, are not all used")


if __name__ == "__main__":
    unittest.main()
