"""The lookup in TSL, run by three.js and Dawn where both are at hand: tiles and texels are those of C.

TILEPACK_WEBGPU names a folder in which `npm install webgpu three` was run; without it these tests are left out, also in CI."""

import json
import os
import shutil
import subprocess
import unittest

from shader_case import ShaderCase
from shader_wgsl_test import SWIFTSHADER

MODULES = os.environ.get("TILEPACK_WEBGPU", "")


@unittest.skipUnless(os.path.isdir(os.path.join(MODULES, "node_modules", "three")) and shutil.which("node"),
                     "not run: TILEPACK_WEBGPU names no folder with the npm packages webgpu and three")
class ShaderTslTest(ShaderCase):
    def run_job(self, text, mode, first=0, levels=()):
        # Modules are looked for beside the file that asks for them.
        if not os.path.islink(self.path("node_modules")):
            os.symlink(os.path.join(os.path.abspath(MODULES), "node_modules"), self.path("node_modules"))
        shutil.copy(os.path.join(os.path.dirname(os.path.abspath(__file__)), "run_tsl.mjs"), self.path("run_tsl.mjs"))
        self.write("lookup.mjs", text)
        job = {"modules": os.path.abspath(MODULES), "module": self.path("lookup.mjs"), "out": self.path("out.bin"), "first": first, "mode": mode,
               "levels": levels}
        self.write("job.json", json.dumps(job))
        environment = dict(os.environ)
        if os.path.exists(SWIFTSHADER):
            environment.setdefault("VK_ICD_FILENAMES", SWIFTSHADER)
        done = subprocess.run(["node", self.path("run_tsl.mjs"), self.path("job.json")], capture_output=True, text=True, check=False, env=environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(self.path("out.bin"), "rb") as file:
            return file.read()

    def wrong(self, pack, text, rounds, expected):
        count = 1 << 20
        return sum(self.run_job(text, -1, number * count) != expected.cells(number * count, count) for number in range(rounds))

    def test_ten_million_cells_have_the_tiles_of_c_and_a_wrong_constant_is_noticed(self):
        for kind, rounds in (("even", 4), ("mix", 4), ("permutation", 2)):
            with self.subTest(kind):
                pack = self.bake(kind)
                expected, text = self.c_lookup(pack), self.text(pack, "tsl")
                self.assertEqual(self.wrong(pack, text, rounds, expected), 0)
                at = text.index("0x") + 9
                self.assertEqual(self.wrong(pack, text[:at] + ("0" if text[at] != "0" else "1") + text[at + 1:], 1, expected), 1)

    def test_texels_are_those_of_c(self):
        for kind in ("even", "mix"):
            with self.subTest(kind):
                pack = self.bake(kind)
                compiled, levels = self.c_lookup(pack), self.levels(pack)
                stored = []
                for number, (width, height, data) in enumerate(levels):
                    codes = bytes(round(value * 255) for value in memoryview(data).cast("f"))
                    stored.append({"width": width, "height": height, "file": self.path(self.write(f"tiles{number}.bin", codes))})
                for mode, allowed in ((0, 1e-6), (1, 0.005), (2, 0.005), (3, 0.005)):  # 8-bit weights of SwiftShader
                    found = memoryview(self.run_job(self.text(pack, "tsl"), mode, 0, stored)).cast("f")
                    expected = memoryview(compiled.values(mode, 1 << 16, levels, 1, None)).cast("f")
                    self.assertLessEqual(max(abs(a - b) for i, (a, b) in enumerate(zip(found, expected)) if i % 4 < 3), allowed, mode)


if __name__ == "__main__":
    unittest.main()
