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
        self.run_tilepack("bake", self.sample, "-o", "floats", "--tile-size", 32, "--effort", 0, "--image-format", "exr")
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

    def limited(self, limits, *arguments, user=None):
        """A run under limits of resources, with paths in full; its code and what it says, which is one line at most."""

        def limit():
            for kind, most in limits:
                resource.setrlimit(kind, (most, most))
            if user is not None:
                os.setuid(user)

        done = subprocess.run([TILEPACK, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=100,
                              preexec_fn=limit)
        self.assertNotIn("terminate", done.stderr)
        self.assertNotIn("internal fault", done.stderr)
        self.assertLessEqual(done.stderr.count("\n"), 1, done.stderr)
        return done

    @unittest.skipIf(os.environ.get("TILEPACK_SANITIZED") == "1", "the address sanitizer itself takes more than any limit")
    def test_little_address_space_holds_up_no_library_that_is_not_needed(self):
        # OpenBLAS, which OpenImageIO brings, tries for ever to get memory for its threads, and never lets them be ended.
        codes = set()
        for mebibytes in (90, 120, 150, 200, 300):
            done = self.limited([(resource.RLIMIT_AS, mebibytes << 20)], "bake", self.sample, "-o", f"p{mebibytes}", "--tile-size", "16",
                                "--effort", "0", "--quiet")
            with self.subTest(mebibytes=mebibytes, stderr=done.stderr):
                self.assertIn(done.returncode, (0, 6, 127))
            codes.add(done.returncode)
        self.assertIn(0, codes)

    @unittest.skipIf(os.environ.get("TILEPACK_SANITIZED") == "1", "the sanitizers start threads themselves")
    def test_few_processes(self):
        if os.getuid() != 0:
            self.skip("only root can become another user, and root has no limit")
        os.chmod(self.folder, 0o777)
        image = os.path.join(self.folder, "sample.png")
        with open(self.sample, "rb") as source:
            self.write("sample.png", source.read())
        self.run_tilepack("bake", "sample.png", "-o", "floats", "--tile-size", 32, "--effort", 0, "--image-format", "exr")
        other = 54321  # has no processes of its own
        for processes in (1, 3, 10):
            for arguments in (("bake", image, "-o", f"out{processes}", "--tile-size", "16", "--effort", "0", "--quiet"),
                              ("validate", "floats")):
                done = self.limited([(resource.RLIMIT_NPROC, processes)], *arguments, user=other)
                with self.subTest(processes=processes, arguments=arguments, stderr=done.stderr):
                    self.assertIn(done.returncode, (0, 6))

    def test_a_current_folder_that_was_removed(self):
        gone = self.path("gone")
        os.mkdir(gone)
        done = subprocess.run(["sh", "-c", f'cd "{gone}" && rmdir "{gone}" && exec "$@"', "sh", TILEPACK, "bake", self.sample, "-o", "a",
                               "--tile-size", "16", "--effort", "0"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 4)
        self.assertIn("the current folder was removed", done.stderr)
        self.assertNotIn("internal", done.stderr)

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
