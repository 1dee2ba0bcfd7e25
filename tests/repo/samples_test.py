"""The images of samples/ are what samples/generator makes, texel for texel."""
import os
import pathlib
import subprocess
import tempfile
import unittest

TILEPACK = os.environ["TILEPACK"]
MAKE_SAMPLES = os.environ["MAKE_SAMPLES"]
SAMPLES = pathlib.Path(os.environ["TILEPACK_SOURCE"]) / "samples"
# The sanitized build is slow: one subject tells whether the arithmetic is sound.
SUBJECTS = ["cracked"] if os.environ.get("TILEPACK_SANITIZED") == "1" else []


class Samples(unittest.TestCase):
    def test_the_generator_makes_the_committed_images(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([MAKE_SAMPLES, folder, *SUBJECTS], check=True)
            made = sorted(pathlib.Path(folder).iterdir())
            expected = {"cracked.png"} if SUBJECTS else {path.name for path in SAMPLES.glob("*.png")}
            self.assertEqual({path.name for path in made}, expected)
            for path in made:
                # How they are compressed is no matter of theirs.
                same = subprocess.run([TILEPACK, "compare", path, SAMPLES / path.name], capture_output=True, text=True)
                self.assertEqual(same.returncode, 0, f"{path.name}\n{same.stdout}{same.stderr}")

    def test_without_a_folder_it_says_how_it_is_used(self):
        result = subprocess.run([MAKE_SAMPLES], capture_output=True, text=True)
        self.assertEqual(result.returncode, 1)
        self.assertIn("usage: make_samples FOLDER", result.stderr)


if __name__ == "__main__":
    unittest.main()
