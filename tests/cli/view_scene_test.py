"""`tilepack view SCENE`: every block is evaluated in the browser as `tilepack compose` evaluates it."""

import base64
import json
import math
import unittest

from browser_page import CHROMIUM, found_in_page
from command import CommandCase
from png_image import read_png, write_png

SIDE = 96
TIME = 37.5
ZONE = 768  # texels of a zone: the scene has 4 x 4, each of which shows another block
MAPS = [{"name": "color", "role": "color", "channels": 4}, {"name": "normal", "role": "normal", "channels": 3},
        {"name": "height", "role": "height", "channels": 1}, {"name": "rise", "role": "height", "channels": 1}]
BODY = """
  const [unit] = pack.tile;
  for (const [x, y, zoom] of PLACES) for (const filter of ['nearest', 'texture'])
    picture(`${x},${y},${zoom},${filter}`, { x: x / unit, y: y / unit, zoom, filter, lit: 0, fly: 0, tint: 'none', time: TIME });
  for (const map of choices.map) for (const [x, y] of MAP_PLACES) for (const filter of ['nearest', 'texture'])
    picture(`${map},${x},${y},1,${filter}`, { x: x / unit, y: y / unit, zoom: 1, filter, map });
  picture('flight', { map: choices.map[0], fly: 1, lit: 1, height: 4, pitch: 30 });
  out.sample = pack.scene.moves;
"""


def noisy(x, y, seed):
    return (x * 7919 + y * 104729 + seed * 31337 + (x * y + seed) * 613) % 97 / 97


