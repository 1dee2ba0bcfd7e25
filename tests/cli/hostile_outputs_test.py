"""Output folders that can't or must not be written: refused, older packs and other files intact."""

import os
import resource
import subprocess
import unittest

from command import TILEPACK, CommandCase

SMALL = ("--tile-size", 16, "--effort", 0, "--virtual-size", 8)
CANNOT_WRITE = 4


class Outputs(CommandCase):
    def test_files_of_others(self):
        sample = self.noise_png("sample.png")
        os.mkdir(self.path("out"))
        self.write("out/thesis.txt", "years of work")
        self.refused("bake", sample, "-o", "out", *SMALL, code=CANNOT_WRITE, saying="thesis.txt")
        self.refused("bake", sample, "-o", ".", *SMALL, code=CANNOT_WRITE)
        self.write("out/pack.json", '{"name": "something else"}')
        self.refused("bake", sample, "-o", "out", *SMALL, code=CANNOT_WRITE, saying="no readable tile pack")

    def test_the_folder_is_a_file(self):
        sample = self.noise_png("sample.png")
        self.refused("bake", sample, "-o", "sample.png", *SMALL, code=CANNOT_WRITE, saying="no folder")
        self.refused("bake", sample, "-o", "sample.png/out", *SMALL, code=CANNOT_WRITE)
        self.refused("bake", sample, "-o", "/proc/out", *SMALL, code=CANNOT_WRITE)

    def test_a_depfile_that_cannot_be_written(self):
        sample = self.noise_png("sample.png")
        self.refused("bake", sample, "-o", "out", *SMALL, "--depfile", "nowhere/out.d", code=CANNOT_WRITE,
                     saying="nowhere/out.d")
        self.refused("bake", "missing.png", "-o", "out", *SMALL, "--depfile", "out.d", code=2)

    def older_pack(self):
        self.run_tilepack("bake", self.noise_png("sample.png"), "-o", "out", *SMALL)

    def test_a_full_disk(self):
        """A limit on the size of files stands for a full disk: writing fails in the middle of one."""
        self.older_pack()
        sample = self.noise_png("large.png", 256, 256)

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))

        for output in ("out", "new", "new/deep"):
            with self.subTest(output):
                self.refused("bake", sample, "-o", output, "--effort", 0, "--tile-size", 64, code=CANNOT_WRITE,
                             saying=output, preexec_fn=limit)

    def test_a_read_only_folder(self):
        self.older_pack()
        os.mkdir(self.path("empty"))
        drop = None
        if os.geteuid() == 0:  # to whom nothing is read-only
            def drop():
                os.setgid(65534)
                os.setuid(65534)
            os.chmod(self.folder, 0o755)
            try:
                subprocess.run([TILEPACK, "--version"], preexec_fn=drop, capture_output=True, check=True)
            except (PermissionError, FileNotFoundError, subprocess.SubprocessError):
                self.skipTest("the program can't be run by another user from here")
        for name in ("out", "empty", "."):
            os.chmod(self.path(name), 0o555)
        for output in ("out", "empty", "new"):
            with self.subTest(output):
                self.refused("bake", "sample.png", "-o", output, *SMALL, code=CANNOT_WRITE, saying=output,
                             preexec_fn=drop)
        for name in ("out", "empty", "."):
            os.chmod(self.path(name), 0o755)


if __name__ == "__main__":
    unittest.main()
