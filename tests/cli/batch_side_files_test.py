"""What a batch writes, its entries and the files beside them, replaces nothing that is worked from, whatever it is called."""

import os
import unittest

from command import CommandCase

USAGE, CONTENT = 1, 3
SMALL = {"tile-size": 16, "effort": 0, "virtual-size": 8}
PLACES = (("--stamp",), ("--depfile",), ("--emit", "ninja", "-o"), ("--emit", "make", "-o"))


class ManifestCase(CommandCase):
    def setUp(self):
        super().setUp()
        self.noise_png("a.png", 48, 48)
        self.write_json("wall.json", {"seed": 3})
        self.manifest({"sample": "a.png", "output": "packs/a", "options": SMALL, "preset": "wall.json"},
                      {"verb": "shader", "pack": "packs/a", "options": {"lang": "c"}, "output": "a.h"},
                      {"verb": "inspect", "pack": "packs/a", "options": {"picture": "a.svg"}, "output": "a.txt"})

    def manifest(self, *jobs, name="m.json"):
        return self.write_json(name, {"format": "tilepack-manifest", "version": 1, "jobs": list(jobs)})


class SideFiles(ManifestCase):
    def refuses(self, file, saying="would replace a file that is worked from"):
        for place in PLACES:
            with self.subTest(file, place=place):
                option = "--output" if place[-1] == "-o" else place[-1]
                self.refused("batch", "m.json", *place, file, code=USAGE, saying=(f"{option}: '{file}' ", saying))

    def test_files_beside_entries_replace_nothing(self):
        for built in (False, True):
            with self.subTest(built=built):
                for file in ("m.json", "wall.json", "a.png", "packs/a/pack.json", "a.h", "a.svg", "a.txt", ".m.json.index", "packs/a/.pack.json.build"):
                    self.refuses(file)
                self.refuses("packs/a/notes", "lies in the pack 'packs/a'; choose a path outside of it")
                self.refuses("photo.PNG", "ends as an image does")
                if not built:
                    self.run_tilepack("batch", "m.json", "-q")
        self.refuses("packs/a/color_0.png")

    def test_other_spellings_are_the_same_file(self):
        self.run_tilepack("batch", "m.json", "-q")
        os.symlink("m.json", self.path("link"))
        os.link(self.path("a.png"), self.path("hard"))
        os.symlink("packs", self.path("other"))
        for file in ("./m.json", "packs/../m.json", self.path("m.json"), "link", "hard", "other/a/pack.json"):
            self.refuses(file)
        self.refuses("other/a/new", "lies in the pack 'packs/a'")

    def test_two_of_them_are_not_one(self):
        self.refused("batch", "m.json", "--stamp", "s", "--depfile", "./s", code=USAGE, saying="is what --depfile writes too")

    def test_files_of_packs_that_no_entry_knows(self):
        self.run_tilepack("bake", "a.png", "-o", "old", "--tile-size", 16, "--effort", 0)
        self.refuses("old/pack.json", "would replace a file of the pack 'old'")
        for words in (("render", "old", "-o", "new/color_0.png"), ("inspect", "old", "--picture", "new/color_0.png"),
                      ("compare", "a.png", "a.png", "--picture", "new/color_0.png"), ("render", "old", "-o", "v.png", "--depfile", "new/pack.json")):
            with self.subTest(words):
                self.run_tilepack("bake", "a.png", "-o", "new", "--tile-size", 16, "--effort", 0)
                self.refused(*words, code=USAGE, saying="would replace a file of the pack 'new'")

    def test_whoever_watches_is_told_at_once(self):
        self.refused("batch", "m.json", "--watch", "--stamp", "m.json", code=USAGE, saying="would replace a file that is worked from", timeout=20)

    def test_good_ones_are_written(self):
        self.run_tilepack("batch", "m.json", "--stamp", "out.stamp", "--depfile", "out.d", "-q")
        self.run_tilepack("batch", "m.json", "--stamp", "out.stamp", "--depfile", "out.d", "-q")
        self.run_tilepack("batch", "m.json", "--emit", "ninja", "-o", "build.ninja", "-q")
        self.run_tilepack("batch", "m.json", "--emit", "ninja", "-o", "build.ninja", "-q")
        self.assertIn("rule tilepack", self.contents()["build.ninja"].decode())


