"""Readers beside a writer, outputs that belong together, and what killed runs leave behind."""

import os
import random
import shutil
import signal
import subprocess
import threading
import time
import unittest

from command import TILEPACK, CommandCase

SMALL = ("--tile-size", "16", "--effort", "0", "--virtual-size", "8")


class BesideAWriter(CommandCase):
    def replaced(self, times, *options):
        """Bakes two packs in turn into `out` on a thread of its own; the thread."""
        def write():
            for number in range(times):
                subprocess.run([TILEPACK, "bake", "sample.png", "-o", "out", "--seed", str(number % 2), *SMALL,
                                *options[number % 2]], cwd=self.folder, check=True, capture_output=True)
        thread = threading.Thread(target=write)
        thread.start()
        return thread

    def test_pictures_show_one_pack_and_packs_are_good(self):
        self.noise_png("sample.png")
        # One with other files and another size of tile, one of the same structure.
        for name, other in (("structure", ("--tile-size", "32")), ("values", ("--tile-size", "16"))):
            shutil.rmtree(self.path("out"), ignore_errors=True)
            expected = set()
            for seed, options in ((1, other), (0, ())):
                self.run_tilepack("bake", "sample.png", "-o", "out", "--seed", seed, *SMALL, *options)
                self.run_tilepack("render", "out", "-o", "expected.png", "--rect", "0,0,64,64")
                with open(self.path("expected.png"), "rb") as stream:
                    expected.add(stream.read())
            self.assertEqual(len(expected), 2)
            writer = self.replaced(25, (), other)
            seen, read = set(), 0
            while writer.is_alive() or not read:
                read += 1
                self.run_tilepack("render", "out", "-o", "now.png", "--rect", "0,0,64,64")
                with open(self.path("now.png"), "rb") as stream:
                    self.assertIn(stream.read(), expected, f"{name}: a picture of neither pack, number {read}")
                self.run_tilepack("validate", "out")
                self.run_tilepack("inspect", "out", "--format", "json")
                self.run_tilepack("compare", "out", "out", code=None)
            writer.join()

    def run_tilepack(self, *arguments, code=0, **options):
        if code is not None:
            return super().run_tilepack(*arguments, code=code, **options)
        # Equal, or of two packs, which is no error.
        done = subprocess.run([TILEPACK, *arguments], cwd=self.folder, capture_output=True, text=True)
        self.assertIn(done.returncode, (0, 5), done.stderr)
        return done


