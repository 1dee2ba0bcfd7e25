"""--watch of bake and batch: saved files are made again, a line each, whole at every moment."""

import os
import signal
import subprocess
import time
import unittest

from batch_test import Batch as BatchCase
from command import TILEPACK


class Watch(BatchCase):
    def start(self, *arguments):
        self.log = open(self.path("log"), "w+", encoding="utf-8")
        self.addCleanup(self.log.close)
        process = subprocess.Popen([TILEPACK, *map(str, arguments)], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=self.log)
        self.addCleanup(lambda: (process.kill(), process.wait()))
        return process

    def lines(self, count, seconds=30):
        """The log once it has so many lines."""
        end = time.monotonic() + seconds
        while True:
            with open(self.path("log"), encoding="utf-8") as stream:
                lines = stream.read().splitlines()
            if len(lines) >= count or time.monotonic() > end:
                self.assertEqual(len(lines), count, lines)
                return lines
            time.sleep(0.02)

    def test_batch(self):
        self.samples("a", "b")
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"})
        process = self.start("batch", "m.json", "--watch")
        self.lines(3)
        self.noise_png("in/a.png", 48, 48, seed=30)
        self.assertIn("packs/a: built", self.lines(4)[-1])
        self.noise_png("in/.a.png.new", 48, 48, seed=31)  # as many editors write
        os.replace(self.path("in/.a.png.new"), self.path("in/a.png"))
        self.assertIn("packs/a: built", self.lines(5)[-1])
        self.noise_png("in/c.png", 48, 48, seed=32)
        self.assertIn("packs/c: built", self.lines(6)[-1])
        self.write("m.json", "{")
        self.assertIn("no valid JSON", self.lines(7)[-1])
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}", "options": {"seed": 2}})
        self.lines(10)
        os.utime(self.path("in/a.png"))  # touched: nothing to do
        time.sleep(0.5)
        self.lines(10)
        process.send_signal(signal.SIGINT)
        began = time.monotonic()
        process.wait()
        self.assertLess(time.monotonic() - began, 1)
        self.assertEqual(process.returncode, -signal.SIGINT)
        self.assertIn("interrupted; what was finished is kept", self.lines(11)[-1])

    def test_bake(self):
        self.noise_png("a.png", 48, 48)
        process = self.start("bake", "a.png", "-o", "pack", "--tile-size", 16, "--effort", 0, "--watch")
        self.assertIn("pack: 16 tiles", self.lines(2)[-1])
        for seed in (5, 6):
            self.noise_png("a.png", 48, 48, seed=seed)
            self.assertIn("pack: 16 tiles", self.lines(seed - 2)[-1])
        os.utime(self.path("a.png"))
        self.write("a.png", b"broken")
        self.assertIn("error: a.png", self.lines(5)[-1])
        self.run_tilepack("validate", "pack")
        process.send_signal(signal.SIGTERM)
        process.wait()
        self.assertEqual(process.returncode, -signal.SIGTERM)

    def test_what_it_does_not_go_with(self):
        self.manifest()
        for other in ("--dry-run", "--emit=ninja"):
            self.run_tilepack("batch", "m.json", "--watch", other, code=1)


del BatchCase

if __name__ == "__main__":
    unittest.main()
