"""tilepack batch: a manifest is made, again only where content changed, and failures are told one by one."""

import json
import os
import resource
import shutil
import subprocess
import unittest

from command import SOURCE, TILEPACK, CommandCase

SMALL = {"tile-size": 16, "effort": 0, "virtual-size": 8}


class Batch(CommandCase):
    def manifest(self, *jobs, name="m.json", **defaults):
        defaults.setdefault("options", SMALL)
        return self.write_json(name, {"format": "tilepack-manifest", "version": 1, "defaults": defaults, "jobs": list(jobs)})

    def samples(self, *names):
        os.makedirs(self.path("in"), exist_ok=True)
        for seed, name in enumerate(names):
            self.noise_png(f"in/{name}.png", 48, 48, seed=seed + 1)

    def batch(self, *arguments, code=0):
        done = subprocess.run([TILEPACK, "batch", *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout

    def counts(self, *arguments, code=0):
        """{"built": 2, "current": 1} of the last line."""
        line = self.batch(*arguments, code=code).splitlines()[-1]
        return {word: int(count) for count, word in (part.split() for part in line.split(": ")[1].split(", "))}

    def plan(self, *arguments, code=0):
        """{name: reasons} of what would be made."""
        lines = self.batch(*arguments, "--dry-run", code=code).splitlines()[:-1]
        return {line.split(": ", 1)[0]: line.split(": ", 1)[1] for line in lines}

    def edit(self, name, at=-20):
        with open(self.path(name), "r+b") as stream:
            stream.seek(at, os.SEEK_END)
            byte = stream.read(1)
            stream.seek(at, os.SEEK_END)
            stream.write(bytes([byte[0] ^ 1]))


class WhatIsMade(Batch):
    def test_what_no_entry_makes_any_more_is_named(self):
        self.samples("a", "b")
        os.makedirs(self.path("packs/other"))  # of nobody
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"},
                      {"verb": "render", "packs": "packs/*", "options": {"scale": 0.25}, "output": "previews/{stem}.png"})
        self.batch("m.json")
        self.assertEqual(self.plan("m.json"), {})
        os.remove(self.path("in/b.png"))
        left = "left by an earlier run, no entry of this manifest makes it"
        self.assertEqual(self.plan("m.json"), {"packs/b": left, "previews/b.png": left})
        self.batch("m.json")
        shutil.rmtree(self.path("packs/b"))
        os.remove(self.path("previews/b.png"))  # its side file stays, and says nothing any more
        self.assertEqual(self.plan("m.json"), {})

    def test_packs_previews_and_checks_are_one_build(self):
        self.samples("a", "b")
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"},
                      {"verb": "render", "packs": "packs/*", "options": {"scale": 0.5}, "output": "previews/{stem}.png"},
                      {"verb": "validate", "pack": "packs/a", "options": {"format": "json", "against-reference": False},
                       "output": "checks/a.json"},
                      {"verb": "inspect", "packs": "packs/*", "output": "notes/{stem}.txt"},
                      {"verb": "compare", "a": "packs/a", "b": "packs/a", "output": "same.txt"})
        self.assertEqual(self.counts("m.json", "--jobs", 2), {"built": 8})
        self.assertTrue(self.read_json("checks/a.json")["passed"])
        self.assertNotIn("TP208", str(self.read_json("checks/a.json")), "the side file of batch is no stray file")
        self.assertEqual(self.counts("m.json"), {"current": 8})

    def test_the_bytes_are_those_of_bake(self):
        self.samples("a")
        self.manifest({"sample": "in/a.png", "options": {"seed": 5, "corner-pack": True}, "output": "batched"})
        self.batch("m.json")
        self.run_tilepack("bake", "in/a.png", "-o", "alone", "--tile-size", 16, "--effort", 0, "--virtual-size", 8, "--seed", 5,
                          "--corner-pack")
        made = {name: data for name, data in self.contents("batched").items() if not name.endswith(".build")}
        strip = lambda files: {os.path.basename(name): data for name, data in files.items()}
        self.assertEqual(strip(made), strip(self.contents("alone")))

    def test_materials_by_folder_maps_presets_and_hand_drawn_tiles(self):
        self.samples("a")
        for name in ("rock", "sand"):
            os.makedirs(self.path("materials", name))
            self.noise_png(f"materials/{name}/{name}_albedo.png", 48, 48)
            self.noise_png(f"materials/{name}/{name}_height.png", 48, 48, channels=1)
        self.noise_png("height.png", 48, 48, channels=1, seed=9)
        self.write_json("mine.json", {"purpose": "p", "cost": "c", "layout": "array"})
        os.makedirs(self.path("drawn"))
        for i in range(2):
            self.noise_png(f"drawn/t{i}.png", 16, 16, seed=7)
        self.write_json("colors.json", [{"nw": 0, "ne": 0, "sw": 0, "se": 0}] * 2)
        self.manifest({"samples": "materials/*", "output": "packs/{folder}"},
                      {"sample": "in/a.png", "maps": {"height": "height.png"}, "preset": "mine.json", "output": "packs/a"},
                      {"verb": "pack", "tiles": "drawn/*.png", "output": "packs/drawn",
                       "options": {"colors": "colors.json", "layout": "array", "mapping": "index", "virtual-size": 4, "tolerance": 1}})
        self.assertEqual(self.counts("m.json"), {"built": 4})
        self.assertEqual([m["name"] for m in self.read_json("packs/rock/pack.json")["maps"]], ["color", "height"])
        self.assertEqual(self.read_json("packs/a/pack.json")["layout"]["kind"], "array")
        self.write_json("mine.json", {"purpose": "other words", "cost": "c", "layout": "array"})
        self.assertEqual(self.counts("m.json"), {"current": 4})
        self.write_json("mine.json", {"purpose": "p", "cost": "c", "layout": "array", "seed": 4})
        self.assertEqual(self.plan("m.json"), {"packs/a": "option seed: 0 → 4"})
        self.edit("drawn/t1.png")
        self.assertEqual(self.plan("m.json")["packs/drawn"], "tile 1 changed")
        self.noise_png("materials/rock/rock_normal.png", 48, 48)
        self.assertIn("map normal added", self.plan("m.json")["packs/rock"])

    def test_a_pack_with_its_shader_page_and_checks_is_one_build(self):
        self.samples("a", "b")
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"},
                      {"verb": "shader", "packs": "packs/*", "options": {"lang": "glsl"}, "output": "shaders/{stem}.glsl"},
                      {"verb": "view", "packs": "packs/*", "options": {"metres": 2}, "output": "pages/{stem}.html"},
                      {"verb": "validate", "packs": "packs/*", "output": "checks/{stem}.txt"})
        plan = self.plan("m.json")
        self.assertIn("packs/a is made again", plan["shaders/a.glsl"])
        self.assertEqual(self.counts("m.json", "--depfile", "m.d"), {"built": 8})
        self.run_tilepack("shader", "packs/a", "--lang", "glsl", "-o", "alone.glsl")
        self.run_tilepack("view", "packs/a", "--metres", "2", "-o", "alone.html")
        made = self.contents()
        self.assertEqual(made["shaders/a.glsl"], made["alone.glsl"])
        self.assertEqual(made["pages/a.html"], made["alone.html"])
        self.assertEqual(self.counts("m.json"), {"current": 8})
        self.assertIn(b"packs/a/pack.json", made["m.d"])
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"},
                      {"verb": "shader", "packs": "packs/*", "options": {"lang": "hlsl"}, "output": "shaders/{stem}.glsl"},
                      {"verb": "view", "packs": "packs/*", "options": {"metres": 2}, "output": "pages/{stem}.html"})
        self.assertEqual(self.plan("m.json"), {f"shaders/{name}.glsl": "option lang: glsl → hlsl" for name in "ab"})
        self.noise_png("in/a.png", 48, 48, seed=77)
        self.assertEqual(set(self.plan("m.json")), {"packs/a", "shaders/a.glsl", "pages/a.html", "shaders/b.glsl"})
        for kind in ("ninja", "make"):
            rules = self.batch("m.json", "--emit", kind)
            self.assertIn("shaders/a.glsl", rules)
            self.assertIn("pages/b.html", rules)

    def test_a_page_of_a_scene_hangs_on_what_the_scene_names(self):
        self.samples("a")
        self.write_json("scene.json", {"format": "tilepack-scene", "version": 1, "size": [128, 128], "output": "look",
                                       "nodes": {"look": {"block": "pack", "file": "packs/a"}}})
        self.manifest({"sample": "in/a.png", "output": "packs/a"},
                      {"verb": "view", "pack": "scene.json", "output": "pages/scene.html"})
        plan = self.plan("m.json")
        self.assertIn("packs/a is made again", plan["pages/scene.html"])
        self.assertEqual(self.counts("m.json"), {"built": 2})
        self.assertEqual(self.counts("m.json"), {"current": 2})
        self.run_tilepack("bake", "in/a.png", "-o", "packs/a", "--tile-size", 16, "--effort", 0, "--virtual-size", 8, "--seed", 9)
        self.manifest({"verb": "view", "pack": "scene.json", "output": "pages/scene.html"})
        self.assertIn("changed", self.plan("m.json")["pages/scene.html"])

    def test_checks_and_figures_of_a_scene_hang_on_what_the_scene_names(self):
        self.noise_png("picture.png", 16, 16)
        self.write_json("scene.json", {"format": "tilepack-scene", "version": 1, "size": [128, 128], "output": "look",
                                       "nodes": {"cells": {"block": "tile-map", "cells": [8, 8]},
                                                 "look": {"block": "reference-texture", "patterns": ["picture.png"], "place": "cells"}}})
        self.manifest({"verb": "validate", "pack": "scene.json", "output": "checks.txt"},
                      {"verb": "inspect", "pack": "scene.json", "output": "figures.txt"})
        self.assertEqual(self.counts("m.json"), {"built": 2})
        self.assertEqual(self.counts("m.json"), {"current": 2})
        self.noise_png("picture.png", 16, 16, seed=9)
        self.assertEqual(self.plan("m.json"), {name: "scene picture.png changed" for name in ("checks.txt", "figures.txt")})
        os.remove(self.path("picture.png"))
        self.assertEqual(self.counts("m.json", code=2), {"failed": 2})

    def test_texts_that_name_their_pack_are_not_taken_from_another_of_the_same_content(self):
        self.samples("a")
        shutil.copy(self.path("in/a.png"), self.path("in/b.png"))
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"},
                      {"verb": "shader", "packs": "packs/*", "options": {"lang": "c"}, "output": "shaders/{stem}.h"})
        self.batch("m.json", "--cache", "cache", "--jobs", 1)
        self.assertIn(b"shader b --lang c", self.contents()["shaders/b.h"])

    def test_a_transition_is_an_entry(self):
        self.samples("sand", "grass")
        self.noise_png("in/grass.png", 40, 56, seed=5)
        self.manifest({"transition": ["in/sand.png", "in/grass.png"], "output": "packs/{stem}_shore"},
                      {"verb": "validate", "packs": "packs/*", "output": "checks/{stem}.txt"})
        self.assertEqual(self.counts("m.json"), {"built": 2})
        self.run_tilepack("bake", "--transition", "in/sand.png", "in/grass.png", "-o", "alone", "--tile-size", 16, "--effort", 0,
                          "--virtual-size", 8)
        made = {os.path.basename(name): data for name, data in self.contents("packs/sand_shore").items() if not name.endswith(".build")}
        self.assertEqual(made, {os.path.basename(name): data for name, data in self.contents("alone").items()})
        self.assertEqual(self.counts("m.json"), {"current": 2})
        os.utime(self.path("in/grass.png"), (1, 1))
        self.assertEqual(self.counts("m.json"), {"current": 2})
        self.noise_png("in/grass.png", 40, 56, seed=6)
        self.assertEqual(self.plan("m.json")["packs/sand_shore"], "material grass color changed")
        rules = self.batch("m.json", "--emit", "ninja")
        self.assertIn("in/sand.png", rules)
        self.assertIn("in/grass.png", rules)
        # Materials that are folders: a map that comes along counts.
        os.makedirs(self.path("rock"))
        os.makedirs(self.path("moss"))
        for name in ("rock", "moss"):
            self.noise_png(f"{name}/{name}_albedo.png", 48, 48)
        self.manifest({"transition": ["rock", "moss"], "output": "packs/two"})
        self.assertEqual(self.counts("m.json"), {"built": 1})
        for name in ("rock", "moss"):
            self.noise_png(f"{name}/{name}_height.png", 48, 48, channels=1)
        self.assertIn("material moss height added", self.plan("m.json")["packs/two"])

    def test_a_verdict_that_is_asked_for_fails_an_entry_and_advice_is_taken(self):
        self.samples("a")
        poor = {"interior": "quilt", "tile-size": 40, "effort": 0}
        self.manifest({"sample": "in/a.png", "options": poor, "output": "packs/a"})
        self.batch("m.json")
        good = {name: data for name, data in self.contents("packs/a").items() if not name.endswith(".build")}
        self.manifest({"sample": "in/a.png", "options": {**poor, "require": "good"}, "output": "packs/a"},
                      {"verb": "render", "packs": "packs/*", "output": "previews/{stem}.png"})
        told = self.batch("m.json", code=5)
        self.assertIn('the set is poor, and "require" asks for good: nothing was written; "apply-advice" tries', told)
        self.assertEqual({name: data for name, data in self.contents("packs/a").items() if not name.endswith(".build")}, good)
        self.assertFalse(os.path.exists(self.path("previews/a.png")))
        self.manifest({"sample": "in/a.png", "options": {**poor, "apply-advice": True}, "output": "packs/a"})
        self.assertEqual(self.plan("m.json"), {"packs/a": "option apply-advice: unset → true"})
        self.assertEqual(self.counts("m.json"), {"built": 1})
        self.run_tilepack("bake", "in/a.png", "-o", "alone", "--interior", "quilt", "--tile-size", 40, "--effort", 0,
                          "--virtual-size", 8, "--apply-advice")
        self.assertEqual(self.contents()["packs/a/color_0.png"], self.contents()["alone/color_0.png"])
        self.assertEqual(self.counts("m.json"), {"current": 1})

    def test_a_manifest_may_lie_elsewhere(self):
        self.samples("a")
        os.makedirs(self.path("art"))
        shutil.move(self.path("in"), self.path("art/in"))
        self.manifest({"samples": "in/*.png", "output": "../packs/{stem}"}, name="art/m.json")
        self.assertEqual(self.counts("art/m.json"), {"built": 1})
        self.assertTrue(os.path.exists(self.path("packs/a/pack.json")))

    def test_only_and_shards(self):
        self.samples(*"abcdefgh")
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"},
                      {"verb": "render", "packs": "packs/*", "output": "previews/{stem}.png"})
        names = [set(self.plan("m.json", "--shard", f"{i}/3")) for i in (1, 2, 3)]
        self.assertEqual(sorted(sum(map(list, names), [])), sorted(self.plan("m.json")))
        self.assertEqual(set(self.plan("m.json", "--only", "previews/a.png")), {"packs/a", "previews/a.png"})
        self.assertEqual(set(self.plan("m.json", "--only", "packs/[ab]")), {"packs/a", "packs/b"})
        self.samples(*"abcdefghi")
        for i in (1, 2, 3):  # what is added moves nothing
            more = set(self.plan("m.json", "--shard", f"{i}/3"))
            self.assertEqual(more - {"packs/i", "previews/i.png"}, names[i - 1])
        self.assertIn("did you mean 'packs/a'", self.run_tilepack("batch", "m.json", "--only", "packs/aa", code=1).stderr)
        self.assertIn("'4/3' is not allowed", self.run_tilepack("batch", "m.json", "--shard", "4/3", code=1).stderr)


