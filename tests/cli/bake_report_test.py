"""`tilepack bake`: the figures and the verdict it prints, and the page of --report."""

import json
import os
import re
import unittest
import xml.dom.minidom

from command import CommandCase

SMALL = ("--tile-size", 16, "--effort", 0, "--virtual-size", 8)


class BakeReport(CommandCase):
    def bake(self, *arguments, sample="sample.png", output="out", **options):
        if not os.path.exists(self.path("sample.png")):
            self.noise_png("sample.png")
        return self.run_tilepack("bake", sample, "-o", output, *SMALL, *arguments, **options)

    def page(self, name="report.html"):
        with open(self.path(name), encoding="utf-8") as stream:
            return stream.read()

    def test_figures_stand_in_the_pack_and_in_the_summary(self):
        for coloring in ("edge", "corner"):
            with self.subTest(coloring):
                summary = json.loads(self.bake("--report-format", "json", "--coloring", coloring).stdout)
                stored = self.read_json("out/pack.json")["synthesis"]
                self.assertEqual(stored, {name: summary["synthesis"][name] for name in stored})
                self.assertIn(summary["verdict"]["grade"], ("good", "fair", "poor"))
                self.assertTrue(all(r["text"].endswith(".") for r in summary["verdict"]["remarks"]))
                for remark in summary["verdict"]["remarks"]:
                    self.assertRegex(remark["code"], r"^[a-z-]+$")
                    cure = remark.get("cure")
                    if cure:  # the text names it as one would type it
                        self.assertIn(f"--{cure['field']} {cure['value']}".strip(), remark["text"])
                text = self.bake("--coloring", coloring).stdout
                self.assertRegex(text, r"quality +" + summary["verdict"]["grade"])
                for remark in summary["verdict"]["remarks"]:
                    self.assertEqual(remark["text"] in text, remark["grade"] != "good")

    def test_the_page_stands_for_itself(self):
        self.bake("--report", "report.html")
        page = self.page()
        document = xml.dom.minidom.parseString(page.replace("<!doctype html>", "").encode())
        images = [i.getAttribute("src") for i in document.getElementsByTagName("img")]
        self.assertEqual(len(images), 6)
        for source in images:
            self.assertTrue(source.startswith("data:image/png;base64,iVBOR"), source[:40])
        self.assertNotRegex(page, r"<script|https?:|file:|<link|url\(")
        self.assertIn("<h1>sample.png</h1>", page)
        times = page.split("Where the time went", 1)[1].split("</table>", 1)[0]
        shares = [int(share) for share in re.findall(r"<td>(\d+) %", times)]
        self.assertGreaterEqual(len(shares), 2)
        self.assertTrue(80 <= sum(shares) <= 105, shares)  # stages below a hundredth are left out

    def test_options_that_were_left_open_are_told(self):
        for arguments, chosen in (((), "--mapping even"), (("--mapping", "mix"), ""),
                                  (("--tile-size", "auto"), r"--tile-size 20x20 --mapping even")):
            self.bake("--report", "report.html", *arguments)
            options = self.page().split("<h2>Options</h2>", 1)[1]
            self.assertEqual("".join(re.findall(r"chosen: <code>(.*?)</code>", options)), chosen)

    def test_only_shares_of_time_differ_from_run_to_run(self):
        def bare(name):
            return re.sub(r"<h2>Where the time went.*?</table>", "", self.page(name), flags=re.DOTALL)
        os.mkdir(self.path("deep"))
        self.noise_png("deep/sample.png")
        self.bake("--jobs", 1, "--report", "one.html", output="one")
        self.bake("--jobs", 4, "--report", "deep/four.html", sample="deep/sample.png", output="deep/four")
        self.assertEqual(bare("one.html"), bare("deep/four.html"))
        self.bake(output="plain")
        self.assertEqual(self.contents("one"), self.contents("plain"))

    def test_a_report_may_lie_in_the_pack(self):
        for _ in range(2):
            self.bake("--report", "out/report.html")
            self.assertIn("report.html", self.contents("out"))

    def test_a_report_that_can_not_be_written_stops_before_the_work(self):
        self.noise_png("sample.png")
        self.refused("bake", "sample.png", "-o", "out", *SMALL, "--report", "sample.png/report.html", code=4,
                     saying="sample.png/report.html")

    def test_a_tile_that_holds_no_whole_repeats_is_told_what_would(self):
        # 24 rows a repeat, each a course of its own grey, on noise.
        self.write("courses.png", courses_png(192, 192, 24))
        for size, grade in ((32, "fair or poor"), (48, "good")):
            summary = json.loads(self.run_tilepack("bake", "courses.png", "-o", "out", "--effort", 0, "--tile-size", size,
                                                   "--report-format", "json").stdout)
            self.assertAlmostEqual(summary["synthesis"]["periods"][1], 24, delta=0.5)
            remarks = [r for r in summary["verdict"]["remarks"] if "along y" in r["text"]]
            self.assertEqual(len(remarks), 1)
            self.assertIn(remarks[0]["grade"], grade.split(" or "))
            if grade != "good":
                self.assertRegex(remarks[0]["text"], r"--tile-size 32x(24|48)")


def courses_png(width, height, period):
    """Grey rows that repeat: a dark joint of four rows, then brick; noise along them."""
    import struct
    import zlib
    import random
    source = random.Random(5)
    rows = bytearray()
    for y in range(height):
        rows.append(0)
        base = 40 if y % period < 4 else 180
        rows += bytes(base + source.randint(0, 40) for _ in range(width))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(bytes(rows), 1)) + chunk(b"IEND", b""))


if __name__ == "__main__":
    unittest.main()
