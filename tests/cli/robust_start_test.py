"""Little memory, and names that hold anything: an exit code and one plain line, no crash and no hang."""

import os
import resource
import subprocess
import unittest

from command import SOURCE, TILEPACK, CommandCase


class RobustStart(CommandCase):
    sample = os.path.join(SOURCE, "samples/pebbles.png")

    @unittest.skipIf(os.environ.get("TILEPACK_SANITIZED") == "1", "the address sanitizer itself takes more than any limit")
    def test_little_address_space_is_said_where_openimageio_is_needed(self):
        self.run_tilepack("bake", self.sample, "-o", "floats", "--tile-size", 32, "--effort", 0, "--format", "exr")
        codes = set()
        # With less the program's own threads may not start; here it is the module that can't.
        for mebibytes in (300, 400, 500, 700, 1000):
            limit = mebibytes << 20
            done = subprocess.run([TILEPACK, "validate", "floats"], cwd=self.folder, capture_output=True, text=True, timeout=60,
                                  preexec_fn=lambda limit=limit: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
            if done.returncode == 127:
                continue  # too little for the system's own loader
            codes.add(done.returncode)
            with self.subTest(mebibytes=mebibytes, stderr=done.stderr):
                self.assertIn(done.returncode, (0, 6))
                self.assertNotIn("terminate", done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1 if done.returncode else 0)
        self.assertIn(6, codes)

    def test_names_reach_the_terminal_spelled(self):
        name = "a\x1b[31m\nb.png"
        self.write(name, "no image")
        for raw in (os.fsencode(name), b"\xff\xfe.png"):
            done = subprocess.run([TILEPACK.encode(), b"bake", raw, b"-o", b"pack"], cwd=self.folder, capture_output=True)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(done.stderr.count(b"\n"), 1)
            self.assertNotIn(b"\x1b", done.stderr)
            done.stderr.decode("utf-8")


if __name__ == "__main__":
    unittest.main()
