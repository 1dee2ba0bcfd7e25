"""Every verb and every way it can fail: exit code and message. cli/FAILURES.md is this table as it was run.

    TILEPACK=… TILEPACK_SOURCE=… python3 failures_test.py --write     makes the page anew
"""

import os
import re
import subprocess
import sys
import unittest

from command import SOURCE, TILEPACK, CommandCase

PAGE = os.path.join(SOURCE, "cli/FAILURES.md")
HEAD = """# Failures

What each verb says and how it ends when something is wrong. Made by `tests/cli/failures_test.py`, which runs every line and holds this page
against what comes out. Nothing is ever half written: after each of these, outputs are what they were before.

Exit codes: 0 ok, 1 usage, 2 cannot read, 3 invalid content, 4 cannot write, 5 a check failed or images differ, 6 internal error. Ctrl-C and
other signals end a verb by that signal, after it has cleaned up. Of `batch`, the code is the highest of its entries.

| command | what is wrong | code | message |
|---|---|---|---|
"""
NO_OPTION, NOTHING, RANGE, MISSING, FOREIGN, SHORT, BROKEN, TAKEN, NO_FOLDER, OWN, IMAGE, FULL, CHECK, MEMORY = (
    "an option that is none", "nothing to work from", "a value out of range", "an input that is not there", "an input of another kind",
    "an input that was cut short", "an input that breaks a rule", "an output that would replace files of others",
    "a folder that is not there", "an output that is an input", "a text in place of an image", "a full disk where data goes", "a check that fails", "a job larger than the memory given")
