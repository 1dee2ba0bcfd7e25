"""Bakes the images of a folder with random options for a time, and validates what comes out.

    TILEPACK=build/release/tilepack python3 tests/fuzz/soak.py FOLDER MINUTES [SEED]

A bake may end well, and then its pack must be valid and readable, or refuse its options (exit codes 1 and 3) with one line; anything else
is a failure, whose command is printed, and the exit code is then 1.
"""

import os
import random
import shlex
import subprocess
import sys
import tempfile
import time

TILEPACK = os.path.abspath(os.environ.get("TILEPACK", "build/release/tilepack"))
ENDINGS = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr", ".tga", ".bmp", ".webp", ".hdr")
LONGEST = 600  # seconds a bake may take


def options(chance):
    """A few options at random, of any value that the help allows, so that many do not go together."""
    choices = {
        "--tile-size": lambda: chance.choice(["auto", f"{chance.randint(4, 96)}x{chance.randint(4, 96)}", str(chance.randint(4, 160))]),
        "--flatten": lambda: str(chance.randint(0, 100)),
        "--coloring": lambda: chance.choice(["edge", "corner"]),
        "--colors": lambda: chance.choice(["1", "2", "3", "2x3", "1x2", "4"]),
        "--set": lambda: chance.choice(["complete", "sequential"]),
        "--interior": lambda: chance.choice(["patch", "quilt"]),
        "--guard": lambda: str(chance.choice([0, 0, 1, 2, 4, 8])),
        "--effort": lambda: str(chance.choice([0, 0, 0, 1, 2, 5])),
        "--seed": lambda: str(chance.randint(0, 2**53 - 1)),
        "--layout": lambda: chance.choice(["tile-index", "de-bruijn", "rotated", "array"]),
        "--gutter": lambda: str(chance.randint(0, 8)),
        "--turn-filter": lambda: chance.choice(["bilinear", "bicubic", "lanczos"]),
        "--border": lambda: str(chance.choice([0, 1, 2, 4])),
        "--mips": lambda: chance.choice(["none", "box", "edges", "corners", "least-squares"]),
        "--jump-weight": lambda: str(chance.randint(0, 1000)),
        "--alpha-coverage": lambda: str(chance.randint(0, 100)),
        "--mapping": lambda: chance.choice(["even", "permutation", "mix", "index"]),
        "--virtual-size": lambda: str(chance.choice([1, 3, 16, 64])),
        "--format": lambda: chance.choice(["png", "exr"]),
        "--depth": lambda: chance.choice(["u8", "u16", "f16", "f32"]),
        "--corner-pack": None, "--power-of-two": None,
    }
    words = ["--effort", "0"]
    for name in chance.sample(sorted(choices), chance.randint(0, 7)):
        words += [name] if choices[name] is None else [name, choices[name]()]
    return words


def failure(words, allowed):
    """What is wrong with how a command ended; none if it ended as it may. Its exit code too."""
    try:
        done = subprocess.run(words, capture_output=True, text=True, timeout=LONGEST, check=False)
    except subprocess.TimeoutExpired:
        return f"took longer than {LONGEST} s", None
    if done.returncode not in allowed:
        return f"ended with {done.returncode}: {done.stderr.strip()[-400:]}", done.returncode
    if done.returncode and done.stderr.count("\n") != 1:
        return f"told more than a line: {done.stderr[-400:]}", done.returncode
    return None, done.returncode


def main():
    if len(sys.argv) < 3:
        print(__doc__)
        return 1
    folder, end = sys.argv[1], time.monotonic() + 60 * float(sys.argv[2])
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else random.randrange(2**32)
    chance = random.Random(seed)
    images = sorted(os.path.join(at, name) for at, _, names in os.walk(folder) for name in names if name.lower().endswith(ENDINGS))
    if not images:
        print(f"{folder} holds no image")
        return 1
    counts = {"baked": 0, "refused": 0}
    with tempfile.TemporaryDirectory() as scratch:
        while time.monotonic() < end:
            pack = os.path.join(scratch, f"{counts['baked']}.pack")
            bake = [TILEPACK, "bake", chance.choice(images), "-o", pack, "-q", *options(chance)]
            for words, allowed in ((bake, (0, 1, 3)), ([TILEPACK, "validate", pack], (0,)), ([TILEPACK, "inspect", pack], (0,))):
                wrong, code = failure(words, allowed)
                if wrong:
                    print(f"soak: {' '.join(map(shlex.quote, words))}\n  {wrong}\nafter: {' '.join(map(shlex.quote, bake))}\nseed {seed}")
                    return 1
                if words is bake:
                    counts["refused" if code else "baked"] += 1
                if code:
                    break
            subprocess.run(["rm", "-rf", pack], check=True)
    print(f"soak: {counts['baked']} packs baked and valid, {counts['refused']} bakes refused, nothing wrong (seed {seed})")
    return 0


if __name__ == "__main__":
    sys.exit(main())
