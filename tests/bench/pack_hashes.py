"""Bakes and packs the project's samples with many sets of options and prints a hash of each pack, so that two
builds can be held against each other:

    python3 tests/bench/pack_hashes.py build/release/tilepack > after.txt && diff before.txt after.txt
"""

import hashlib
import json
import os
import subprocess
import sys
import tempfile

SAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "samples")
ROCK = ["rock_albedo.png", "--map", "normal=rock_normal.png", "--map", "roughness=rock_roughness.png", "--map",
        "height=rock_height.png"]
SMALL = ["--tile-size", "32", "--effort", "1"]
BAKES = [
    ["pebbles.png"],
    ["pebbles.png", "--effort", "0"],
    ["meadow.png", "--effort", "9", "--tile-size", "64"],
    ["bricks.png", "--tile-size", "auto"],
    ["bricks.png", "--preset", "wall", "--seed", "7"],
    ["planks.png", "--flatten", "100", "--tile-size", "64"],
    ["cracked.png", "--seed", "3", "--colors", "3", "--tile-size", "48"],
    ["meadow.png", "--colors", "4", *SMALL],
    ["pebbles.png", "--coloring", "edge", "--tile-size", "64"],
    ["pebbles.png", "--coloring", "edge", "--interior", "quilt", "--corner-pack", "--tile-size", "64"],
    ["pebbles.png", "--coloring", "edge", "--colors", "2x3", *SMALL],
    ["pebbles.png", "--coloring", "edge", "--colors", "3", "--set", "sequential", "--layout", "rotated", "--scheme", "3,3",
     "--mapping", "index", "--virtual-size", "32", *SMALL],
    ["pebbles.png", "--coloring", "edge", "--colors", "2", "--set", "sequential", "--layout", "rotated", "--mapping", "index",
     "--virtual-size", "16", *SMALL],
    ["pebbles.png", "--layout", "rotated", "--gutter", "2", *SMALL],
    ["pebbles.png", "--layout", "array", "--border", "4", *SMALL],
    ["pebbles.png", "--guard", "4", "--mips", "least-squares", *SMALL],
    ["pebbles.png", "--mips", "corners", *SMALL],
    ["pebbles.png", "--mips", "box", "--mapping", "mix", *SMALL],
    ["pebbles.png", "--mips", "none", "--mapping", "permutation", "--virtual-size", "64x32", *SMALL],
    ["pebbles.png", "--mapping", "index", "--virtual-size", "33x17", *SMALL],
    ["pebbles.png", "--depth", "f16", *SMALL],
    ["pebbles.png", "--depth", "u16", *SMALL],
    ["meadow.png", "--preset", "hero", "--tile-size", "64"],
    ["meadow.png", "--preset", "preview"],
    ["meadow.png", "--preset", "terrain", "--tile-size", "48x64", "--effort", "2"],
    [*ROCK, "--tile-size", "64"],
    [*ROCK, "--coloring", "edge", "--flatten", "50", "--mips", "least-squares", "--jump-weight", "1", *SMALL],
]


def run(*arguments):
    done = subprocess.run(arguments, cwd=SAMPLES, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(arguments)}\n{done.stderr}")


def hash_of(folder):
    total = hashlib.sha256()
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name), "rb") as stream:
            total.update(name.encode() + b"\0" + stream.read())
    return total.hexdigest()[:24]


def main():
    tilepack = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as work:
        pack = os.path.join(work, "pack")
        for options in BAKES:
            run(tilepack, "bake", *options, "-o", pack, "--quiet")
            print(hash_of(pack), "bake", " ".join(options), flush=True)
        run(tilepack, "bake", "pebbles.png", "--mips", "none", "--layout", "array", "--coloring", "edge", *SMALL, "-o", pack, "--quiet")
        stack = os.path.join(pack, "color_0.png")
        with open(os.path.join(pack, "pack.json"), encoding="utf-8") as stream:
            tiles = json.load(stream)["tiles"]
        print(hash_of(pack), "bake array", len(tiles), os.path.getsize(stack))


if __name__ == "__main__":
    main()
