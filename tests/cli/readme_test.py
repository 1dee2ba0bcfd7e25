"""The commands of the README, from "First commands" on, run in order as they stand in a fresh copy of the project."""

import os
import re
import shutil
import stat
import subprocess
import unittest

from command import SOURCE, TILEPACK, CommandCase

# Drafts stand for bakes whose verdict nobody reads here: the rest is as it is written.
DRAFTS = """#!/bin/sh
case "$*" in
"bake samples/rock -o rock.pack"|*--effort*|*--require*|*--apply-advice*|*--list-maps*) ;;
*--transition*) set -- "$@" --effort 0 --tile-size 32 ;;
bake*) set -- "$@" --effort 0 ;;
esac
exec '{}' "$@"
"""


def blocks_of(readme):
    """The blocks of shell of the README behind the heading, each with its line."""
    start = readme.index("\n## First commands\n")
    return [(readme.count("\n", 0, found.start()) + 2, found.group(1))
            for found in re.compile(r"^```sh\n(.*?)^```$", re.MULTILINE | re.DOTALL).finditer(readme, start)]


class Readme(CommandCase):
    def setUp(self):
        super().setUp()
        with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as stream:
            self.readme = stream.read()

    def test_every_block_of_commands_runs_as_it_stands(self):
        if os.environ.get("TILEPACK_SANITIZED") == "1":
            self.skipTest("takes minutes where it is instrumented, and every verb has tests of its own")
        copy = self.path("tilepack")
        shutil.copytree(SOURCE, copy, ignore=lambda folder, names: {
            name for name in names if name in (".git", "build", "made", "out", "__pycache__") or
            (folder == SOURCE and name == "tests")})
        os.makedirs(self.path("bin"))
        shim = self.path("bin/tilepack")
        with open(shim, "w", encoding="utf-8") as stream:
            stream.write(DRAFTS.format(TILEPACK))
        os.chmod(shim, os.stat(shim).st_mode | stat.S_IXUSR)
        environment = {**os.environ, "PATH": self.path("bin") + os.pathsep + os.environ["PATH"]}
        environment.pop("TILEPACK")  # the sample scripts find the program on the path
        blocks = blocks_of(self.readme)
        self.assertGreater(len(blocks), 15)
        told = {}
        for line, block in blocks:
            done = subprocess.run(["sh", "-eu", "-c", block], cwd=copy, env=environment, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, f"README.md:{line}:\n{block}{done.stdout[-3000:]}{done.stderr[-3000:]}")
            told[line] = done.stdout + done.stderr
        rock = next(told[line] for line, block in blocks if "bake samples/rock " in block)
        self.assertRegex(rock, r"quality +good")
        self.assertNotIn("lean by", rock)

    def test_all_other_blocks_that_hold_commands_are_shell(self):
        """What is indented or of no language would not be tried."""
        for found in re.finditer(r"^(?:    |`{3}\n)(tilepack .*)$", self.readme, re.MULTILINE):
            self.fail(f"'{found.group(1)}' stands in no block of sh")


if __name__ == "__main__":
    unittest.main()
