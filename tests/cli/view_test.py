"""`tilepack view`: the page stands alone, is stable, and shows in a browser what `tilepack render` writes."""

import base64
import json
import random
import re
import unittest

from browser_page import CHROMIUM, found_in_page
from png_image import read_png, write_png
from shader_case import ShaderCase

SIDE = 128
# What the browser does, beside tests/cli/browser_page.py.
BODY = """
  const plain = { x: 8, y: 8, zoom: 1, fly: 0, lit: 0, tint: 'none', filter: 'nearest' };
  picture('nearest', plain);
  picture('ids', { tint: 'ids' });
  picture('far ids', { x: 65536 * 3 + 8, y: 1e6 });
  if (EXACT) picture('exact', { ...plain, filter: 'exact' });
  picture('coarse', { ...plain, filter: 'texture', zoom: 0.5 });
  const send = (kind, x, y) => canvas.dispatchEvent(new PointerEvent(kind, { pointerId: 1, clientX: x, clientY: y, bubbles: true }));
  send('pointermove', 20, 20);
  for (const tint of ['tiles', 'borders', 'levels', 'repeats']) picture(tint, { ...plain, tint });
  picture('flight', { ...plain, filter: 'texture', fly: 1, height: 1, pitch: 40 });
  Object.assign(state, plain);
  canvas.setPointerCapture = () => {};
  send('pointerdown', 64, 64); send('pointermove', 80, 56); send('pointerup', 80, 56);
  out.dragged = [state.x, state.y];
  const before = placeAt(30, 40);
  canvas.dispatchEvent(new WheelEvent('wheel', { deltaY: -400, clientX: 30, clientY: 40, cancelable: true }));
  out.zoomed = [state.zoom, placeAt(30, 40).map((v, i) => v - before[i])];
  const select = document.getElementById('c_filter');
  select.value = 'nearest'; select.dispatchEvent(new Event('input'));
  await new Promise((done) => setTimeout(done, 400));
  out.address = location.hash;
  location.hash = '#x=3.5&zoom=0.5&filter=nonsense';
  await new Promise((done) => setTimeout(done, 200));
  out.moved = [state.x, state.zoom, state.filter];
"""


