"""The scripts of samples/farm: a manifest in parts under GNU parallel, and as a job array of a Slurm of our own, one node of which is lost."""

import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from batch_test import Batch as BatchCase
from command import SOURCE, TILEPACK

FARM = os.path.join(SOURCE, "samples/farm")
ENTRIES = 64


class Farm(BatchCase):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path("in"))
        for i in range(4):
            self.noise_png(f"in/{i}.png", 48, 48, seed=i + 1)
        self.manifest(*({"sample": f"in/{i % 4}.png", "options": {"seed": i}, "output": f"packs/{i}"} for i in range(ENTRIES)))
        self.environment = {**os.environ, "TILEPACK": TILEPACK}

    def script(self, name, *words, code=0):
        done = subprocess.run(["sh", os.path.join(FARM, name), *map(str, words)], cwd=self.folder, capture_output=True, text=True,
                              env=self.environment, timeout=300)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout

    def all_made(self):
        self.assertEqual(self.counts("m.json"), {"current": ENTRIES})

    def test_parallel(self):
        if shutil.which("parallel") is None:
            self.skip("GNU parallel is not here")
        self.assertIn(f"{ENTRIES} built", self.script("parallel.sh", "m.json", 3))
        self.all_made()
        self.assertIn(f"{ENTRIES} current", self.script("parallel.sh", "m.json", 3))
        self.write("in/3.png", "broken")
        text = self.script("parallel.sh", "m.json", 3, code=2)
        self.assertEqual(text.count("failed: packs/"), ENTRIES // 4)

    def test_logs_of_parts_that_were_killed(self):
        self.write("1.log", '{"event": "failed", "seconds": 1, "entry": "a", "end": "failed", "took": 1, "peak_memory": 1, "message": "m", "code": 3}\n'
                            '{"event": "end", "seconds": 1, "entries": 1, "current": 0, "built": 0, "restored": 0, "failed": 1, "skipped": 0}\n')
        self.write("2.log", '{"event": "start", "sec')
        merge = lambda *logs: subprocess.run(["python3", os.path.join(FARM, "merge_logs.py"), *logs], cwd=self.folder, capture_output=True).returncode
        self.assertEqual((merge("1.log"), merge("1.log", "2.log"), merge("--parts", "2", "1.log")), (3, 6, 6))

    def test_slurm_with_a_node_lost(self):
        for program in ("slurmctld", "slurmd", "munged", "sbatch"):
            if shutil.which(program) is None:
                self.skipTest(f"not tested under Slurm: {program} is not here")
        slurm = tempfile.mkdtemp(prefix="slurm", dir="/tmp")  # the paths of sockets are short
        self.addCleanup(shutil.rmtree, slurm, ignore_errors=True)
        self.environment["PORT"] = str(40000 + os.getpid() % 20000)
        start = subprocess.run(["sh", os.path.join(FARM, "local_slurm.sh"), "start", slurm], env=self.environment, capture_output=True, text=True)
        self.addCleanup(subprocess.run, ["sh", os.path.join(FARM, "local_slurm.sh"), "stop", slurm], env=self.environment)
        if start.returncode != 0:
            self.skipTest("not tested under Slurm, which does not start here: " + start.stderr.strip())
        self.environment["SLURM_CONF"] = os.path.join(slurm, "slurm.conf")
        # A program that takes its time, so that there is something to lose.
        self.write("slow", f"#!/bin/sh\nsleep 1\nexec {TILEPACK} \"$@\"\n")
        os.chmod(self.path("slow"), 0o755)
        self.environment["TILEPACK"] = self.path("slow")
        submit = subprocess.Popen(["sh", os.path.join(FARM, "slurm_submit.sh"), "m.json", "8"], cwd=self.folder, env=self.environment,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(submit.kill)
        end = time.monotonic() + 150
        while not os.listdir(self.path("packs")) if os.path.isdir(self.path("packs")) else True:
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)
        self.lose_node(slurm, "node2")
        output, errors = submit.communicate(timeout=240)
        self.assertEqual(submit.returncode, 0, output + errors)
        self.assertIn("slurm_submit: again: ", errors)
        self.all_made()

    def lose_node(self, slurm, node):
        """The node's daemon and all it runs end without a word."""
        with open(os.path.join(slurm, f"slurmd-{node}.pid"), encoding="utf-8") as stream:
            doomed = {int(stream.read())}
        conf, name = f"SLURM_CONF={slurm}/slurm.conf".encode(), f"SLURMD_NODENAME={node}".encode()
        for process in filter(str.isdigit, os.listdir("/proc")):
            environ = self.environ_of(process).split(b"\0")
            if conf in environ and name in environ:
                doomed.add(int(process))
        for process in doomed:
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def environ_of(self, process):
        try:
            with open(f"/proc/{process}/environ", "rb") as stream:
                return stream.read()
        except OSError:
            return b""


del BatchCase

if __name__ == "__main__":
    unittest.main()
