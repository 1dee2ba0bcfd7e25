"""The lookup in WGSL, run by Dawn (the npm package "webgpu") where it is at hand: tiles and texels are those of C.

TILEPACK_WEBGPU names a folder in which `npm install webgpu` was run. Nothing else of this project asks for it, so
these tests are left out where it is not set, also in CI."""

import json
import os
import shutil
import subprocess
import unittest

from shader_case import CELL_OF, PACKS, PLACE_OF, ShaderCase

MODULES = os.environ.get("TILEPACK_WEBGPU", "")
SWIFTSHADER = "/usr/lib/chromium/vk_swiftshader_icd.json"  # Debian's chromium-common; lavapipe lacks what Dawn asks for


def wgsl(text):
    """The formulas that tests share, in WGSL."""
    lines = []
    for line in text.format(word="u32", whole="i32", real="f32").splitlines():
        for kind in ("u32", "i32", "f32"):
            if line.startswith(f"{kind} ") and "(" in line:
                name, rest = line[4:].split("(", 1)
                parameters, body = rest.split(")", 1)
                parameters = ", ".join("{1}: {0}".format(*p.split()) for p in parameters.split(","))
                line = f"fn {name}({parameters}) -> {kind}{body}"
        line = line.replace("  u32 h =", "  var h =").replace("  u32 ", "  let ")
        lines.append(line)
    text = "\n".join(lines)
    return text.replace("h % 400u - 200u", "(h % 400u) - 200u").replace(
        "kind == 0u ? h : (kind == 1u ? near : (kind == 2u ? near + 0x80000000u : near + 0x40000000u))",
        "select(select(select(near + 0x40000000u, near + 0x80000000u, kind == 2u), near, kind == 1u), h, kind == 0u)")


CELLS = wgsl(CELL_OF) + """
@group(0) @binding(0) var<storage, read_write> result: array<u32>;
BINDINGS
@compute @workgroup_size(256) fn main(@builtin(global_invocation_id) at: vec3u) {
  for (var k = 0u; k < 64u; k++) {
    let i = at.x * 64u + k;
    let x = i32(cell_word(FIRSTu + i, 1u));
    let y = i32(cell_word(FIRSTu + i, 2u));
    result[2u * i] = tilepack_tile(IDS x, y);
    result[2u * i + 1u] = tilepack_place(IDS x, y);
  }
}
"""
VALUES = wgsl(CELL_OF) + wgsl(PLACE_OF) + """
@group(0) @binding(0) var<storage, read_write> result: array<vec4f>;
BINDINGS
@compute @workgroup_size(256) fn main(@builtin(global_invocation_id) at: vec3u) {
  let i = at.x;
  let x = place_cell(i, 1u);
  let y = place_cell(i, 2u);
  let fx = place_fraction(i, 1u);
  let fy = place_fraction(i, 2u);
  var level = place_level(i, LEVELSu);
  if (MODE >= 2) { level += 0.25 * f32(i % 4u); }
  result[i] = VALUE;
}
"""
VALUE_OF_MODE = ["tilepack_nearest(TILES, x, y, fx, fy, i32(level))", "tilepack_level(TILES, x, y, fx, fy, level)",
                 "tilepack_level(TILES, x, y, fx, fy, level)", "tilepack_exact(EXACT, x, y, fx, fy, level)",
                 "textureSampleLevel(tiles, state, PLACE, level)"]