class ViewTest(ShaderCase):
    def test_the_page_stands_alone_and_is_stable(self):
        self.bake("even")
        self.run_tilepack("view", "even.pack", "-o", "a.html", "--metres", "2")
        self.run_tilepack("view", "even.pack/pack.json", "-o", "b.html", "--metres", "2")
        with open(self.path("a.html"), encoding="utf-8") as file:
            page = file.read()
        with open(self.path("b.html"), encoding="utf-8") as file:
            self.assertEqual(page, file.read())
        self.assertNotRegex(page, r"https?://|src=|@import")
        self.assertNotIn("{{", page)
        self.assertIn("tilepack view even.pack --metres 2", page)
        data = json.loads(re.search(r'id="pack">(.*?)</script>', page, re.DOTALL).group(1))
        self.assertEqual([m["name"] for m in data["mappings"]], ["even", "mix", "permutation"])
        self.assertEqual(data["metres"], 2)

    def test_what_can_not_be_shown_is_refused(self):
        self.bake("even")
        self.refused("view", "even.pack", "-o", "a.txt", code=1, saying=".html")
        self.refused("view", "even.pack", code=1, saying="--output")
        self.refused("view", "even.pack", "-o", "a.html", "--metres", "0", code=1, saying="--metres")

    def in_browser(self, pack, exact):
        """What the script above finds in the page of a pack."""
        self.run_tilepack("view", pack, "-o", "page.html")
        return found_in_page(self, "page.html", SIDE, BODY.replace("EXACT", "true" if exact else "false"))

    def rendered(self, pack, *options):
        self.run_tilepack("render", pack, "-o", "window.png", *options)
        return read_png(self.path("window.png"))[0]

    def largest_difference(self, picture, rows):
        pixels = base64.b64decode(picture)
        return max(abs(pixels[4 * (SIDE * y + x) + c] - rows[y][3 * x + c])
                   for y in range(SIDE) for x in range(SIDE) for c in range(3))

    @unittest.skipUnless(CHROMIUM, "not run: no chromium")
    def test_a_browser_shows_what_render_writes(self):
        for kind, exact in (("even", True), ("corners", True), ("array", True), ("index", True), ("rotated", False)):
            with self.subTest(kind):
                pack = self.bake(kind)
                found = self.in_browser(pack, exact)
                pictures = found["pictures"]
                window = "--rect=64,64,128,128"
                if kind != "rotated":
                    self.assertLessEqual(self.largest_difference(pictures["nearest"], self.rendered(pack, window, "--filter", "nearest")), 1)
                    coarse = self.rendered(pack, "--level", "1", "--rect=0,0,128,128", "--filter", "bilinear")
                    self.assertLessEqual(self.largest_difference(pictures["coarse"], coarse), 3)
                self.check_ids(pack, pictures["ids"], 8, 8)
                self.check_ids(pack, pictures["far ids"], 65536 * 3 + 8, 1000000)
                shown = ["nearest", "tiles", "borders", "levels", "repeats", "flight"]
                self.assertEqual(len({pictures[name] for name in shown}), len(shown))
                if exact:  # at the centers of texels
                    self.assertEqual(pictures["exact"], pictures["nearest"])
                self.assertAlmostEqual(found["dragged"][0], 7)
                self.assertAlmostEqual(found["dragged"][1], 8.5)
                self.assertGreater(found["zoomed"][0], 1.5)
                self.assertLess(max(map(abs, found["zoomed"][1])), 1e-9)
                self.assertIn("filter=nearest", found["address"])
                self.assertEqual(found["moved"], [3.5, 0.5, "nearest"])
                self.assertFalse(found["wide"])

    @unittest.skipUnless(CHROMIUM, "not run: no chromium")
    def test_a_browser_shows_far_levels_as_render_does(self):
        rng = random.Random(3)  # areas as large as tiles, so that there is something to be seen from afar
        tones = [[rng.choice((20, 235)) for _ in range(8)] for _ in range(8)]
        write_png(self.path("sample.png"), [[tones[y // 16][x // 16] + rng.randrange(20) for x in range(128) for _ in range(3)]
                                            for y in range(128)], 3)
        self.run_tilepack("view", self.bake("full"), "-o", "page.html")
        pictures = found_in_page(self, "page.html", SIDE, """
  const far = { x: 64, y: 64, fly: 0, lit: 0, tint: 'none', filter: 'texture' };
  for (const level of [5, 6, 7]) picture('level ' + level, { ...far, zoom: 2 ** -level });
""")["pictures"]
        for level in (5, 6, 7):  # tiles of 16 texels have 5 levels, 0 to 4
            side = SIDE << level
            corner = 64 * 16 - side // 2
            rows = self.rendered("full.pack", f"--rect={corner},{corner},{side},{side}", "--scale", str(2 ** -level))
            self.assertLessEqual(self.largest_difference(pictures[f"level {level}"], rows), 3)
            again = self.rendered("full.pack", "--level", str(level), f"--rect={corner >> level},{corner >> level},{SIDE},{SIDE}")
            if level < 7:
                self.assertEqual(again, rows)
        self.assertGreater(self.largest_difference(pictures["level 5"], rows), 5)

    def check_ids(self, pack, picture, x, y):
        lookup, pixels = self.c_lookup(pack), base64.b64decode(picture)
        for row in range(0, SIDE, 8):
            for column in range(0, SIDE, 8):
                expected = lookup.tile(x + (column - SIDE // 2) // 16, y + (row - SIDE // 2) // 16)
                at = 4 * (SIDE * row + column)
                self.assertEqual(pixels[at] + 256 * pixels[at + 1], expected, (row, column))


if __name__ == "__main__":
    unittest.main()
