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

    def status(self, process):
        with open(f"/proc/{process.pid}/status", encoding="utf-8") as stream:
            return stream.read()


if __name__ == "__main__":
    unittest.main()