@unittest.skipUnless(MODULES and shutil.which("node"), "not run: TILEPACK_WEBGPU names no folder with the npm package webgpu")
class ShaderWgslTest(ShaderCase):
    def run_job(self, text, words, groups, textures=(), samplers=(), repeat=True):
        self.write("program.wgsl", text)
        job = {"modules": os.path.abspath(MODULES), "text": self.path("program.wgsl"), "words": words, "groups": groups,
               "textures": textures, "samplers": samplers, "repeat": repeat, "out": self.path("out.bin")}
        self.write("job.json", json.dumps(job))
        environment = dict(os.environ)
        if os.path.exists(SWIFTSHADER):
            environment.setdefault("VK_ICD_FILENAMES", SWIFTSHADER)
        script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "run_wgsl.mjs")
        done = subprocess.run(["node", script, self.path("job.json")], capture_output=True, text=True, check=False, env=environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(self.path("out.bin"), "rb") as file:
            return file.read()

    def ids_texture(self, pack, binding):
        ids, (width, height) = self.ids_of(pack)
        if not ids:
            return [], ""
        self.write("ids.bin", ids)
        texture = {"binding": binding, "layers": 0, "format": "r16uint",
                   "levels": [{"width": width, "height": height, "file": self.path("ids.bin")}]}
        return [texture], f"@group(0) @binding({binding}) var ids: texture_2d<u32>;\n"

    def wrong(self, pack, text, rounds, expected):
        count, faults = 1 << 20, 0
        for number in range(rounds):
            textures, bindings = self.ids_texture(pack, 1)
            code = CELLS.replace("FIRST", str(number * count)).replace("BINDINGS", bindings)
            code = text + code.replace("IDS", "ids, " if textures else "")
            faults += self.run_job(code, 2 * count, count // (256 * 64), textures) != expected.cells(number * count, count)
        return faults

    def test_ten_million_cells_have_the_tiles_of_c(self):
        for kind in PACKS:
            with self.subTest(kind):
                pack = self.bake(kind)
                self.assertEqual(self.wrong(pack, self.text(pack, "wgsl"), 10 if kind in ("even", "mix") else 1, self.c_lookup(pack)), 0)

    def test_a_wrong_constant_is_noticed(self):
        for kind in ("even", "mix", "permutation"):
            with self.subTest(kind):
                pack = self.bake(kind)
                text = self.text(pack, "wgsl")
                at = text.index("0x") + 9
                changed = text[:at] + ("0" if text[at] != "0" else "1") + text[at + 1:]
                self.assertEqual(self.wrong(pack, changed, 1, self.c_lookup(pack)), 1)

    def stored(self, levels, layers, name):
        """Levels of floats as files of bytes."""
        result = []
        for number, (width, height, data) in enumerate(levels):
            codes = bytes(round(value * 255) for value in memoryview(data).cast("f"))
            file = self.write(f"{name}{number}.bin", codes)
            result.append({"width": width, "height": height // max(layers, 1), "file": self.path(file)})
        return result

    def largest_difference(self, pack, mode, compiled):
        layers, corners = self.layers(pack), self.has_corners(pack)
        levels = self.levels(pack)
        corner_levels = self.levels(pack, corners=True) if corners else None
        use_corners = corners and mode in (1, 2)
        textures = [{"binding": 1, "layers": layers, "format": "rgba8unorm", "levels": self.stored(levels, layers, "tiles")}]
        bindings = f"@group(0) @binding(1) var tiles: texture_2d{'_array' if layers else ''}<f32>;\n"
        if use_corners:
            textures.append({"binding": 2, "layers": 0, "format": "rgba8unorm", "levels": self.stored(corner_levels, 0, "corners")})
            bindings += "@group(0) @binding(2) var corners: texture_2d<f32>;\n"
        more, ids = self.ids_texture(pack, 3) if mode < 4 else ([], "")
        textures += more
        names = ["tiles"] + ["corners"] * use_corners + ["ids"] * bool(more) + ["state"]
        value = VALUE_OF_MODE[mode].replace("TILES", ", ".join(names)).replace("EXACT", ", ".join(n for n in names if n != "corners"))
        value = value.replace("PLACE", "vec2f(fx, fy), 0" if layers else "vec2f(fx, fy)")
        bindings += ids + "@group(0) @binding(4) var state: sampler;\n"
        code = VALUES.replace("BINDINGS", bindings).replace("LEVELS", str(len(levels))).replace("MODE", str(mode))
        found = self.run_job(self.text(pack, "wgsl") + code.replace("VALUE", value), 4 << 16, 256, textures, [4], not layers)
        expected = compiled.values(mode, 1 << 16, levels, max(layers, 1), corner_levels)
        pairs = zip(memoryview(found).cast("f"), memoryview(expected).cast("f"))
        return max(abs(a - b) for i, (a, b) in enumerate(pairs) if i % 4 < 3)

    def test_texels_are_those_of_c_and_filters_err_as_on_a_plain_texture(self):
        for kind in PACKS:
            with self.subTest(kind):
                pack = self.bake(kind)
                compiled = self.c_lookup(pack)
                plain = self.largest_difference(pack, 4, compiled)
                if kind != "rotated":
                    self.assertLess(self.largest_difference(pack, 0, compiled), 1e-6)  # codes are 1/255 apart
                for mode in (1, 2, 3) if kind != "rotated" else (1, 2):
                    self.assertLessEqual(self.largest_difference(pack, mode, compiled), 2 * plain + 2e-5, mode)


if __name__ == "__main__":
    unittest.main()
