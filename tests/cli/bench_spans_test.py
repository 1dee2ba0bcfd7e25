"""`tilepack bench --spans`: what it reports, not how fast."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
import xml.dom.minidom

from render_test import TILEPACK, SmallPack


class BenchSpans(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def run_bench(self, *options):
        command = [TILEPACK, "bench", "--spans", "--quick", *options]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_json(self):
        pack = os.path.join(self.folder, "pack")
        SmallPack(pack)
        done = self.run_bench(pack, "--format", "json")
        self.assertEqual(done.returncode, 0, done.stderr)
        bench = json.loads(done.stdout)
        names = {m["method"] for m in bench["methods"]}
        self.assertEqual(names, {"exact", "estimate", "newton", "newton-direct", "newton-general", "euler1",
                                 "euler2", "affine"})
        self.assertEqual({m["precision"] for m in bench["methods"]}, {"f32", "f64"})
        for method in bench["methods"]:
            for key in ("ns_one_by_one", "ns_side_by_side", "ns_fused"):
                self.assertGreater(method[key], 0)
            for error in method["errors"]:
                if method["precision"] == "f64":
                    self.assertLessEqual(error["pixels"], error["bound_pixels"] + 1e-9)
        paper = [e for m in bench["methods"] if (m["method"], m["reseed"], m["precision"]) == ("euler2", 0, "f64")
                 for e in m["errors"] if "[Cou]" in e["case"]]
        self.assertAlmostEqual(paper[0]["bound_pixels"], 0.0405, places=4)
        self.assertGreater(len(bench["hard_cases"]), 12)
        self.assertGreater(bench["view"]["ns_set_up"], 0)
        self.assertGreater(bench["view"]["ns_texturing"], 0)
        exact = bench["view"]["methods"][0]
        self.assertEqual((exact["method"], exact["largest_pixels"], exact["psnr"]), ("exact", 0, None))
        for view in bench["view"]["methods"]:
            if view["wanted_error"] > 0:
                self.assertLessEqual(view["largest_pixels"], view["wanted_error"])
        self.assertTrue(bench["advice"])

    def test_report_stands_alone(self):
        page = os.path.join(self.folder, "spans.html")
        done = self.run_bench("--report", page)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("newton-direct", done.stdout)
        self.assertEqual(os.listdir(self.folder), ["spans.html"])
        with open(page, encoding="utf-8") as file:
            html = file.read()
        self.assertNotIn("<script", html)
        self.assertLessEqual(set(re.findall(r"https?://[^'\"<> ]*", html)), {"http://www.w3.org/2000/svg"})
        plots = re.findall(r"<svg.*?</svg>", html, re.S)
        self.assertEqual(len(plots), 5)
        for plot in plots:
            xml.dom.minidom.parseString(plot)
            self.assertNotIn("nan", plot)
            self.assertNotIn("inf", plot)

    def test_errors(self):
        done = self.run_bench("--format", "xml")
        self.assertEqual((done.returncode, "text or json" in done.stderr), (1, True), done.stderr)
        done = self.run_bench("--report", "/proc/none/x.html")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertEqual(os.listdir(self.folder), [])
        done = self.run_bench(os.path.join(self.folder, "nothing"))
        self.assertEqual(done.returncode, 2, done.stderr)


if __name__ == "__main__":
    unittest.main()