class WhatChanged(Batch):
    def setUp(self):
        super().setUp()
        self.samples("a", "b", "c")
        self.jobs = [{"samples": "in/*.png", "output": "packs/{stem}"}]
        self.manifest(*self.jobs)
        self.batch("m.json")

    def test_touching_makes_nothing_and_one_byte_one(self):
        before = os.stat(self.path("packs/a/pack.json")).st_ino
        for name in ("in/a.png", "m.json", "packs/b/color_0.png"):
            os.utime(self.path(name))
        self.assertEqual(self.counts("m.json"), {"current": 3})
        self.edit("in/a.png")
        self.assertEqual(self.plan("m.json"), {"packs/a": "sample changed"})
        self.edit("in/a.png")
        self.assertEqual(self.plan("m.json"), {})
        self.noise_png("in/a.png", 48, 48, seed=77)
        self.assertEqual(self.counts("m.json"), {"built": 1, "current": 2})
        self.assertNotEqual(os.stat(self.path("packs/a/pack.json")).st_ino, before)

    def test_content_decides_even_if_no_time_tells(self):
        self.batch("m.json")  # has all files noted
        for name in ("in/a.png", "packs/b/color_0.png"):
            status = os.stat(self.path(name))
            self.edit(name)
            os.utime(self.path(name), ns=(status.st_atime_ns, status.st_mtime_ns))
        self.assertEqual(self.plan("m.json"), {"packs/a": "sample changed", "packs/b": "output color_0.png edited"})

    def test_outputs_that_were_edited_or_deleted_are_made_again(self):
        good = self.contents("packs")
        self.edit("packs/a/color_0.png")
        os.remove(self.path("packs/b/color_1.png"))
        os.remove(self.path("packs/c/pack.json"))
        self.assertEqual(self.plan("m.json"), {"packs/a": "output color_0.png edited", "packs/b": "output color_1.png missing",
                                               "packs/c": "output pack.json missing"})
        self.assertEqual(self.counts("m.json"), {"built": 3})
        self.assertEqual(self.contents("packs"), good)
        self.write("packs/a/pack.json", "{}")
        shutil.rmtree(self.path("packs/b"))
        self.assertEqual(self.counts("m.json"), {"built": 2, "current": 1})
        self.assertEqual(self.contents("packs"), good)

    def test_files_of_others_are_left_alone(self):
        os.remove(self.path("packs/a/pack.json"))
        self.write("packs/a/mine.txt", "keep")
        self.assertIn("holds files but no tile pack", self.batch("m.json", code=4))
        self.assertTrue(os.path.exists(self.path("packs/a/mine.txt")))

    def test_options_by_what_they_come_to(self):
        job = dict(self.jobs[0])
        for options, wanted in (({"seed": 0}, None), ({"report": "pages/{stem}.html", "jobs": 1, "max-texels": 99999}, None),
                                ({"colors": "2"}, None), ({"seed": 3}, "option seed: 0 → 3"),
                                ({"depth": "u16"}, "option depth: unset → u16"), ({"encoding": "linear"}, "option encoding: unset → linear")):
            with self.subTest(options):
                self.manifest({**job, "options": options})
                self.assertEqual(self.plan("m.json").get("packs/b"), wanted)

    def test_another_version(self):
        side = self.path("packs/a/.pack.json.build")
        with open(side, encoding="utf-8") as stream:
            text = stream.read()
        # A record whose key doesn't fit is none.
        with open(side, "w", encoding="utf-8") as stream:
            stream.write(text.replace('"version": "0.', '"version": "9.'))
        self.assertEqual(self.plan("m.json"), {"packs/a": "not built yet"})
        self.assertEqual(self.counts("m.json"), {"built": 1, "current": 2})

    def test_all_makes_everything(self):
        self.assertEqual(self.counts("m.json", "--all", "--only", "packs/a"), {"built": 1})
        self.assertEqual(self.counts("m.json", "--changed"), {"current": 3})
        self.run_tilepack("batch", "m.json", "--all", "--changed", code=1)

    def test_a_damaged_index_is_none(self):
        self.batch("m.json")
        for data in (b"", b"tilepack-index-1\n", os.urandom(5000)):
            self.write(".m.json.index", data)
            self.assertEqual(self.counts("m.json"), {"current": 3})
        os.remove(self.path(".m.json.index"))
        self.assertEqual(self.counts("m.json"), {"current": 3})