SMALL = ["--tile-size", "16", "--effort", "0", "--virtual-size", "8"]
BAKE = ["bake", "good.png", "-o", "new", *SMALL]
TABLE = [
    (["bake", "--no-such"], NO_OPTION, 1), (["bake"], NOTHING, 1), ([*BAKE, "--seed", "-1"], RANGE, 1),
    ([*BAKE, "--preset", "wal"], "a preset that is none", 1), ([*BAKE, "--guard", "9"], "options that do not go together", 1),
    (["bake", "none.png", "-o", "new"], MISSING, 2), (["bake", "text.txt", "-o", "new"], FOREIGN, 2),
    (["bake", "short.png", "-o", "new"], SHORT, 2), (["bake", "good.png", "-o", "new", "--tile-size", "64"], "a sample too small", 3),
    ([*BAKE, "--map", "height=other.png"], "maps of two sizes", 3), ([*BAKE, "--preset", "broken.json"], BROKEN, 3),
    (["bake", "good.png", "-o", "others", *SMALL], TAKEN, 4), (["bake", "good.png", "-o", "text.txt/p", *SMALL], NO_FOLDER, 4),
    ([*BAKE, "--depfile", "text.txt/d"], NO_FOLDER, 4), ([*BAKE, "--depfile", "good.png"], OWN, 1), (["bake", "good.png", "-o", "good.png"], OWN, 1),
    ([*BAKE, "--depfile", "photo.jpg"], IMAGE, 1), (["bake", "good.png"], "nowhere to go", 1), (["bake", "p", "-o", "new"], "a pack in place of a sample", 3),
    (["pack", "--no-such"], NO_OPTION, 1), (["pack"], NOTHING, 1), (["pack", "tile.png", "-o", "new", "--colors", "one.json", "--tolerance", "2"], RANGE, 1),
    (["pack", "none.png", "-o", "new", "--colors", "one.json"], MISSING, 2), (["pack", "text.txt", "-o", "new", "--colors", "one.json"], FOREIGN, 2),
    (["pack", "tile.png", "-o", "new", "--colors", "none.json"], MISSING, 2), (["pack", "tile.png", "-o", "new", "--colors", "broken.json"], BROKEN, 3),
    (["pack", "tile.png", "-o", "others", "--colors", "one.json"], TAKEN, 4),
    (["pack", "tile.png", "noise.png", "-o", "new", "--colors", "two.json", "--layout", "array", "--mapping", "index"], CHECK, 5),
    (["inspect", "--no-such"], NO_OPTION, 1), (["inspect"], NOTHING, 1), (["inspect", "none"], MISSING, 2), (["inspect", "good.png"], FOREIGN, 2),
    (["inspect", "bad"], BROKEN, 3), (["inspect", "p", "--picture", "text.txt/a.png"], NO_FOLDER, 4), (["inspect", "p", "--picture", "p/color_0.png"], OWN, 1),
    (["inspect", "p", ">"], FULL, 4),
    (["validate", "--no-such"], NO_OPTION, 1), (["validate"], NOTHING, 1), (["validate", "p", "--against-reference", "--lookups", "1"], RANGE, 1),
    (["validate", "none"], MISSING, 2), (["validate", "bad"], CHECK, 5), (["validate", "cut"], CHECK, 5), (["validate", "p", ">"], FULL, 4),
    (["render", "--no-such"], NO_OPTION, 1), (["render"], NOTHING, 1), (["render", "p", "-o", "v.png", "--level", "31"], RANGE, 1),
    (["render", "p", "-o", "v.gif"], "an ending that is none", 1), (["render", "none", "-o", "v.png"], MISSING, 2),
    (["render", "p", "-o", "v.png", "--camera", "0,2,0,0,0,-6,0,1,0,60", "--mesh", "text.txt"], FOREIGN, 3), (["render", "bad", "-o", "v.png"], BROKEN, 3),
    (["render", "cut", "-o", "v.png"], SHORT, 2), (["render", "p", "-o", "text.txt/v.png"], NO_FOLDER, 4), (["render", "p", "-o", "p/color_0.png"], OWN, 1),
    (["compose", "--no-such"], NO_OPTION, 1), (["compose"], NOTHING, 1), (["compose", "s.json", "-o", "v.png", "--frames", "2..1"], RANGE, 1),
    (["compose", "none.json", "-o", "v.png"], MISSING, 2), (["compose", "text.txt", "-o", "v.png"], FOREIGN, 3), (["compose", "broken.json", "-o", "v.png"], BROKEN, 3),
    (["compose", "lost.json", "-o", "v.png"], "a picture of a node that is not there", 2), (["compose", "s.json", "-o", "text.txt/v.png"], NO_FOLDER, 4),
    (["compose", "s.json", "-o", "tile.png"], OWN, 1), (["compose", "s.json", "-o", "v.png", ">"], FULL, 4),
    (["compare", "--no-such"], NO_OPTION, 1), (["compare", "good.png"], NOTHING, 1), (["compare", "good.png", "none.png"], MISSING, 2),
    (["compare", "good.png", "text.txt"], FOREIGN, 2), (["compare", "good.png", "short.png"], SHORT, 2),
    (["compare", "good.png", "good2.png", "--picture", "text.txt/d.png"], NO_FOLDER, 4), (["compare", "good.png", "good2.png"], CHECK, 5),
    (["compare", "good.png", "good.png", ">"], FULL, 4),
    (["layouts", "--no-such"], NO_OPTION, 1), (["layouts", "--tiles", "0"], RANGE, 1), (["layouts", "--tiles", "13", "--sample", "none.png"], MISSING, 2),
    (["layouts", "--tiles", "13", "--sample", "text.txt"], FOREIGN, 2), (["layouts", ">"], FULL, 4),
    (["shader", "--no-such"], NO_OPTION, 1), (["shader"], NOTHING, 1), (["shader", "none", "--lang", "c"], MISSING, 2),
    (["shader", "bad", "--lang", "c"], BROKEN, 3), (["shader", "p"], "an option that is missing", 1), (["shader", "p", "--lang", "GLSL"], RANGE, 1),
    (["shader", "p", "--lang", "c", "-o", "photo.jpg"], IMAGE, 1), (["shader", "p", "--lang", "c", "-o", "cut/pack.json"], "an output that is part of a pack", 1),
    (["view", "--no-such"], NO_OPTION, 1), (["view"], NOTHING, 1), (["view", "none", "-o", "v.html"], MISSING, 2), (["view", "bad", "-o", "v.html"], BROKEN, 3),
    (["bench", "--no-such"], NO_OPTION, 1), (["bench"], NOTHING, 1), (["bench", "none"], MISSING, 2), (["bench", "bad"], BROKEN, 3),
    (["batch", "--no-such"], NO_OPTION, 1), (["batch"], NOTHING, 1), (["batch", "m.json", "--shard", "3/2"], RANGE, 1),
    (["batch", "m.json", "--only", "none"], "an entry that is none", 1), (["batch", "none.json"], MISSING, 2), (["batch", "good.png"], FOREIGN, 3),
    (["batch", "broken.json"], BROKEN, 3), (["batch", "m.json", "--only", "gone", "-q"], MISSING, 2), (["batch", "m.json", "--only", "bad", "-q"], BROKEN, 3),
    (["batch", "m.json", "--only", "taken", "-q"], TAKEN, 4), (["batch", "m.json", "--only", "differ", "-q"], CHECK, 5),
    (["batch", "m.json", "--only", "good", "-q", "--memory", "1M"], MEMORY, 1), (["batch", "m.json", "--emit", "ninja", "-o", "text.txt/build.ninja"], NO_FOLDER, 4),
    (["batch", "m.json", "--stamp", "m.json"], OWN, 1), (["batch", "m.json", "--depfile", "good.png"], OWN, 1), (["batch", "m.json", "--emit", "make", "-o", "cut/pack.json"], "an output that is part of a pack", 1),
    (["batch", "m.json", "--only", "lang", "-q"], "an option that is missing", 3),
    (["bakee"], "a verb that is none", 1), ([], "no verb", 1), (["help", "--completion", "csh"], "a shell that is none", 1),
]


