"""Ctrl-C at any moment from the start of the program on: one line says so, and the signal is what ends it."""

import signal
import subprocess
import time
import unittest

from command import TILEPACK, CommandCase


class Interrupt(CommandCase):
    def interrupted(self, wait):
        """Starts a long bake, waits, interrupts it; what it printed on stderr."""
        process = subprocess.Popen([TILEPACK, "bake", "sample.png", "-o", "out", "--effort", "9", "--colors", "3"],
                                   cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            wait(process)
            process.send_signal(signal.SIGINT)
            output, message = process.communicate()
        finally:
            process.kill()
        self.assertEqual(process.returncode, -signal.SIGINT, message)
        self.assertEqual(output, "")
        return message

    def test_it_is_said_whenever_it_comes(self):
        self.noise_png("sample.png", 256, 256)
        before = self.contents()

        # Libraries start threads before main begins; until there is more than one, the system may be loading yet.
        def until_running(process):
            end = time.monotonic() + 60
            while "Threads:\t1\n" in self.status(process) and time.monotonic() < end and process.poll() is None:
                pass

        for delay in (0, 0, 0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6):
            with self.subTest(delay=delay):
                message = self.interrupted(lambda process: (until_running(process), time.sleep(delay)))
                self.assertEqual(message, "tilepack bake: interrupted; nothing was written\n")
                self.assertEqual(self.contents(), before)

    def test_it_is_answered_within_a_second_wherever_it_comes(self):
        for name, side in (("sample.png", 128), ("large.png", 512)):
            self.noise_png(name, side, side)
        before = self.contents()
        for arguments in (("bake", "sample.png", "-o", "out", "--coloring", "edge", "--colors", "4", "--layout", "rotated",
                           "--tile-size", "32"),
                          ("bake", "large.png", "-o", "out", "--effort", "9", "--colors", "3"),
                          ("bake", "large.png", "-o", "out", "--tile-size", "auto", "--report", "x.html", "--depfile", "x.d"),
                          ("bench", "--spans", "--report", "x.html")):
            for delay in (0.1, 0.4, 0.9, 1.6):
                took = []
                for _ in range(3):  # a machine may be busy with something else
                    process = subprocess.Popen([TILEPACK, *arguments], cwd=self.folder, stdout=subprocess.DEVNULL,
                                               stderr=subprocess.PIPE, text=True)
                    time.sleep(delay)
                    start = time.monotonic()
                    process.send_signal(signal.SIGINT)
                    message = process.communicate()[1]
                    took.append(time.monotonic() - start)
                    if process.returncode == 0 or took[-1] < 1:
                        break
                with self.subTest(arguments, delay=delay, message=message):
                    if process.returncode == 0:
                        before = self.contents()
                        continue  # it was faster
                    self.assertEqual(process.returncode, -signal.SIGINT)
                    self.assertLess(min(took), 1)
                    self.assertEqual(self.contents(), before)

    def status(self, process):
        with open(f"/proc/{process.pid}/status", encoding="utf-8") as stream:
            return stream.read()


if __name__ == "__main__":
    unittest.main()
