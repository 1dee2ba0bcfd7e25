"""`tilepack bench` and `tilepack validate --against-reference`: what they print, never how long they take."""

import csv
import html.parser
import io
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
import xml.dom.minidom

from render_test import SmallPack

TILEPACK = os.environ["TILEPACK"]


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.plots, self.outside = [], 0, []

    def handle_starttag(self, tag, attributes):
        self.plots += tag == "svg"
        self.outside += [value for name, value in attributes if name in ("src", "href")]
        if tag not in ("meta",):
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        pass

    def handle_endtag(self, tag):
        assert self.open.pop() == tag, tag


class Bench(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.pack = os.path.join(cls.folder, "pack")
        SmallPack(cls.pack)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def run_verb(self, *arguments):
        return subprocess.run([TILEPACK, *arguments], capture_output=True, text=True)

    def bench(self, *options):
        return self.run_verb("bench", self.pack, "--quick", "--lookups", "50", *options)

    def test_json_and_page(self):
        page = os.path.join(self.folder, "page.html")
        result = self.bench("--format", "json", "--report", page)
        self.assertEqual(result.returncode, 0, result.stderr)
        figures = json.loads(result.stdout)
        self.assertEqual(figures["map"], "color")
        self.assertEqual(len(figures["lookups"]), 21)
        self.assertTrue(all(case["kept"] for case in figures["hard_lookups"]), figures["hard_lookups"])
        self.assertEqual(len(figures["mips_in_short"]), 5)
        self.assertNotIn(self.folder, result.stdout)
        with open(page, encoding="utf-8") as file:
            text = file.read()
        parser = Page()
        parser.feed(text)
        self.assertEqual(parser.open, [])
        self.assertEqual(parser.outside, [])
        self.assertGreaterEqual(parser.plots, 7)
        for svg in re.findall("<svg.*?</svg>", text, re.DOTALL):
            xml.dom.minidom.parseString(svg)
        for case in figures["hard_lookups"]:
            self.assertIn(html.escape(case["input"], quote=False), text)
        self.assertNotIn(self.folder, text)
        self.assertEqual(sorted(os.listdir(self.folder)), ["pack", "page.html"])

    def test_csv_of_another_map(self):
        result = self.bench("--format", "csv", "--map", "height")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = list(csv.reader(io.StringIO(result.stdout)))
        self.assertEqual(rows[0], ["section", "name", "value"])
        self.assertTrue(all(len(row) == 3 and float(row[2]) >= 0 for row in rows[1:]))

    def test_refusals(self):
        for code, options in (
            (1, ("--map", "colour")),
            (1, ("--rounds", "0")),
            (1, ("--format", "xml")),
            (4, ("--report", "/proc/missing/page.html")),
        ):
            result = self.bench(*options)
            self.assertEqual(result.returncode, code, result.stderr)
            self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        self.assertEqual(self.run_verb("bench", os.path.join(self.folder, "nowhere")).returncode, 2)


if __name__ == "__main__":
    unittest.main()