class Failures(CommandCase):
    def set_up_files(self):
        self.noise_png("good.png", 48, 48)
        self.noise_png("good2.png", 48, 48, seed=2)
        self.noise_png("other.png", 32, 48)
        self.noise_png("noise.png", 16, 16, seed=9)
        self.noise_png("tile.png", 16, 16)
        self.write("text.txt", "no image")
        with open(self.path("good.png"), "rb") as stream:
            self.write("short.png", stream.read()[:-400])
        self.write("broken.json", '{"purpose": 3}')
        self.write_json("one.json", [{"nw": 0, "ne": 0, "sw": 0, "se": 0}])
        self.write_json("two.json", [{"nw": 0, "ne": 0, "sw": 0, "se": 0}] * 2)
        for name, picture in (("s.json", "tile.png"), ("lost.json", "none.png")):
            self.write_json(name, {"format": "tilepack-scene", "version": 1, "size": [16, 16], "output": "look", "nodes": {
                "cells": {"block": "tile-map", "cells": [1, 1]}, "look": {"block": "reference-texture", "patterns": [picture], "place": "cells"}}})
        os.mkdir(self.path("others"))
        self.write("others/thesis.txt", "years of work")
        for name in ("p", "cut"):
            self.run_tilepack("bake", "good.png", "-o", name, *SMALL)
        with open(self.path("cut/color_0.png"), "r+b") as stream:
            stream.truncate(200)
        os.mkdir(self.path("bad"))
        self.write("bad/pack.json", '{"format": "tilepack", "version": 7}')
        self.write_json("m.json", {"format": "tilepack-manifest", "version": 1, "jobs": [
            {"name": "good", "sample": "good.png", "output": "packs/good", "options": {"tile-size": 16, "effort": 0}},
            {"name": "gone", "sample": "none.png", "output": "packs/gone"},
            {"name": "bad", "sample": "good.png", "output": "packs/bad", "options": {"seed": "x"}},
            {"name": "taken", "sample": "good.png", "output": "others", "options": {"tile-size": 16, "effort": 0}},
            {"name": "lang", "verb": "shader", "pack": "p", "output": "p.h"},
            {"name": "differ", "verb": "compare", "a": "good.png", "b": "good2.png", "output": "differ.txt"}]})

    def rows(self):
        self.set_up_files()
        before = self.contents()
        rows = []
        for words, wrong, code in TABLE:
            full = words[-1:] == [">"]
            with self.subTest(words), open("/dev/full" if full else os.devnull, "w", encoding="utf-8") as out:
                done = subprocess.run([TILEPACK, *(words[:-1] if full else words)], cwd=self.folder, stdout=out, stderr=subprocess.PIPE, text=True)
                message = done.stderr.strip()
                self.assertEqual(done.returncode, code, f"{words}: {message}")
                self.assertEqual(len(message.splitlines()), 1, message)
                after = {name: data for name, data in self.contents().items() if name not in ("packs", ".m.json.index", "differ.txt")}
                changed = sorted(name for name in {*after, *before} if after.get(name) != before.get(name) or (name in after) != (name in before))
                self.assertEqual(changed, [], "left behind or changed")
            line = "tilepack " + " ".join(words).replace(">", "> /dev/full")
            message = re.sub(r"^tilepack( [a-z]+)?: error: ", "", message).replace("|", "\\|")
            rows.append(f"| `{line}` | {wrong} | {code} | {message} |\n".replace("``", ""))
        return rows

    def test_the_page_says_what_happens(self):
        page = HEAD + "".join(self.rows())
        if WRITE:
            with open(PAGE, "w", encoding="utf-8") as stream:
                stream.write(page)
        with open(PAGE, encoding="utf-8") as stream:
            self.assertEqual(stream.read(), page, "made anew by: python3 tests/cli/failures_test.py --write")

    def test_every_verb_is_in_it(self):
        listing = self.run_tilepack("help").stdout
        verbs = re.findall(r"^  ([a-z]+) ", listing.split("Verbs:")[1].split("\n\n")[0], re.MULTILINE)
        for verb in verbs:
            if verb != "help":
                codes = {code for words, _, code in TABLE if words[:1] == [verb]}
                self.assertLessEqual({1, 2}, codes, verb)


WRITE = "--write" in sys.argv

if __name__ == "__main__":
    sys.argv = [word for word in sys.argv if word != "--write"]
    unittest.main()