class Entries(ManifestCase):
    """Outputs of entries that are inputs, of other entries or their own."""

    def refuses_entries(self, saying, *jobs, code=CONTENT):
        self.manifest(*jobs)
        for words in ((), ("--dry-run",)):
            with self.subTest(jobs, words=words):
                self.refused("batch", "m.json", *words, code=code, saying=saying)

    def test_what_was_there_before_is_kept(self):
        self.run_tilepack("bake", "a.png", "-o", "old", "--tile-size", 16, "--effort", 0)
        os.symlink(".", self.path("link"))
        check = {"verb": "validate", "pack": "old"}
        bake = {"sample": "a.png", "output": "packs/b", "options": SMALL}
        self.refuses_entries(("m.json:1: jobs[0].output: ", "would replace a file that is worked from"), {**check, "output": "m.json"})
        self.refuses_entries(("jobs[1].output: ", "wall.json' would replace a file"), {**bake, "preset": "wall.json"}, {**check, "output": "wall.json"})
        self.refuses_entries("would replace a file of the pack 'old'", {**check, "output": "link/old/pack.json"})
        os.link(self.path("a.png"), self.path("sample"))
        self.refuses_entries("would replace a file that this entry works from", {"verb": "compare", "a": "sample", "b": "sample", "output": "link/sample"})
        self.run_tilepack("bake", "a.png", "-o", "older", "--tile-size", 16, "--effort", 0)
        self.refuses_entries("would replace a file of the pack 'older'", {**check, "output": "older/pack.json"})
        self.refuses_entries("ends as an image does", {**check, "output": "a.png"})
        for output in ("a.png", "link/a.png", self.path("a.png")):
            self.refuses_entries(("was made by no batch, and the entry on line 1 works from it", "remove it if it is"),
                                 bake, {"verb": "render", "pack": "old", "output": output})
        self.refuses_entries("is what the entry on line 1 makes too", {**check, "output": "link/x.txt"}, {**check, "output": "x.txt"})
        self.refuses_entries("is what the entry on line 1 makes too", {**bake, "options": {**SMALL, "report": "page.html"}},
                             {"verb": "view", "pack": "old", "output": "page.html"})
        self.refuses_entries("reads what it writes", {"sample": "x/y.png", "output": "x"})

    def test_what_a_batch_made_is_made_again(self):
        self.run_tilepack("bake", "a.png", "-o", "old", "--tile-size", 16, "--effort", 0)
        self.manifest({"verb": "render", "pack": "old", "output": "plane.png", "options": {"rect": "0,0,48,48"}},
                      {"sample": "plane.png", "output": "packs/b", "options": SMALL})
        self.run_tilepack("batch", "m.json", "-q")
        self.run_tilepack("batch", "m.json", "-q", "--all")
        self.manifest({"verb": "render", "pack": "old", "output": "plane.png", "options": {"rect": "9,0,48,48"}},
                      {"sample": "plane.png", "output": "packs/b", "options": SMALL})
        self.run_tilepack("batch", "m.json", "-q")

    def test_packs_that_were_there_may_be_made(self):
        self.run_tilepack("bake", "a.png", "-o", "old", "--tile-size", 16, "--effort", 0)
        self.manifest({"sample": "a.png", "output": "old", "options": {**SMALL, "seed": 5}}, {"verb": "render", "pack": "old", "output": "v.png"})
        self.run_tilepack("batch", "m.json", "-q")


if __name__ == "__main__":
    unittest.main()