class Together(CommandCase):
    def bake(self, seed, *options):
        return [TILEPACK, "bake", "sample.png", "-o", "out", "--seed", str(seed), *SMALL, "--report", "out.html",
                "--depfile", "out.d", *options]

    def test_a_full_disk_leaves_all_outputs_as_they_were(self):
        import resource
        self.noise_png("sample.png")
        subprocess.run(self.bake(1), cwd=self.folder, check=True, capture_output=True)
        # The pack's files are smaller than the report.
        largest = max(os.path.getsize(self.path("out", name)) for name in os.listdir(self.path("out")))
        limit = (largest + os.path.getsize(self.path("out.html"))) // 2
        self.assertGreater(limit, largest)
        message = self.refused(*self.bake(2)[1:], code=4, saying=("out.html", "writing failed"),
                               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        self.assertNotIn(".part", message)

    def test_killed_at_random_moments(self):
        self.noise_png("sample.png")
        packs = {}
        for seed in (1, 2):
            subprocess.run(self.bake(seed), cwd=self.folder, check=True, capture_output=True)
            packs[seed] = self.contents()
        source = random.Random(1)
        start = time.monotonic()
        subprocess.run(self.bake(2), cwd=self.folder, check=True, capture_output=True)
        whole = time.monotonic() - start
        for _ in range(15):
            process = subprocess.Popen(self.bake(1), cwd=self.folder, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            time.sleep(source.random() * whole)
            process.kill()
            process.wait()
            # Any verb that writes there, or reads the pack.
            self.run_tilepack("validate", "out")
            subprocess.run(self.bake(2), cwd=self.folder, check=True, capture_output=True)
            found = self.contents()
            self.assertEqual(found.keys(), packs[2].keys())
            for name, data in found.items():
                if name != "out.html":  # which tells shares of time
                    self.assertEqual(data, packs[2][name], name)

    def test_the_pack_folder_may_hold_report_and_depfile(self):
        self.noise_png("sample.png")
        for seed in (1, 2):
            self.run_tilepack("bake", "sample.png", "-o", "out", *SMALL, "--seed", seed, "--report", "out/page.html",
                              "--depfile", "out/rule.d")
            self.assertEqual({"page.html", "rule.d", "pack.json"} - set(os.listdir(self.path("out"))), set())
        self.assertEqual(sorted(os.listdir(self.folder)), ["out", "sample.png"])

    def test_folders_that_cannot_be_swapped_are_announced(self):
        self.noise_png("sample.png")
        bake = ("bake", "sample.png", "-o", "out", *SMALL)
        self.assertNotIn("one by one", self.run_tilepack(*bake).stderr)
        self.assertNotIn("one by one", self.run_tilepack(*bake).stderr)
        os.mkdir(self.path("out", "drafts"))
        self.assertIn("out has folders in it, so that its files are replaced one by one", self.run_tilepack(*bake).stderr)
        os.rmdir(self.path("out", "drafts"))
        done = subprocess.run([TILEPACK, "bake", "../sample.png", "-o", ".", *SMALL], cwd=self.path("out"),
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(". is the current folder", done.stderr)
        self.run_tilepack("validate", "out")


class LeftOvers(CommandCase):
    def test_the_next_run_of_any_verb_removes_dead_temporary_files(self):
        self.run_tilepack("bake", self.noise_png("sample.png"), "-o", "out", *SMALL)
        for arguments in (("render", "out", "-o", "x.png", "--rect", "0,0,4096,4096"),
                          ("inspect", "out", "--picture", "x.png"),
                          ("compare", "sample.png", "sample.png", "--picture", "x.png"),
                          ("bake", "sample.png", "-o", "new", *SMALL, "--depfile", "x.d", "--report", "x.html")):
            with self.subTest(arguments):
                process = subprocess.Popen([TILEPACK, *arguments], cwd=self.folder, stdout=subprocess.DEVNULL,
                                           stderr=subprocess.DEVNULL)
                end = time.monotonic() + 30
                while not self.hidden() and process.poll() is None and time.monotonic() < end:
                    pass
                process.kill()
                process.wait()
                self.run_tilepack(*(arguments[:4] if arguments[0] == "render" else arguments))
                self.assertEqual(self.hidden(), [])

    def hidden(self):
        return [name for name in os.listdir(self.folder) if name.startswith(".")]

    def test_an_interrupted_render_is_whole_or_leaves_nothing(self):
        self.run_tilepack("bake", self.noise_png("sample.png"), "-o", "out", *SMALL)
        render = [TILEPACK, "render", "out", "-o", "x.png", "--rect", "0,0,2048,2048"]
        start = time.monotonic()
        subprocess.run(render, cwd=self.folder, check=True)
        whole = time.monotonic() - start
        with open(self.path("x.png"), "rb") as stream:
            picture = stream.read()
        ended = 0
        for number in range(20):
            os.remove(self.path("x.png")) if os.path.exists(self.path("x.png")) else None
            process = subprocess.Popen(render, cwd=self.folder, stderr=subprocess.PIPE, text=True)
            time.sleep(whole * (number + 1) / 20)
            process.send_signal(signal.SIGINT)
            message = process.communicate()[1]
            with self.subTest(number=number, message=message):
                self.assertEqual(self.hidden(), [])
                if process.returncode == 0:
                    with open(self.path("x.png"), "rb") as stream:
                        self.assertEqual(stream.read(), picture)
                    self.assertNotIn("nothing was written", message)
                else:
                    ended += 1
                    self.assertEqual(process.returncode, -signal.SIGINT)
                    self.assertFalse(os.path.exists(self.path("x.png")))
        self.assertGreater(ended, 0)


if __name__ == "__main__":
    unittest.main()
