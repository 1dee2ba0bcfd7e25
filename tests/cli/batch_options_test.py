"""Options of entries: what the command line would refuse is told with line and name of the manifest, whatever the verb."""

import unittest

from command import CommandCase

CONTENT = 3


class EntryOptions(CommandCase):
    def setUp(self):
        super().setUp()
        self.run_tilepack("bake", self.noise_png("a.png", 48, 48), "-o", "p", "--tile-size", 16, "--effort", 0)

    def told(self, entry, words=(), code=CONTENT):
        self.write("m.json", '{"format": "tilepack-manifest", "version": 1, "jobs": [\n %s]}' % entry)
        done = self.run_batch(*words, code=code)
        return done.stdout + done.stderr

    def run_batch(self, *words, code=0):
        import subprocess
        done = subprocess.run([self.program, "batch", "m.json", *words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_what_is_refused_has_its_line_and_name(self):
        for entry, saying in (
                ('"verb": "shader", "output": "x.h"', 'm.json:2: "lang": is missing among the "options" of shader'),
                ('"verb": "shader", "output": "x.h",\n "options": {"lang": "foo"}', 'm.json:3: "lang": \'foo\' is not allowed; it must be glsl|'),
                ('"verb": "shader", "output": "x.h",\n "options": {"lang": "GLSL"}', "did you mean 'glsl'?"),
                ('"verb": "render", "output": "x.png",\n "options": {"scale": 0}', 'm.json:3: "scale": \'0\' is not allowed; it must be a number above 0'),
                ('"verb": "render", "output": "x.png",\n "options": {"scale": true}', 'm.json:3: "scale": needs a value (S), and is true'),
                ('"verb": "render", "output": "x.png",\n "options": {"skale": 2}', 'm.json:3: "skale": is no option of render; did you mean "scale"?'),
                ('"verb": "view", "output": "x.html",\n "options": {"metres": 0}', 'm.json:3: "metres": \'0\' is not allowed'),
                ('"verb": "validate", "output": "x.txt",\n "options": {"lookups": 1}', 'm.json:3: "lookups": \'1\' is not allowed'),
                ('"verb": "validate", "output": "x.txt",\n "options": {"against-reference": 1}', "'1' is not allowed; it must be true or false"),
                ('"verb": "inspect", "output": "x.txt",\n "options": {"tiles": 1000}', 'm.json:3: "tiles": \'1000\' is not allowed')):
            for words in ((), ("--dry-run",)):
                with self.subTest(entry, words=words):
                    self.assertIn(saying, self.told('{"pack": "p", %s}' % entry, words))

    def test_so_has_what_is_found_later(self):
        for entry, saying in (
                ('"verb": "render", "output": "x.png",\n "options": {"filter": "foo"}', 'm.json:3: "filter": \'foo\' is no filter'),
                ('"verb": "render", "output": "x.png",\n "options": {"rect": "1,2"}', 'm.json:3: "rect": \'1,2\' is no window'),
                ('"verb": "view", "output": "x.page"', 'm.json:2: "output": \'x.page\' ends in \'.page\'; it must be .html'),
                ('"verb": "shader", "options": {"lang": "c"}, "output": "photo.png"', 'm.json:2: "output": \'photo.png\' ends as an image does')):
            with self.subTest(entry):
                self.assertIn(saying, self.told('{"pack": "p", %s}' % entry))

    def test_colors_of_a_pack(self):
        entry = '{"verb": "pack", "tiles": ["a.png"], "output": "q"}'
        self.assertIn('m.json:2: "colors": is missing among the "options" of pack', self.told(entry))
        self.write_json("c.json", [{"nw": 0, "ne": 0, "sw": 0, "se": 0}, {"nw": 0, "ne": 0, "sw": 0, "se": 0}])
        self.noise_png("b.png", 48, 48, seed=8)
        entry = '{"verb": "pack", "tiles": ["a.png", "b.png"], "output": "q", "options": {"colors": "c.json", "layout": "array", "mapping": "index"}}'
        self.assertIn('or allow as much with "tolerance"', self.told(entry, code=5))

    def test_reasons_are_few(self):
        self.write_json("m.json", {"format": "tilepack-manifest", "version": 1, "jobs": [{"verb": "inspect", "pack": "p", "output": "x.txt"}]})
        self.run_batch("-q")
        self.run_tilepack("bake", "a.png", "-o", "p", "--tile-size", 16, "--effort", 0, "--seed", 4)
        plan = self.run_batch("--dry-run").stdout.splitlines()[0]
        self.assertRegex(plan, r"^x.txt: pack \S+ changed, pack \S+ changed, pack \S+ changed, and \d more$")
        self.write_json("m.json", {"format": "tilepack-manifest", "version": 1, "jobs": [
            {"sample": "a.png", "output": "packs/q", "options": {"tile-size": 16, "effort": 0}}]})
        self.run_batch("-q")
        self.run_tilepack("bake", "a.png", "-o", "packs/q", "--tile-size", 16, "--effort", 0, "--seed", 4)
        plan = self.run_batch("--dry-run").stdout.splitlines()[0]
        self.assertRegex(plan, r"^packs/q: (output \S+ edited, ){3}and \d more$")

    def test_a_part_of_a_name_is_enough_to_be_understood(self):
        self.write_json("m.json", {"format": "tilepack-manifest", "version": 1, "jobs": [{"sample": "a.png", "output": "packs/sand"}]})
        self.refused("batch", "m.json", "--only", "sand", code=1, saying="did you mean 'packs/sand'?")


if __name__ == "__main__":
    unittest.main()
