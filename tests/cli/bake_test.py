"""tilepack bake on good input: what it writes, that it repeats, presets, depths, dependency files."""

import json
import os
import random
import re
import signal
import subprocess
import time
import unittest

import jsonschema

from command import SOURCE, TILEPACK, CommandCase, float_exr
from png_image import read_png
from png_image import write_png

SMALL = ("--tile-size", 16, "--effort", 0, "--virtual-size", 8)


class Bake(CommandCase):
    def bake(self, *arguments, sample=None, output="out", **options):
        return self.run_tilepack("bake", sample or self.noise_png("sample.png"), "-o", output, *SMALL, *arguments,
                                 **options)

    def pack(self, output="out"):
        return self.read_json(output + "/pack.json")

    def test_writes_what_it_says(self):
        done = self.bake("--report-format", "json")
        report = json.loads(done.stdout)
        self.assertEqual(sorted(report["files"]), sorted(self.contents("out")))
        self.assertEqual(report["tiles"], 16)
        self.assertIn("out: 16 tiles of 16 x 16 texels", self.bake().stdout)

    def test_packs_follow_the_schema(self):
        with open(os.path.join(SOURCE, "lib/tilepack/pack/pack.schema.json"), encoding="utf-8") as stream:
            schema = json.load(stream)
        jsonschema.Draft202012Validator.check_schema(schema)
        validator = jsonschema.Draft202012Validator(schema)
        kinds = [(), ("--mapping", "permutation"), ("--mapping", "index"), ("--colors", "3x1", "--mips", "none"),
                 ("--mips", "corners"), ("--tile-size", "12x20"), ("--format", "exr"),
                 ("--layout", "rotated"), ("--layout", "array", "--border", 2), ("--corner-pack",), ("--variants", 2),
                 ("--variants", 3, "--mapping", "mix", "--coloring", "edge"), ("--variants", 8, "--colors", 1)]
        for arguments in kinds:
            with self.subTest(arguments):
                self.bake(*arguments)
                validator.validate(self.pack())

    def test_schema_and_program_refuse_the_same(self):
        with open(os.path.join(SOURCE, "lib/tilepack/pack/pack.schema.json"), encoding="utf-8") as stream:
            validator = jsonschema.Draft202012Validator(json.load(stream))
        self.bake("--mapping", "permutation", "--coloring", "edge")
        good = self.pack()
        for place, value in [(("version",), 2), (("tile_size", 0), 0), (("maps", 0, "levels", 0, "file"), "../a"),
                             (("mapping", "table", 0), -1), (("colors", "vertical"), 9), (("mips", "filter"), "sinc"),
                             (("maps", 0, "extra"), 1), (("tiles", 0, "nw"), 0), (("generator", "seed"), 2**53)]:
            with self.subTest(place):
                changed = json.loads(json.dumps(good))
                parent = changed
                for step in place[:-1]:
                    parent = parent[step]
                parent[place[-1]] = value
                self.assertFalse(validator.is_valid(changed))
                self.write_json("out/pack.json", changed)
                # Writing over a pack reads it first.
                self.refused("bake", "sample.png", "-o", "out", *SMALL, code=4, saying="no readable tile pack")

    def test_same_bytes_for_any_number_of_threads_and_run(self):
        self.bake("--jobs", 1, output="one")
        self.bake("--jobs", 4, output="four")
        self.bake("--jobs", 4, output="again")
        self.assertEqual(self.contents("one"), self.contents("four"))
        self.assertEqual(self.contents("again"), self.contents("four"))
        self.bake("--seed", 1, output="other")
        self.assertNotEqual(self.contents("one")["color_0.png"], self.contents("other")["color_0.png"])

    def test_flattening_is_an_option_like_others(self):
        self.bake(output="plain")
        self.bake("--flatten", "auto", output="auto")
        self.assertEqual(self.contents("plain"), self.contents("auto"))
        self.assertNotIn("flatten", self.pack("plain")["generator"]["options"])
        self.bake("--flatten", 0, output="none")
        self.assertEqual(self.contents("plain")["color_0.png"], self.contents("none")["color_0.png"])
        self.assertEqual(self.pack("none")["generator"]["options"]["flatten"], "0")
        self.bake("--flatten", 100, "--jobs", 1, output="one")
        self.bake("--flatten", 100, "--jobs", 4, output="four")
        self.assertEqual(self.contents("one"), self.contents("four"))
        self.assertNotEqual(self.contents("one")["color_0.png"], self.contents("plain")["color_0.png"])
        self.assertEqual(self.pack("one")["generator"]["options"]["flatten"], "100")
        self.write_json("even.json", {"purpose": "p", "cost": "c", "flatten": 100, "tile-size": 16, "effort": 0,
                                      "virtual-size": 8})
        self.run_tilepack("bake", "sample.png", "-o", "preset", "--preset", self.path("even.json"))
        self.assertEqual(self.contents("preset"), self.contents("one"))
        self.run_tilepack("validate", "one")
        for value in ("101", "-1", "half"):
            self.refused("bake", "sample.png", "-o", "no", *SMALL, f"--flatten={value}", code=1,
                         saying="a whole number of 0 to 100")

    def test_uneven_planks_are_straightened_and_tiles_hold_them_by_default(self):
        uneven = (1, -1, -2, 0, 1, 2, 1)  # texels, of the grooves between planks of 40
        noise = random.Random(1)
        rows = []
        for y in range(290):
            groove = any(abs(y - 18 - 40 * k - off) < 3 for k, off in enumerate(uneven))
            plank = sum(y > 18 + 40 * k + off for k, off in enumerate(uneven))
            rows.append([40 if groove else 110 + 7 * (plank * 5 % 4) + noise.randrange(20) for _ in range(200)])
        write_png(self.path("planks.png"), rows, 1)
        bake = ("bake", "planks.png", "--effort", 0, "--virtual-size", 8)
        # Tiles of 80 suit so small a sample, and hold two planks.
        report = json.loads(self.run_tilepack(*bake, "-o", "one", "--jobs", 1, "--report-format", "json").stdout)
        self.assertEqual(report["tile_size"], [80, 80])
        self.assertTrue(1 < report["straightened"] < 5, report["straightened"])
        self.assertEqual(self.pack("one")["generator"]["options"]["tile-size"], "auto")
        self.assertIn("straightened", self.run_tilepack(*bake, "-o", "four", "--jobs", 4).stdout)
        self.assertEqual(self.contents("one"), self.contents("four"))
        report = json.loads(self.run_tilepack(*bake, "-o", "as_is", "--no-straighten", "--report-format", "json").stdout)
        self.assertNotIn("straightened", report)
        self.assertEqual(self.pack("as_is")["generator"]["options"]["straighten"], "false")
        self.run_tilepack(*bake, "-o", "asked", "--tile-size", 128)
        self.assertEqual(self.pack("asked")["tile_size"], [128, 128])

    def test_variants_are_whole_packs_in_every_layout(self):
        self.bake(output="plain")
        self.bake("--variants", 1, output="one")
        self.assertEqual(self.contents("plain"), self.contents("one"))
        self.assertNotIn("variants", self.pack("plain"))
        for options in ((), ("--coloring", "edge"), ("--coloring", "edge", "--corner-pack"), ("--layout", "rotated"),
                        ("--layout", "array", "--border", 2), ("--mapping", "index"), ("--mips", "least-squares")):
            with self.subTest(options):
                self.bake("--variants", 2, *options, output="two")
                pack = self.pack("two")
                self.assertEqual((pack["variants"], len(pack["tiles"])), (2, 32))
                colors = [{k: v for k, v in tile.items() if k != "id"} for tile in pack["tiles"]]
                self.assertEqual(colors[:16], colors[16:])
                self.run_tilepack("validate", "two")
        self.assertIn("2 variants", self.run_tilepack("inspect", "two").stdout)
        self.bake("--variants", 2, "--jobs", 1, output="few")
        self.bake("--variants", 2, "--jobs", 4, output="many")
        self.assertEqual(self.contents("few"), self.contents("many"))
        self.run_tilepack("inspect", "many", "--picture", "tiles.png")
        self.run_tilepack("inspect", "many", "--mapping")
        for options, saying in ((("--variants", 9), "1 to 8"), (("--variants", 2, "--interior", "quilt"), "--interior patch"),
                                (("--variants", 2, "--colors", "8x8"), "4096"),
                                (("--variants", 2, "--set", "sequential"), "sequential set")):
            self.refused("bake", "sample.png", "-o", "no", *SMALL, *options, code=1, saying=saying)

    def test_nothing_of_the_machine_is_recorded(self):
        self.bake(output="plain")
        os.mkdir(self.path("deep"))
        self.bake(sample=self.noise_png("deep/sample.png"), output="deep/out")
        self.assertEqual(self.contents("plain"), self.contents("deep/out"))

    def test_another_pack_is_replaced_and_other_files_stay(self):
        self.bake("--format", "exr", "--mapping", "index")
        self.write("out/notes.txt", "mine")
        self.bake()
        self.bake(output="fresh")
        self.assertEqual(self.contents("out"), {**self.contents("fresh"), "notes.txt": b"mine"})

    def test_depth_follows_the_sample(self):
        for bits, depth in ((8, "u8"), (16, "u16")):
            for channels in (1, 2, 3, 4):
                with self.subTest(bits=bits, channels=channels):
                    self.bake(sample=self.noise_png("s.png", 48, 40, channels, bits))
                    made = self.pack()["maps"][0]
                    self.assertEqual((made["depth"], made["channels"]), (depth, channels))
        self.write("s.exr", float_exr(48, 40, lambda x, y: (x * 7 + y * y) % 31 / 8.0))
        self.bake(sample="s.exr")
        made = self.pack()["maps"][0]
        self.assertEqual((made["depth"], made["encoding"]), ("f32", "linear"))
        self.bake("--depth", "u16", sample="s.exr")
        self.assertEqual(self.pack()["maps"][0]["encoding"], "srgb")

    def test_encoding_can_be_asked_for(self):
        self.bake("--encoding", "linear")
        self.assertEqual(self.pack()["maps"][0]["encoding"], "linear")

    def test_maps_stay_together(self):
        normal = self.noise_png("n.png", seed=2)
        rough = self.noise_png("r.png", channels=1, seed=3)
        self.bake("--map", f"normal={normal}", "--map", f"roughness={rough}", "--map", f"wet:data={rough}")
        made = self.pack()["maps"]
        self.assertEqual([(m["name"], m["role"]) for m in made],
                         [("color", "color"), ("normal", "normal"), ("roughness", "roughness"), ("wet", "data")])
        files = self.contents("out")
        self.assertEqual(files["roughness_0.png"], files["wet_0.png"])
        sample = self.noise_png("sample.png")
        self.run_tilepack("bake", "--map", f"normal={normal}", sample, "-o", "map_first", *SMALL)
        self.assertEqual([m["name"] for m in self.pack("map_first")["maps"]], ["color", "normal"])

    def test_a_folder_is_a_material(self):
        os.mkdir(self.path("rock"))
        self.noise_png("rock/rock_albedo.png")
        self.noise_png("rock/rock_nor_gl.png", seed=2)
        self.noise_png("rock/rock_rough.png", channels=1, seed=3)
        self.write("rock/readme.txt", "not a map")
        self.bake(sample="rock")
        made = self.pack()["maps"]
        self.assertEqual([(m["name"], m["role"]) for m in made],
                         [("color", "color"), ("normal", "normal"), ("roughness", "roughness")])
        self.bake(sample="rock/rock", output="by_name")
        self.assertEqual(self.contents("by_name"), self.contents("out"))
        self.bake("--map", "roughness=rock/rock_rough.png", sample="rock/rock_albedo.png", output="one")
        self.assertEqual([m["name"] for m in self.pack("one")["maps"]], ["color", "roughness"])
        self.noise_png("rock/bark_albedo.png")
        self.refused("bake", "rock", "-o", "out", code=3, saying="bark, rock")

    def test_tile_sizes_that_are_no_power_of_two(self):
        for size, levels in (("12", 3), ("20x12", 3), ("15", 1), ("24x16", 4)):
            with self.subTest(size):
                self.bake("--tile-size", size)
                self.assertEqual(self.pack()["mips"]["tile_levels"], levels)

    def test_levels_go_on_to_the_mean_of_the_pack(self):
        self.bake("--full-mips", "--tile-size", "24x16")
        pack = self.pack()
        levels = pack["maps"][0]["levels"]
        self.assertEqual(pack["mips"]["tile_levels"], 4)
        self.assertIs(pack["mips"]["full_chain"], True)
        self.assertEqual([level["size"] for level in levels], [[96, 64], [48, 32], [24, 16], [12, 8], [6, 4], [3, 2], [1, 1]])
        self.assertEqual(pack["generator"]["options"]["full-mips"], "true")
        self.run_tilepack("validate", "out")
        means = []
        for level in (levels[3], levels[6]):  # as light
            rows, channels, _ = read_png(self.path("out", level["file"]))
            light = [[(v / 255 / 12.92 if v < 10.02 else ((v / 255 + 0.055) / 1.055) ** 2.4) for v in row] for row in rows]
            means.append([sum(row[x] for row in light for x in range(c, len(row), channels)) * channels / (len(rows) * len(rows[0])) for c in range(channels)])
        for fine, coarse in zip(*means):
            self.assertAlmostEqual(fine, coarse, delta=0.004)
        self.refused("bake", "sample.png", "-o", "out", "--full-mips", "--mips", "none", code=1, saying="--full-mips")
        self.bake()
        self.assertNotIn("full-mips", self.pack()["generator"]["options"])

    def test_presets_are_listed_for_machines_too(self):
        listing = json.loads(self.run_tilepack("bake", "--list-presets", "--report-format", "json").stdout)
        self.assertLessEqual({"preview", "default", "terrain", "wall", "hero"}, {p["name"] for p in listing})
        for preset in listing:
            self.assertEqual(set(preset), {"name", "purpose", "cost", "settings"})
            self.assertTrue(preset["settings"])

    def test_every_preset_bakes(self):
        listing = self.run_tilepack("bake", "--list-presets").stdout
        names = re.findall(r"^(\S+)$", listing, re.MULTILINE)
        self.assertGreaterEqual(len(names), 5)
        for name in names:
            with self.subTest(name):
                self.run_tilepack("bake", self.noise_png("sample.png", 96, 96), "-o", name, "--preset", name,
                                  "--tile-size", 24, "--effort", 0, "--guard", 2)
                self.assertEqual(self.pack(name)["tile_size"], [24, 24])

    def test_flags_override_presets_and_files_are_presets(self):
        self.write_json("mine.json", {"purpose": "a test", "cost": "nothing", "seed": 5, "colors": "1x3"})
        self.run_tilepack("bake", self.noise_png("sample.png"), "-o", "out", *SMALL, "--preset", "mine.json", "--seed", 6)
        self.assertEqual(self.pack()["generator"]["seed"], 6)
        self.assertEqual(self.pack()["colors"], {"horizontal": 1, "vertical": 3})

    def test_depfile_names_inputs_escaped(self):
        sample = self.noise_png("my $ample #1.png")
        self.bake("--depfile", "out.d", sample=sample)
        with open(self.path("out.d"), encoding="utf-8") as stream:
            rule = stream.read()
        self.assertEqual(rule, "out/pack.json: \\\n  my\\ $$ample\\ \\#1.png\n\nmy\\ $$ample\\ \\#1.png:\n")

    def test_make_reads_the_depfile(self):
        sample = self.noise_png("my $ample #1.png")
        self.bake("--depfile", "out.d", sample=sample)
        self.write("Makefile", "all: out/pack.json\ninclude out.d\nout/pack.json:\n\t@echo rebuilt\n")
        try:
            make = lambda: subprocess.run(["make", "-s"], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(make().stdout, "", make().stderr)
        except FileNotFoundError:
            self.skip("make is not installed")
        os.utime(self.path(sample), (2**31, 2**31))
        self.assertEqual(make().stdout, "rebuilt\n")

    def test_another_map_by_its_name_is_told_to_be_taken_as_color(self):
        for name, word, way in (("rock_height.png", "an sRGB color", "--map height=rock_height.png"),
                                ("rock_ao.png", "an sRGB color", "--map ao=rock_ao.png")):
            lines = self.bake(sample=self.noise_png(name)).stderr.splitlines()
            self.assertEqual(len(lines), 2)
            for text in (name, word, way, "--encoding linear"):
                self.assertIn(text, lines[0])
            for arguments in (("--quiet",), ("--encoding", "linear"), ("--encoding", "srgb")):
                self.assertNotIn("--map", self.bake(*arguments, sample=name).stderr)
        self.noise_png("rock_albedo.png")
        self.assertNotIn("--map", self.bake("--map", "height=rock_height.png", "--map", "ao:data=rock_ao.png",
                                            sample="rock_albedo.png").stderr)

    def test_quiet_and_no_terminal_mean_no_progress(self):
        self.assertEqual(self.bake("--quiet").stderr, "")
        self.assertEqual(len(self.bake().stderr.splitlines()), 1)

    def test_an_interrupt_leaves_a_whole_pack_or_nothing(self):
        sample = self.noise_png("sample.png", 128, 128)
        for wait in (0.0, 0.2, 0.6):
            process = subprocess.Popen(
                [TILEPACK, "bake", sample, "-o", "out", "--tile-size", "32", "--colors", "4", "--effort", "9"],
                cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(wait)
            process.send_signal(signal.SIGINT)
            code = process.wait()
            if code == 0:
                self.assertIn("out/pack.json", self.contents())
            else:
                self.assertEqual(code, -signal.SIGINT)
                self.assertEqual(sorted(self.contents()), ["sample.png"])


if __name__ == "__main__":
    unittest.main()
