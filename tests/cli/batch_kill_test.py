"""Killed at any moment, batch, cache and watch leave outputs that are old or new, whole; the next run cleans up.

TILEPACK_KILLS is how many kills there are, 300 unless given.
"""

import os
import random
import shutil
import signal
import subprocess
import time
import unittest

from batch_test import Batch as BatchCase
from command import TILEPACK

KILLS = int(os.environ.get("TILEPACK_KILLS", "300"))


class Kills(BatchCase):
    def write_manifest(self, version):
        self.manifest({"samples": "in/*.png", "options": {"seed": version}, "output": "packs/{stem}"},
                      {"verb": "render", "pack": "packs/a", "options": {"rect": "0,0,32,32"}, "output": "a.png"})

    def shown(self, folder):
        return {name: data for name, data in self.contents(folder).items() if not os.path.basename(name).startswith(".") and data is not None}

    def pack(self, name):
        return {os.path.basename(file): data for file, data in self.shown(f"packs/{name}").items()}

    def state(self):
        with open(self.path("a.png"), "rb") as stream:
            return {**{name: self.pack(name) for name in "abc"}, "view": stream.read()}

    def hidden(self):
        return sorted(name for name in self.contents() if os.path.basename(name).startswith(".") and not name.endswith((".build", ".index")))

    def test_outputs_are_old_or_new(self):
        self.samples("a", "b", "c")
        good = []
        for version in (0, 1):
            self.write_manifest(version)
            self.batch("m.json", "--all")
            good.append(self.state())
        chance = random.Random(19)  # moments only: what is made never depends on them
        killed = 0
        for i in range(KILLS):
            self.write_manifest(i % 2)
            words = ["batch", "m.json", "--jobs", "2", "-q"]
            if i % 3 == 1:
                words += ["--cache", "cache", "--cache-size", str(chance.choice([10_000, 10_000_000]))]
                if i % 2:
                    shutil.rmtree(self.path("cache"), ignore_errors=True)
            if i % 3 == 2:
                words += ["--watch"]
            process = subprocess.Popen([TILEPACK, *words], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(chance.random() ** 2 * 0.35)
            process.send_signal(signal.SIGKILL)
            killed += process.wait() == -signal.SIGKILL
            for name in "abc":
                self.assertIn(self.pack(name), [state[name] for state in good], f"packs/{name} after kill {i} of {words}")
            with open(self.path("a.png"), "rb") as stream:
                self.assertIn(stream.read(), [state["view"] for state in good])
        self.assertGreater(killed, KILLS // 3)
        for version in (0, 1):
            self.write_manifest(version)
            self.batch("m.json", "--cache", "cache")
            self.assertEqual(self.state(), good[version])
        self.batch("m.json", "--all", "-q")
        self.assertEqual([name for name in self.hidden() if "unfinished" not in name], [], "the next run cleans up")
        # What killed writers of a cache left goes with age, since other machines may be writing.
        for name in self.hidden():
            os.utime(self.path(name), (1000, 1000))
        self.edit("in/a.png")
        self.noise_png("in/a.png", 48, 48, seed=99)
        self.batch("m.json", "--cache", "cache")
        self.assertEqual(self.hidden(), [])


class Writers(BatchCase):
    def test_the_second_waits_and_finds_it_done(self):
        self.samples("a")
        self.noise_png("in/a.png", 128, 128)
        self.manifest({"samples": "in/*.png", "options": {"tile-size": 32, "effort": 9, "colors": "2"}, "output": "packs/{stem}"})
        first = subprocess.Popen([TILEPACK, "batch", "m.json", "-q"], cwd=self.folder, stdout=subprocess.DEVNULL)
        while not os.path.exists(self.path("packs")) and first.poll() is None:
            time.sleep(0.01)
        message = self.run_tilepack("bake", "in/a.png", "-o", "packs/a", "--tile-size", 16, code=4).stderr
        self.assertIn(f"packs/a: process {first.pid} is writing it", message)
        self.assertIn("--wait", message)
        self.assertIn(f"process {first.pid} is writing it", self.run_tilepack("batch", "m.json", "--no-wait", "-q", code=4).stderr)
        self.assertEqual(self.counts("m.json"), {"current": 1})
        self.assertEqual(first.wait(), 0)

    def test_interrupts_end_it_within_a_second(self):
        self.samples("a", "b")
        for name in "ab":
            self.noise_png(f"in/{name}.png", 384, 384, seed=3)
        self.manifest({"samples": "in/*.png", "options": {"tile-size": 96, "effort": 9, "colors": "3"}, "output": "packs/{stem}"})
        before = self.contents()
        for number, delay in ((signal.SIGINT, 0.3), (signal.SIGTERM, 1.0), (signal.SIGINT, 2.0)):
            with self.subTest(delay=delay):
                process = subprocess.Popen([TILEPACK, "batch", "m.json", "--jobs", "2"], cwd=self.folder, stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE, text=True)
                time.sleep(delay)
                began = time.monotonic()
                process.send_signal(number)
                _, errors = process.communicate()
                took = time.monotonic() - began
                self.assertEqual(process.returncode, -number, errors)
                self.assertIn("interrupted; ", errors)
                self.assertLess(took, 1 if os.environ.get("TILEPACK_SANITIZED") != "1" else 10)
                after = {name: data for name, data in self.contents().items() if name not in ("packs", ".m.json.index")}
                self.assertEqual(after, before)


del BatchCase

if __name__ == "__main__":
    unittest.main()
