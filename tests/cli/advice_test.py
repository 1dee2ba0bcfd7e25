"""A verdict that counts: --require, --apply-advice, and what validate says of a pack that its own figures call poor."""

import json
import unittest

from command import CommandCase
from png_image import write_png

POOR = ("--tile-size", 16, "--effort", 0)  # cuts through blotches that nothing hides


class Advice(CommandCase):
    def setUp(self):
        super().setUp()
        self.sample = self.noise_png("noise.png", 96, 96)

    def test_what_is_worse_than_required_is_not_written(self):
        self.refused("bake", self.sample, "-o", "out", *POOR, "--require", "good", code=5, saying=("--require", "--apply-advice"))
        self.run_tilepack("bake", self.sample, "-o", "out", "--tile-size", 32, "--effort", 0)
        before = self.contents()
        done = self.run_tilepack("bake", self.sample, "-o", "out", *POOR, "--require", "fair", "--format", "json", "--depfile", "a.d",
                                 "--report", "a.html", code=5)
        self.assertEqual(self.contents(), before)
        verdict = json.loads(done.stdout)["verdict"]
        self.assertEqual(verdict["grade"], "poor")
        self.assertIn("cure", verdict["remarks"][0])
        self.assertIn("poor", done.stderr)

    def test_what_is_good_enough_is_as_without(self):
        # One plain value is fair, and no option is advised against that.
        write_png(self.path("plain.png"), [[90] * 64 for _ in range(64)], 1)
        self.run_tilepack("bake", "plain.png", "-o", "a", "--tile-size", 16)
        self.run_tilepack("bake", "plain.png", "-o", "b", "--tile-size", 16, "--require", "fair", "--apply-advice")
        self.assertEqual(self.contents("a"), self.contents("b"))

    def test_a_sample_that_shows_nothing_is_called_that(self):
        write_png(self.path("plain.png"), [[90] * 64 for _ in range(64)], 1)
        write_png(self.path("clear.png"), [[(5 * x + 7 * y + c) % 256 if c < 3 else 0 for x in range(64) for c in range(4)]
                                           for y in range(64)], 4)
        for name, code in (("plain", "plain"), ("clear", "clear")):
            done = self.run_tilepack("bake", name + ".png", "-o", name)
            self.assertIn("nothing to tile", done.stdout)
            for word in ("of the sample shown", "--colors", "--wraps", "--tile-size"):
                self.assertNotIn(word, done.stdout + done.stderr)
            done = self.run_tilepack("bake", name + ".png", "-o", name, "--format", "json", "--require", "good", code=5)
            remarks = json.loads(done.stdout)["verdict"]["remarks"]
            self.assertEqual([(r["grade"], r["code"], "cure" in r) for r in remarks], [("fair", code, False)])

    def test_levels_that_end_early_are_noted_once_and_make_no_verdict_worse(self):
        for size, mips, noted in (("36x40", [], True), ("36x40", ["--full-mips"], False), ("36x40", ["--mips", "none"], False),
                                  ("40", [], False)):
            done = self.run_tilepack("bake", self.sample, "-o", "out", "--tile-size", size, "--effort", 0, *mips)
            self.assertEqual(done.stdout.count("  note "), int(noted), done.stdout)
            self.assertEqual("--full-mips goes on" in done.stdout, noted)
        done = self.run_tilepack("bake", self.sample, "-o", "out", "--tile-size", "36x40", "--effort", 0, "--format", "json")
        remark = [r for r in json.loads(done.stdout)["verdict"]["remarks"] if r["code"] == "levels-end"][0]
        self.assertEqual((remark["grade"], remark["cure"]), ("good", {"field": "full-mips", "value": "true"}))

    def test_advice_is_followed_twice_at_most_and_the_better_kept(self):
        plain = json.loads(self.run_tilepack("bake", self.sample, "-o", "a", *POOR, "--format", "json").stdout)
        done = self.run_tilepack("bake", self.sample, "-o", "b", *POOR, "--apply-advice", "--format", "json")
        better = json.loads(done.stdout)
        tried = [line for line in done.stderr.splitlines() if "advice " in line]
        self.assertIn(len(tried), (1, 2), done.stderr)
        self.assertIn("--", tried[0])
        grades = ["good", "fair", "poor"]

        def rank(summary):
            remarks = [r["grade"] for r in summary["verdict"]["remarks"]]
            return grades.index(summary["verdict"]["grade"]), remarks.count("poor"), remarks.count("fair")

        self.assertLessEqual(rank(better), rank(plain))
        if any("kept" in line and "not kept" not in line for line in tried):
            self.assertLess(rank(better), rank(plain))
        # The options that the pack names make it again.
        with open(self.path("b/pack.json"), encoding="utf-8") as stream:
            generator = json.load(stream)["generator"]
        self.assertEqual(generator["options"].get("tile-size"), "x".join(map(str, better["tile_size"]))
                         if better["tile_size"][0] != better["tile_size"][1] else str(better["tile_size"][0]))

    def test_validate_notes_a_pack_that_its_own_figures_call_poor(self):
        self.run_tilepack("bake", self.sample, "-o", "poor", *POOR)
        done = self.run_tilepack("validate", "poor")
        self.assertIn("note TP701", done.stdout)
        self.assertIn("1 note", done.stdout)
        issue = json.loads(self.run_tilepack("validate", "poor", "--format", "json").stdout)["issues"][0]
        self.assertIn("cuts", issue["found"])
        self.assertIn("TP701", self.run_tilepack("validate", "--list-rules").stdout)


if __name__ == "__main__":
    unittest.main()