class Failures(Batch):
    def test_it_goes_on_and_tells_each_at_the_end(self):
        self.samples("a", "b")
        self.write("in/broken.png", b"no image")
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"},
                      {"verb": "render", "pack": "packs/broken", "output": "broken.png"},
                      {"sample": "missing.png", "output": "packs/missing"},
                      {"sample": "in/a.png", "options": {"guard": 9}, "output": "packs/large"})
        text = self.batch("m.json", code=3)
        self.assertIn("failed: packs/broken: in/broken.png: ", text)
        self.assertIn("failed: packs/missing: missing.png: ", text)
        self.assertRegex(text, r'failed: packs/large: m\.json:1: "guard": ')
        self.assertIn("6 entries: 2 built, 3 failed, 1 skipped", text)

    def test_a_check_that_fails_says_where_its_report_is(self):
        self.samples("a", "b")
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"},
                      {"verb": "compare", "a": "packs/a", "b": "packs/b", "output": "differ.txt"})
        self.assertIn("differ.txt", self.batch("m.json", code=5))
        self.assertEqual(self.counts("m.json", code=5), {"current": 2, "failed": 1})

    def test_errors_in_the_manifest_name_line_and_field(self):
        self.samples("a")
        good = '{"format": "tilepack-manifest", "version": 1, "defaults": {"options": {"tile-size": 16, "effort": 0}},\n "jobs": [\n  {"sample": "in/a.png", "output": "packs/a"},\n  %s\n ]}'
        for entry, code, saying in (
                ('{"sample": "in/a.png"}', 3, ["m.json:4: jobs[1]", '"output" is missing']),
                ('{"sampel": "in/a.png", "output": "b"}', 3, ["m.json:4: jobs[1]", 'did you mean "sample"']),
                ('{"sample": "in/a.png", "output": "b",\n "sead": 7}', 3, ['m.json:5: jobs[1].sead: unknown field; known are']),
                ('{"sample": 7, "output": "b"}', 3, ["m.json:4: jobs[1].sample"]),
                ('{"samples": "no/*.png", "output": "b"}', 2, ["m.json:4: jobs[1].samples", "matches nothing"]),
                ('{"sample": "in/a.png",\n "output": "packs/a"}', 3, ["m.json:5: jobs[1].output", "entry on line 3"]),
                ('{"sample": "in/a.png", "output": "packs/a/b"}', 3, ["m.json:4", "lies in the pack"]),
                ('{"verb": "bakee", "sample": "in/a.png", "output": "b"}', 3, ["m.json:4: jobs[1].verb"]),
                ('{"sample": "in/a.png", "output": "b",\n "options": {"seed": {}}}', 3, ["m.json:5: jobs[1].options.seed"]),
                ('{"sample": "in/a.png", "output": "b",\n "options": {"output": "c"}}', 3, ["m.json:5: jobs[1].options.output"]),
                ('{"verb": "render", "pack": "b.png", "output": "b.png"}', 3, ["m.json:4: jobs[1]", "reads what it writes"]),
                ('{"sample": "in/a.png", "output": "{name}"}', 3, ["m.json:4: jobs[1].output", "{stem}"]),
                ('{"sample": "in/a.png", "maps": {"nromal": "x.png"}, "output": "b"}', 3, ["m.json:4: jobs[1].maps.nromal"]),
                ('{"transition": ["in/a.png"], "output": "b"}', 3, ["m.json:4: jobs[1].transition"]),
                ('{"transition": ["in/a.png", "in/b.png"], "sample": "in/a.png", "output": "b"}', 3, ["m.json:4: jobs[1]", 'both "transition" and "sample"']),
                ('{"transition": ["in/a.png", "in/b.png"], "maps": {"normal": "n.png"}, "output": "b"}', 3, ['both "transition" and "maps"']),
                ('{"sample": "in/a.png", "output": "b",\n "options": {"transition": true}}', 3, ["m.json:5", '"transition": ["A", "B"]']),
                ('{"verb": "view", "pack": "b", "output": "b/page.html"},\n {"sample": "in/a.png", "output": "b"}', 3, ["lies in the pack"]),
                ('{', 3, ["m.json", "line 5"])):
            with self.subTest(entry):
                self.write("m.json", good % entry)
                self.refused("batch", "m.json", code=code, saying=saying)
        for entry, saying in (
                ('{"sample": "in/a.png", "output": "b",\n "options": {"require": "best"}}', 'm.json:5: "require": \'best\' is not allowed; it must be good or fair'),
                ('{"sample": "in/a.png", "output": "b",\n "options": {"apply-advice": "yes"}}', 'm.json:5: "apply-advice": \'yes\' is not allowed'),
                ('{"transition": ["in/a.png", "in/a.png"], "output": "b",\n "options": {"apply-advice": true}}', 'm.json:4 "apply-advice": does not go with "transition"; give'),
                ('{"sample": "in/a.png", "output": "b",\n "options": {"sede": 1}}', 'm.json:5: "sede": is no option of bake; did you mean "seed"?'),
                ('{"sample": "in/a.png", "output": "b",\n "options": {"seed": "x"}}', 'm.json:5: "seed": \'x\' is not allowed'),
                ('{"sample": "in/a.png", "output": "b",\n "options": {"seed": [1, 2]}}', 'm.json:5: "seed": has several values'),
                ('{"verb": "render", "pack": "packs/a", "output": "b.png",\n "options": {"levle": 1}}', 'm.json:5: "levle": is no option of render; did you mean "level"?')):
            with self.subTest(entry):
                self.write("m.json", good % entry)
                self.assertIn(saying, self.batch("m.json", code=3))
        self.assertIn("missing.json: there is no such file", self.run_tilepack("batch", "missing.json", code=2).stderr)

    def test_a_full_disk_and_inputs_that_vanish_leave_old_packs_whole(self):
        self.samples("a", "b")
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"})
        self.batch("m.json")
        good = self.contents("packs")
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}", "options": {"seed": 2}})
        full = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1500, 1500))
        done = subprocess.run([TILEPACK, "batch", "m.json"], cwd=self.folder, capture_output=True, text=True, preexec_fn=full)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("failed: packs/a: ", done.stdout)
        self.assertEqual(self.contents("packs"), good)
        self.manifest({"sample": "in/a.png", "output": "packs/a"}, {"sample": "in/b.png", "output": "packs/b"})
        os.remove(self.path("in/b.png"))
        self.assertIn("failed: packs/b: in/b.png: ", self.batch("m.json", code=2))
        self.assertEqual(self.contents("packs"), good)
        self.assertEqual(self.plan("m.json", code=2), {"packs/b": "can't be made: in/b.png: No such file or directory"})

    def test_memory_is_a_budget(self):
        self.samples("a", "b", "c")
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"})
        self.assertIn("more than the 1 MB of memory", self.batch("m.json", "--memory", "1M", code=1))
        self.assertEqual(self.counts("m.json", "--memory", "60M", "--jobs", 4), {"built": 3})
        self.run_tilepack("batch", "m.json", "--memory", "much", code=1)

    def test_the_schema_knows_what_the_reader_knows(self):
        import jsonschema
        with open(os.path.join(SOURCE, "lib/tilepack/batch/manifest.schema.json"), encoding="utf-8") as stream:
            schema = json.load(stream)
        jsonschema.Draft7Validator.check_schema(schema)
        self.manifest({"samples": ["in/*.png"], "output": "packs/{stem}", "options": {"seed": 3}},
                      {"verb": "pack", "tiles": ["a.png"], "output": "p", "options": {"colors": "c.json"}},
                      {"transition": ["a.png", "b.png"], "output": "t", "options": {"require": "fair"}},
                      {"verb": "shader", "packs": "p/*", "output": "{stem}.glsl", "options": {"lang": "glsl"}},
                      {"verb": "view", "pack": "p/a", "output": "a.html"},
                      {"verb": "compare", "a": "p", "b": "p", "output": "same.txt"}, preset="wall", verbs={"render": {"scale": 1}})
        jsonschema.validate(self.read_json("m.json"), schema)
        listed = schema["definitions"]["job"]["properties"]["verb"]["enum"]
        self.samples("a")
        self.write("m.json", '{"format": "tilepack-manifest", "version": 1, "jobs": [{"verb": "x", "output": "b"}]}')
        message = self.run_tilepack("batch", "m.json", code=3).stderr
        for verb in listed:
            self.assertIn(verb, message)


if __name__ == "__main__":
    unittest.main()