class ViewSceneTest(CommandCase):
    def picture(self, name, base, seed, channels=3, side=16):
        """Smooth noise round a color; with alpha, a disc."""
        rows = []
        for y in range(side):
            row = []
            for x in range(side):
                shade = 30 * math.sin(x * 0.7 + seed) + 25 * math.cos(y * 0.9 + seed * 2) + 20 * noisy(x, y, seed)
                row += [min(max(int(c + shade), 0), 255) for c in base]
                if channels == 4:
                    row.append(255 if (x - 7.5) ** 2 + (y - 7.5) ** 2 < 40 else 0)
            rows.append(row)
        write_png(self.path(name), rows, channels)
        return name

    def scene(self):
        """A scene with all blocks; pictures have the first map alone, one pack all, the other no `height`. Grids of 48 cells in 192 units, and areas of 12 and 4: not all powers of two."""
        stones = [self.picture(f"stone_{i}.png", (90, 90, 100 + 30 * i), i) for i in range(4)]
        sand = [self.picture(f"sand_{i}.png", (190, 160, 110), 10 + i) for i in range(4)]
        leaves = [self.picture(f"leaf_{i}.png", (60 + 60 * i, 140, 40), 20 + i, 4) for i in range(3)]
        shore = [self.picture(f"shore_{i}.png", (120, 60 + 8 * i, 160), 30 + i) for i in range(16)]
        rim = [self.picture(f"rim_{i}.png", (220, 40 + 9 * i, 80), 50 + i, 4) for i in range(16)]
        for name, base in (("sample", (120, 130, 70)), ("normal", (128, 128, 220)), ("height", (120,)), ("rise", (140,))):
            self.picture(name + ".png", base, len(name), len(base), side=96)
        bake = ["--map", "normal=normal.png", "--map", "rise:height=rise.png", "--tile-size", "16", "--effort", "0", "-q"]
        self.run_tilepack("bake", "sample.png", "-o", "a.pack", "--map", "height=height.png", *bake)
        self.run_tilepack("bake", "sample.png", "-o", "b.pack", *bake, "--mapping", "index", "--virtual-size", "64x64", "--layout", "array", "--border", "1")
        zones = [[4 * y + x for x in range(4)] for y in range(4)]
        areas = [[(3 * x + 5 * y + x * y) % 3 for x in range(12)] for y in range(12)]
        two = [[(x * x + y) % 2 for x in range(12)] for y in range(12)]
        random = {"block": "random-map", "grid": "fine"}
        nodes = {
            "fine": {"block": "tile-map", "cells": [192, 192]}, "coarse": {"block": "tile-map", "cells": [48, 48]},
            "zones": {"block": "areas-map", "map": zones}, "areas": {"block": "areas-map", "map": areas}, "two": {"block": "areas-map", "map": two},
            "any": {"block": "virtual-indirection-map", "grid": "fine", "count": 4},
            "chained": {"block": "virtual-indirection-map", "grid": "fine", "count": 4, "hash": "chain", "seed": 7},
            "told": {"block": "indirection-map", "grid": "coarse", "map": [[(x + 2 * y) % 4 for x in range(48)] for y in range(48)]},
            "likely": {"block": "probability-map", "grid": "fine", "probabilities": [0.5, 0.2, 0.2, 0.1], "blank": True},
            "mixed": {"block": "dithered-areas-map", "areas": "areas", "grid": "fine"},
            "of-material": {"block": "materials-map", "grid": "fine", "material": "mixed", "blank": True,
                            "materials": [[0.1, 0.1, 0.1, 0.7], [0.3, 0.3, 0.3, 0.1], [0, 1, 0, 0]]},
            "x": random, "y": random, "turn": random, "size": {**random, "range": [0.5, 1.3], "hash": "chain"},
            "over": {"block": "tile-transform", "grid": "fine", "x": "x", "y": "y", "scale": "size", "rotate": "turn", "fit": "overflow"},
            "inside": {"block": "tile-transform", "grid": "fine", "x": "x", "y": "y", "scale": 0.8, "rotate": "turn"},
            "walk": {"block": "explicit-positioning", "grid": "coarse", "sprites": [
                {"path": [[2, 38], [6, 40], [8, 45], [3, 44]], "period": 60, "scale": 0.7, "follows": True}, {"at": [4.9, 41.1], "pattern": 1, "scale": 0.6, "rotate": 0.1},
                {"at": [5.1, 41.3], "pattern": 2, "scale": 0.5}]},
            "stones": {"block": "reference-texture", "patterns": stones, "pattern": "any", "place": "fine"},
            "chain-stones": {"block": "reference-texture", "patterns": stones, "pattern": "chained", "place": "fine"},
            "told-sand": {"block": "reference-texture", "patterns": sand, "pattern": "told", "place": "coarse", "seamless": False},
            "few": {"block": "reference-texture", "patterns": sand, "pattern": "likely", "place": "fine"},
            "ground": {"block": "color", "value": [0.2, 0.1, 0.3]},
            "strewn": {"block": "reference-texture", "patterns": leaves, "pattern": "of-material", "place": "over"},
            "kept": {"block": "reference-texture", "patterns": leaves, "pattern": 1, "place": "inside"},
            "sprites": {"block": "reference-texture", "patterns": leaves, "place": "walk"},
            "some": {"block": "layers", "textures": ["ground", "few"]}, "leafy": {"block": "layers", "textures": ["stones", "strewn"]},
            "potted": {"block": "layers", "textures": ["ground", "kept"]}, "walked": {"block": "layers", "textures": ["told-sand", "sprites"]},
            "shape": {"block": "pixel-map", "pixels": [384, 384], "outlines": [{"material": 1, "points": [[192, 10], [370, 192], [192, 370], [10, 192]]}]},
            "sharp": {"block": "select", "index": "shape", "textures": ["stones", "told-sand"]},
            "first-pack": {"block": "pack", "file": "a.pack"}, "second-pack": {"block": "pack", "file": "b.pack", "scale": 2},
            "shore": {"block": "transition-tiles", "grid": "coarse", "material": "two", "textures": ["stones", "told-sand"], "patterns": shore},
            "rim": {"block": "border-tiles", "grid": "coarse", "material": "two", "patterns": rim, "inside": "told-sand", "below": "first-pack"},
            "high": {"block": "height-blend", "areas": "areas", "textures": ["stones", "first-pack", "told-sand"], "width": 40, "height": "height"},
            "risen": {"block": "height-blend", "areas": "areas", "textures": ["second-pack", "first-pack", "told-sand"], "width": 40, "height": "rise"},
            "which": {"block": "areas-map", "map": [[y // 8] for y in range(12)]}, "blend": {"block": "select", "index": "which", "textures": ["high", "risen"]},
            "now": {"block": "time"}, "hundred": {"block": "arithmetic", "operation": "multiply", "a": "now", "b": 3},
            "moved": {"block": "moved", "texture": "first-pack", "x": "hundred", "y": 5},
            "rest": {"block": "number-map", "map": [[2, 9, 5], [7, 3, 8], [4, 6, 1]], "smooth": True, "scale": 3},
            "phase": {**random, "range": [0, 50]},
            "frame": {"block": "animation-map", "grid": "fine", "frames": 4, "phase": "phase", "rest": "rest", "rest-before": 3, "changed-at": 30},
            "blinks": {"block": "reference-texture", "patterns": stones, "pattern": "frame", "place": "fine"},
            "away": {"block": "distance", "x": 1152, "y": 2700}, "ring": {"block": "arithmetic", "operation": "divide", "a": "away", "b": 60},
            "rings": {"block": "floor", "number": "ring", "count": 4, "wrap": True},
            "ringed": {"block": "reference-texture", "patterns": stones, "pattern": "rings", "place": "fine"},
            "wave": {"block": "arithmetic", "operation": "sine", "a": "ring", "b": 4}, "wavy": {"block": "floor", "number": "wave", "count": 4},
            "line": {"block": "animation-sequence", "index": "wavy", "timeline": [2, 0, 3, 1, 2]},
            "waved": {"block": "reference-texture", "patterns": sand, "pattern": "line", "place": "fine"},
            "look": {"block": "select", "index": "zones", "textures": [
                "stones", "chain-stones", "told-sand", "some", "leafy", "potted", "sharp", "first-pack", "second-pack", "shore", "rim", "blend", "walked", "ringed",
                "blinks", "waved"]},
            "shown": {"block": "layers", "textures": ["look", "moved-part"]},
            "corner": {"block": "pixel-map", "pixels": [4, 4], "outlines": [{"material": 1, "points": [[0, 0], [0.9, 0], [0.9, 0.9], [0, 0.9]]}]},
            "moved-part": {"block": "select", "index": "corner", "textures": ["nothing", "moved"]},
            "nothing": {"block": "color", "value": [0, 0, 0, 0]},
        }
        self.write_json("scene.json", {"format": "tilepack-scene", "version": 1, "size": [4 * ZONE, 4 * ZONE], "maps": MAPS, "nodes": nodes, "output": "shown"})

    def differences(self, picture, window, name="color"):
        """The largest difference of each pixel of a map from what compose draws."""
        x, y, zoom, kind = window
        left, top, side = round(x - SIDE / 2 / zoom), round(y - SIDE / 2 / zoom), round(SIDE / zoom)
        self.run_tilepack("compose", "scene.json", "-o", "window.png", f"--rect={left},{top},{side},{side}", "--scale", zoom, "--time", TIME, "-q", "--filter",
                          "nearest" if kind == "nearest" else "trilinear", "--map", name, "--encoding", "srgb")
        rows, channels, _ = read_png(self.path("window.png"))
        pixels = base64.b64decode(picture)
        return [max(abs(pixels[4 * (SIDE * j + i) + c] - rows[j][channels * i + (c if channels > 2 else 0)]) for c in range(3))
                for j in range(SIDE) for i in range(SIDE)]

    @unittest.skipUnless(CHROMIUM, "not run: no chromium")
    def test_a_browser_reads_far_levels_as_compose_does(self):
        self.picture("sample.png", (120, 130, 70), 3, side=96)
        pictures = {}
        for mips in (["--full-mips"], []):
            # Tiles of 20 texels have three levels; a pixel of 8 texels asks for the fourth.
            self.run_tilepack("bake", "sample.png", "-o", "far.pack", "--tile-size", "20", "--effort", "0", "-q", *mips)
            self.write_json("scene.json", {"format": "tilepack-scene", "version": 1, "size": [2560, 2560], "output": "far",
                                           "nodes": {"far": {"block": "pack", "file": "far.pack"}}})
            self.run_tilepack("view", "scene.json", "-o", "page.html")
            picture = found_in_page(self, "page.html", SIDE, "  picture('far', { x: 1280 / pack.tile[0], y: 1280 / pack.tile[1], "
                                    "zoom: 1 / 8, filter: 'texture', lit: 0, fly: 0, tint: 'none' });\n")["pictures"]["far"]
            differences = self.differences(picture, (1280, 1280, 1 / 8, "texture"))
            self.assertLessEqual(max(differences), 3)
            pictures[str(mips)] = picture
        self.assertEqual(len(set(pictures.values())), 2)

    @unittest.skipUnless(CHROMIUM, "not run: no chromium")
    def test_a_browser_evaluates_what_compose_draws(self):
        self.scene()
        places = [(ZONE * (i % 4) + 384, ZONE * (i // 4) + 384, 1) for i in range(16)]
        places += [(2816, 1920, 1), (2560, 2176, 1)]  # where a blend has a border of materials
        places += [(230, 2650, 0.5), (300, 200, 1), (0, 0, 0.5), (1536, 1536, 0.25), (1536, 1536, 1 / 32), (1536, 1536, 1 / 128)]
        map_places = [(x, y) for x, y, zoom in places if zoom == 1]
        self.run_tilepack("view", "scene.json", "-o", "page.html", "--time", TIME)
        found = found_in_page(self, "page.html", SIDE, BODY.replace("MAP_PLACES", json.dumps(map_places)).replace("PLACES", json.dumps(places)).replace("TIME", str(TIME)))
        for x, y, zoom in places:
            for kind in ("nearest", "texture"):
                with self.subTest(f"{x},{y} at {zoom}, {kind}"):
                    off = sorted(self.differences(found["pictures"][f"{x},{y},{zoom:g},{kind}"], (x, y, zoom, kind)))
                    if kind == "nearest" and zoom < 0.25:  # places on the very borders of cells, which the last bit of a float decides
                        self.assertLess(sum(d > 2 for d in off), 0.05 * len(off))
                    elif kind == "nearest":  # a texel beside the one that holds a place counts, where turned patterns meet in the last bits
                        self.assertLess(sum(d > 2 for d in off), 0.01 * len(off))
                    elif zoom >= 1 / 8:
                        self.assertLessEqual(off[int(0.999 * len(off))], 4)
                    else:  # means over many cells, and the overview
                        self.assertLess(sum(off) / len(off), 4)
        for name in [m["name"] for m in MAPS[1:]]:
            for x, y in map_places:
                for kind in ("nearest", "texture"):
                    with self.subTest(f"{name} at {x},{y}, {kind}"):
                        off = sorted(self.differences(found["pictures"][f"{name},{x},{y},1,{kind}"], (x, y, 1, kind), name))
                        if kind == "nearest":
                            self.assertLess(sum(d > 2 for d in off), 0.01 * len(off))
                        else:
                            self.assertLessEqual(off[int(0.999 * len(off))], 4)
        self.assertTrue(found["sample"])
        self.assertFalse(found["wide"])

    def test_the_page_stands_alone_and_is_stable(self):
        self.scene()
        self.run_tilepack("view", "scene.json", "-o", "a.html", "--metres", "2", "--time", "3")
        self.run_tilepack("view", "scene.json", "-o", "b.html", "--metres", "2", "--time", "3")
        pages = []
        for name in ("a.html", "b.html"):
            with open(self.path(name), encoding="utf-8") as file:
                pages.append(file.read())
        self.assertEqual(*pages)
        self.assertNotRegex(pages[0], r"https?://|src=|@import")
        self.assertNotIn("{{", pages[0])
        self.assertIn("tilepack view scene.json --metres 2 --time 3", pages[0])

    def test_what_can_not_be_shown_is_refused(self):
        sprites = [{"at": [i % 40 + 0.5, i // 40 + 0.5], "scale": 0.5} for i in range(1100)]
        self.picture("leaf.png", (60, 140, 40), 1, 4)
        nodes = {"cells": {"block": "tile-map", "cells": [64, 64]}, "strewn": {"block": "explicit-positioning", "grid": "cells", "sprites": sprites},
                 "look": {"block": "reference-texture", "patterns": ["leaf.png"], "place": "strewn"}}
        scene = {"format": "tilepack-scene", "version": 1, "size": [1024, 1024], "nodes": nodes, "output": "look"}
        self.write_json("many.json", scene)
        self.refused("view", "many.json", "-o", "a.html", code=3, saying=["look", "1100 sprites", "tile-transform"])
        sets = {f"set{i}": {"block": "reference-texture", "patterns": [self.picture(f"p{i}.png", (9 * i, 80, 80), i)], "place": "cells"} for i in range(15)}
        layers = {"block": "layers", "textures": list(sets)}
        self.write_json("sets.json", {**scene, "nodes": {"cells": nodes["cells"], **sets, "look": layers}})
        self.refused("view", "sets.json", "-o", "a.html", code=3, saying=["17 textures", "16", "compose"])
        self.write_json("none.json", {**scene, "output": "nothing"})
        self.refused("view", "none.json", "-o", "a.html", code=3, saying="nothing")
        self.write_json("p.json", {**scene, "nodes": {"look": {"block": "color", "value": [1, 0, 0]}}})
        self.refused("view", "p.json", "-o", "p.txt", code=1, saying=".html")
        self.refused("view", "leef.pack", "-o", "p.html", "--time", "1", code=2, saying="leef.pack")
        self.picture("sample.png", (120, 130, 70), 3, side=96)
        self.refused("view", "sample.png", "-o", "p.html", "--time", "1", code=2, saying="sample.png: is no pack")
        self.run_tilepack("bake", "sample.png", "-o", "a.pack", "--tile-size", "16", "--effort", "0", "-q")
        self.refused("view", "a.pack", "-o", "p.html", "--time", "1", code=1, saying=["--time", "a.pack is a pack", "leave it out"])


if __name__ == "__main__":
    unittest.main()
