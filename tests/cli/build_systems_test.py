"""tilepack under real Ninja, GNU make and CMake: a second build does nothing, one changed texel bakes one."""

import os
import re
import shutil
import subprocess
import time
import unittest

from batch_test import Batch as BatchCase
from command import SOURCE, TILEPACK

BUILD_RULES = os.path.join(SOURCE, "lib/cmake/tilepackBuild.cmake")
ODD = "a b#c$d.png"  # what depfiles of both can say


class BuildSystem(BatchCase):
    def need(self, program):
        if shutil.which(program) is None:
            self.skip(f"{program} is not here")

    def run_in(self, folder, *command):
        done = subprocess.run(command, cwd=self.path(folder), capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def later(self, name):
        """Newer than all that was made until now: times of files go in steps of a few milliseconds."""
        time.sleep(0.03)
        os.utime(self.path(name))

    def packs(self):
        return {name: os.stat(self.path("packs", name)).st_ino for name in self.contents("packs") if name.endswith("pack.json")}

    def remade(self, before):
        return sorted(os.path.basename(os.path.dirname(n)) for n, inode in self.packs().items() if before.get(n) != inode)

    def three(self):
        self.samples("a", "b", "c")
        self.jobs = [{"samples": "in/*.png", "output": "packs/{stem}"},
                     {"verb": "render", "packs": "packs/*", "options": {"scale": 0.5}, "output": "views/{stem}.png"}]
        self.manifest(*self.jobs)


class Emitted(BuildSystem):
    def follow(self, build, file, emit):
        """The life of a build whose rules are `file`; `build` runs it."""
        self.three()
        self.run_tilepack("batch", "m.json", "--emit", emit, "-o", file)
        build()
        self.assertEqual(len(self.packs()), 3)
        self.assertTrue(os.path.exists(self.path("views/a.png")))
        before = self.packs()
        self.assertRegex(build(), "no work|Nothing to be done|up to date")
        self.noise_png("in/b.png", 48, 48, seed=50)
        self.later("in/b.png")
        view = os.stat(self.path("views/a.png")).st_ino
        build()
        self.assertEqual(self.remade(before), ["b"])
        self.assertEqual(os.stat(self.path("views/a.png")).st_ino, view)
        before = self.packs()
        self.later("in/a.png")  # touched: asked again, and found current
        build()
        self.assertEqual(self.remade(before), [])
        self.assertRegex(build(), "no work|Nothing to be done|up to date")
        self.manifest({**self.jobs[0], "options": {"seed": 3}}, self.jobs[1])  # the rules make themselves again
        self.later("m.json")
        build()
        self.assertEqual(self.remade(before), ["a", "b", "c"])
        before = self.packs()
        self.noise_png("in/d.png", 48, 48, seed=51)
        self.later("in")
        build()
        self.assertEqual(self.remade(before), ["d"])

    def test_ninja(self):
        self.need("ninja")
        self.follow(lambda: self.run_in(".", "ninja"), "build.ninja", "ninja")

    def test_make(self):
        self.need("make")
        self.follow(lambda: self.run_in(".", "make"), "Makefile", "make")

    def test_names_that_are_hard_to_write(self):
        os.makedirs(self.path("in"))
        self.noise_png("in/" + ODD, 48, 48)
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"})
        for tool, emit, file in (("ninja", "ninja", "build.ninja"), ("make", "make", "Makefile")):
            self.need(tool)
            with self.subTest(tool):
                shutil.rmtree(self.path("packs"), ignore_errors=True)
                self.write(file, self.run_tilepack("batch", "m.json", "--emit", emit).stdout)
                self.run_in(".", tool)
                self.assertEqual(len(self.packs()), 1)
                self.assertRegex(self.run_in(".", tool), "no work|Nothing to be done|up to date")
        os.rename(self.path("m.json"), self.path("quote'.json"))
        self.assertIn("'quote'\\''.json'", self.run_tilepack("batch", "quote'.json", "--emit", "ninja").stdout)

    def test_nothing_is_made_by_asking_for_rules(self):
        self.three()
        self.assertIn("build packs/a/pack.json: tilepack in/a.png", self.run_tilepack("batch", "m.json", "--emit", "ninja").stdout)
        self.assertFalse(os.path.exists(self.path("packs")))
        self.run_tilepack("batch", "m.json", "--emit", "scons", code=1)


class Depfiles(BuildSystem):
    """A rule of one's own, with --depfile as it stands in the help."""

    def follow(self, arguments, target, inputs, tool):
        words = " ".join(f"'{word}'" for word in map(str, arguments))
        if tool == "ninja":
            self.write("build.ninja", f"rule t\n  command = {TILEPACK} {words.replace('$', '$$')} -q --depfile d && touch -c {target}\n"
                                      f"  depfile = d\n  deps = gcc\nbuild {target}: t\n")
        else:
            recipe = words.replace("$", "$$")
            self.write("Makefile", f"{target}:\n\t{TILEPACK} {recipe} -q --depfile d && touch -c {target}\n-include d\n")
        for name, data in self.contents().items():  # made long ago
            if data is not None and not name.startswith(".ninja"):
                os.utime(self.path(name), (1_000_000_000,) * 2)
        self.run_in(".", tool)
        self.assertRegex(self.run_in(".", tool), "no work|Nothing to be done|up to date")
        for name in inputs:
            self.later(name)
            self.assertNotRegex(self.run_in(".", tool), "no work|Nothing to be done|up to date", name)
            os.utime(self.path(name), (1_000_000_000,) * 2)

    def test_every_file_read_is_in_it(self):
        for tool in ("ninja", "make"):
            self.need(tool)
            self.noise_png(ODD, 48, 48)
            self.noise_png("h (1).png", 48, 48, channels=1)
            self.write_json("mine.json", {"purpose": "p", "cost": "c", "tile-size": 16, "effort": 0, "virtual-size": 8})
            self.write("wall.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
            self.write_json("colors.json", [{"nw": 0, "ne": 0, "sw": 0, "se": 0}])
            self.noise_png("t.png", 16, 16)
            with self.subTest(tool):
                self.follow(["bake", ODD, "-o", "p", "--map", "height=h (1).png", "--preset", "mine.json"], "p/pack.json",
                            [ODD, "h (1).png", "mine.json"], tool)
                self.follow(["render", "p", "-o", "v.png", "--camera", "0.3,0.3,2,0.3,0.3,0,0,1,0,60", "--size", "16x16", "--mesh", "wall.obj"],
                            "v.png", ["wall.obj", "p/pack.json", "p/color_0.png"], tool)
                self.follow(["pack", "t.png", "-o", "q", "--colors", "colors.json", "--virtual-size", 4, "--tolerance", 1], "q/pack.json",
                            ["t.png", "colors.json"], tool)
            for name in ("p", "q", "v.png", ".ninja_deps", ".ninja_log"):
                (shutil.rmtree if os.path.isdir(self.path(name)) else os.remove)(self.path(name)) if os.path.exists(self.path(name)) else None

    def test_of_a_batch(self):
        self.three()
        self.run_tilepack("batch", "m.json", "-q", "--depfile", "d", "--stamp", "stamp")
        with open(self.path("d"), encoding="utf-8") as stream:
            text = stream.read()
        self.assertTrue(text.startswith("stamp: "))
        for name in ("in/a.png", "in/c.png", "m.json", "in"):
            self.assertRegex(text, rf"(?m)^  {re.escape(name)}( \\)?$")


class CMake(BuildSystem):
    def follow(self, generator):
        self.three()
        self.write_json("preset.json", {"purpose": "p", "cost": "c", "tile-size": 16, "effort": 0, "virtual-size": 8})
        self.write("CMakeLists.txt", f"""cmake_minimum_required(VERSION 3.25)
project(p NONE)
include("{BUILD_RULES}")
tilepack_add_pack(one SAMPLE in/a.png OUTPUT one.pack PRESET preset.json OPTIONS --seed 4)
tilepack_add_manifest(many MANIFEST m.json OPTIONS --jobs 2)
""")
        build = lambda: self.run_in(".", "cmake", "--build", "build")
        self.run_in(".", "cmake", "-G", generator, "-B", "build", "-S", ".", f"-DTILEPACK_PROGRAM={TILEPACK}")
        build()
        self.assertEqual(len(self.packs()), 3)
        one = lambda: os.stat(self.path("build/one.pack/pack.json")).st_ino
        first, before = one(), self.packs()
        self.assertNotRegex(build(), "Tile pack")
        self.noise_png("in/b.png", 48, 48, seed=60)
        self.later("in/b.png")
        build()
        self.assertEqual((self.remade(before), one()), (["b"], first))
        before = self.packs()
        self.write_json("preset.json", {"purpose": "p", "cost": "c", "tile-size": 16, "effort": 0, "virtual-size": 4})
        self.later("preset.json")
        build()
        self.assertEqual(self.remade(before), [])
        self.assertNotEqual(one(), first)

    def test_with_ninja(self):
        self.need("ninja")
        self.follow("Ninja")

    def test_with_make(self):
        self.need("make")
        self.follow("Unix Makefiles")


del BatchCase

if __name__ == "__main__":
    unittest.main()
