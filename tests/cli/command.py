"""What the tests of the command line share: a case with a folder of its own, and writers of test images."""

import json
import os
import random
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib

TILEPACK = os.environ["TILEPACK"]
SOURCE = os.environ["TILEPACK_SOURCE"]


class CommandCase(unittest.TestCase):
    """Runs tilepack in a temporary folder, which is the current one of every run."""

    program = TILEPACK

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="tilepack_test_")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def skip(self, why):
        """For what this machine does not let be tested; fails where CI=true promises that all is tested."""
        if os.environ.get("CI") == "true":
            self.fail("not tested, which CI has to: " + why)
        self.skipTest(why)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def run_tilepack(self, *arguments, code=0, **options):
        """The finished process; its exit code must be `code`, and errors must be one line."""
        command = [self.program, *map(str, arguments)]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, **options)
        # The leak sanitizer fails now and then while threads of libraries end, after the program's own work: it is asked once more.
        if "LeakSanitizer has encountered a fatal error" in done.stderr:
            done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, **options)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}{done.stderr}")
        if code:
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            self.assertEqual(done.stdout, "") if code != 5 else None
        return done

    def refused(self, *arguments, code, saying=(), **options):
        """Expects a failure whose message holds every text of `saying`, and a folder left as it was."""
        before = self.contents()
        message = self.run_tilepack(*arguments, code=code, **options).stderr
        for text in [saying] if isinstance(saying, str) else saying:
            self.assertIn(text, message)
        self.assertEqual(self.contents(), before, "something was left behind or changed")
        return message

    def contents(self, below="."):
        """Every file below a folder with its bytes, and every folder."""
        all_files = {}
        for folder, folders, files in os.walk(self.path(below)):
            for name in folders:
                all_files[os.path.relpath(os.path.join(folder, name), self.path(below))] = None
            for name in files:
                file = os.path.join(folder, name)
                with open(file, "rb") as stream:
                    all_files[os.path.relpath(file, self.path(below))] = stream.read()
        return all_files

    def write(self, name, data):
        with open(self.path(name), "wb") as stream:
            stream.write(data if isinstance(data, bytes) else data.encode())
        return name

    def noise_png(self, name, width=64, height=64, channels=3, bits=8, seed=1):
        """A PNG of smooth noise, written without any library; returns its name."""
        return self.write(name, noise_png(width, height, channels, bits, seed))

    def read_json(self, name):
        with open(self.path(name), encoding="utf-8") as stream:
            return json.load(stream)

    def write_json(self, name, value):
        return self.write(name, json.dumps(value))


def noise_png(width, height, channels, bits, seed):
    source = random.Random(seed)
    top = (1 << bits) - 1
    # Values of a coarse grid repeated, so that there is something to match.
    cells = [[[source.randint(0, top) for _ in range(channels)] for _ in range(width // 4 + 1)]
             for _ in range(height // 4 + 1)]
    rows = bytearray()
    for y in range(height):
        rows.append(0)
        for x in range(width):
            for value in cells[y // 4][x // 4]:
                value = (value + (x * 7 + y * 13) % 5) % (top + 1)
                rows += value.to_bytes(bits // 8, "big")
    color_type = {1: 0, 2: 4, 3: 2, 4: 6}[channels]

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, bits, color_type, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 1)) +
            chunk(b"IEND", b""))


def float_exr(width, height, value_at):
    """An uncompressed OpenEXR file of one channel Y of floats; value_at(x, y) gives them."""

    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data

    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"Y\0" + struct.pack("<iB3xii", 2, 0, 1, 1) + b"\0"
    header = struct.pack("<II", 20000630, 2)
    header += attribute(b"channels", b"chlist", channels)
    header += attribute(b"compression", b"compression", b"\0")
    header += attribute(b"dataWindow", b"box2i", box)
    header += attribute(b"displayWindow", b"box2i", box)
    header += attribute(b"lineOrder", b"lineOrder", b"\0")
    header += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1.0))
    header += attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0.0, 0.0))
    header += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1.0))
    header += b"\0"
    first = len(header) + 8 * height
    line_bytes = 8 + 4 * width
    offsets = b"".join(struct.pack("<Q", first + y * line_bytes) for y in range(height))
    lines = b"".join(
        struct.pack("<iI", y, 4 * width) + struct.pack(f"<{width}f", *(value_at(x, y) for x in range(width)))
        for y in range(height))
    return header + offsets + lines
