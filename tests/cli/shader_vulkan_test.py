"""The lookup as SPIR-V, made of GLSL, HLSL and Godot's language (read as GLSL), run on lavapipe: tiles and texels are those of C."""

import os
import shutil
import subprocess
import unittest
from operator import sub

from shader_case import CELL_OF, PACKS, PLACE_OF, ShaderCase, dialect

WIDTH, HEIGHT, FEW = 4096, 2560, 128  # 10 485 760 cells; rows of a picture where half a million will do
LANGUAGES = ("glsl", "hlsl", "gdshader")
TRIANGLE = """#version 450
void main() { gl_Position = vec4(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0, 0.0, 1.0); }
"""
CELLS = """
$MAIN {
  uint i = uint($AT.y) * 4096u + uint($AT.x);
  int x = int(cell_word(i, 1u)), y = int(cell_word(i, 2u));
  $RESULT($WORDS(tilepack_tile($IDS x, y), tilepack_place($IDS x, y)));
}
"""
# Bands of 256 rows: 0 nearest, 1 a whole level, 2 between levels, 3 the plain texture.
VALUES = """
$MAIN {
  uint band = uint($AT.y) / 256u, i = uint($AT.y) % 256u * 256u + uint($AT.x);
  int x = place_cell(i, 1u), y = place_cell(i, 2u);
  float fx = place_fraction(i, 1u), fy = place_fraction(i, 2u), whole = place_level(i, $LEVELSu), level = whole;
  if (band >= 2u) level += 0.25 * float(i % 4u);
  $FOUR value = $PLAIN;
  if (band == 0u) value = tilepack_nearest($TILES, $IDS $STATE x, y, fx, fy, int(whole));
  if (band == 1u || band == 2u) value = tilepack_level($TILES, $CORNERS $IDS $STATE x, y, fx, fy, level);
  $RESULT(value);
}
"""
MODE_OF_C = (0, 1, 2, 4)  # of each band


class ShaderVulkanTest(ShaderCase):
    def setUp(self):
        super().setUp()
        for tool in ("glslangValidator", "spirv-val", "cc"):
            if not shutil.which(tool):
                self.skip(f"no {tool}")
        source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "run_spirv.c")
        built = subprocess.run(["cc", "-std=c99", "-O1", "-o", self.path("run_spirv"), source, "-lvulkan"], capture_output=True, text=True, check=False)
        if built.returncode:
            self.skip("no libvulkan-dev: " + built.stderr.strip()[-200:])
        self.write("triangle.vert", TRIANGLE)
        self.run_tool("glslangValidator", "-V", "-o", "triangle.spv", "triangle.vert")

    def run_tool(self, *arguments):
        environment = dict(os.environ)
        lavapipe = "/usr/share/vulkan/icd.d/lvp_icd.x86_64.json"
        if os.path.exists(lavapipe):
            environment.setdefault("VK_ICD_FILENAMES", lavapipe)
        done = subprocess.run(arguments, cwd=self.folder, capture_output=True, text=True, check=False, env=environment)
        if done.returncode == 2 and arguments[0].endswith("run_spirv"):
            self.skip(done.stderr)
        self.assertEqual(done.returncode, 0, f"{arguments}\n{done.stdout[-4000:]}{done.stderr[-4000:]}")

    def draw(self, pack, language, text, body, size, words, levels=(), linear=False):
        """The bytes of a picture by `body`, which finds the functions of `text`."""
        hlsl, layers, corners, ids = language == "hlsl", self.layers(pack), self.has_corners(pack), self.ids_of(pack)
        kind = {"tiles": "Texture2DArray" if layers else "Texture2D", "corners": "Texture2D", "ids": "Texture2D<uint>"} if hlsl else \
               {"tiles": "sampler2DArray" if layers else "sampler2D", "corners": "sampler2D", "ids": "usampler2D"}
        bound = ["tiles"] + ["corners"] * corners + ["ids"] * bool(ids[0])
        if hlsl:
            bindings = "".join(f"{kind[name]} {name}_map : register(t{20 + i});\n" for i, name in enumerate(bound)) + "SamplerState samples : register(s19);\n"
            head, at, result, of_words = "", "at", "return ", "uint2"
            main = f"{'uint2' if words else 'float4'} main(float4 at : SV_Position) : SV_Target"
        else:
            bindings = "".join(f"layout(binding = {i}) uniform {kind[name]} {name}_map;\n" for i, name in enumerate(bound))
            bindings += f"layout(location = 0) out {'uvec2' if words else 'vec4'} result;\n"
            head, at, result, of_words, main = "#version 450\n", "gl_FragCoord", "result = ", "uvec2", "void main()"
        state = "samples," if hlsl else ""
        for name, put in (("MAIN", main), ("RESULT", result), ("WORDS", of_words), ("AT", at), ("TILES", "tiles_map"), ("CORNERS", "corners_map," * corners),
                          ("IDS", "ids_map," * bool(ids[0])), ("STATE", state)):
            body = body.replace("$" + name, put)
        self.write("program.frag", head + text + bindings + dialect(CELL_OF + PLACE_OF) + body)
        self.run_tool("glslangValidator", *(["-D"] if hlsl else []), "-V", "-S", "frag", "-e", "main", "-o", "program.spv", "program.frag")
        self.run_tool("spirv-val", "program.spv")
        textures = []
        for number, name in enumerate(bound):
            file = self.write(f"{name}.bin", ids[0] if name == "ids" else b"".join(data for _, _, data in levels[name]))
            sizes = [ids[1]] if name == "ids" else [(w, h // max(layers, 1) if name == "tiles" else h) for w, h, _ in levels[name]]
            textures.append(",".join([str(number), file, "ids" if name == "ids" else "texels", "linear" if linear and name != "ids" else "nearest",
                                      "clamp" if layers and name == "tiles" else "repeat", str(layers if name == "tiles" else 0)] +
                                     [f"{w}x{h}" for w, h in sizes]))
        self.run_tool("./run_spirv", "program.spv", str(size[0]), str(size[1]), "words" if words else "floats", "out.bin", *textures)
        with open(self.path("out.bin"), "rb") as file:
            return file.read()

    def languages(self, pack):
        index = bool(self.ids_of(pack)[0])
        return [language for language in LANGUAGES if not (index and language == "gdshader")]

    def tiny_levels(self, pack):
        texel = [(1, max(self.layers(pack), 1), bytes(16 * max(self.layers(pack), 1)))]
        return {"tiles": texel, "corners": [(1, 1, bytes(16))]}

    def wrong(self, pack, language, text, expected, rows):
        return self.draw(pack, language, text, CELLS, (WIDTH, rows), True, self.tiny_levels(pack)) != expected

    def test_ten_million_cells_have_the_tiles_of_c(self):
        for kind in PACKS:
            pack, rows = self.bake(kind), HEIGHT if kind in ("even", "mix") else FEW
            expected = self.c_lookup(pack).cells(0, WIDTH * rows)
            for language in self.languages(pack):
                with self.subTest(kind, language=language):
                    self.assertFalse(self.wrong(pack, language, self.text(pack, language), expected, rows))

    def test_a_wrong_constant_is_noticed(self):
        for kind in ("even", "permutation"):
            pack = self.bake(kind)
            expected = self.c_lookup(pack).cells(0, WIDTH * FEW)
            for language in self.languages(pack):
                with self.subTest(kind, language=language):
                    text = self.text(pack, language)
                    at = text.index("0x") + 9  # the last digit of the first constant
                    changed = text[:at] + ("0" if text[at] != "0" else "1") + text[at + 1:]
                    self.assertTrue(self.wrong(pack, language, changed, expected, FEW))

    def test_texels_are_those_of_c_and_filters_err_as_on_a_plain_texture(self):
        for kind in PACKS:
            if kind in ("even", "even3", "full"):  # lavapipe compiles its table beside a sampler for a minute, as exact lookups
                continue
            pack = self.bake(kind)
            compiled, layers = self.c_lookup(pack), self.layers(pack)
            levels = {"tiles": self.levels(pack)}
            if self.has_corners(pack):
                levels["corners"] = self.levels(pack, corners=True)
            bands = range(len(MODE_OF_C))
            expected = [memoryview(compiled.values(MODE_OF_C[band], 1 << 16, levels["tiles"], max(layers, 1), levels.get("corners"))).cast("f") for band in bands]
            for language in self.languages(pack):
                with self.subTest(kind, language=language):
                    hlsl = language == "hlsl"
                    place = ("float" if hlsl else "vec") + ("3(fx, fy, 0.0)" if layers else "2(fx, fy)")
                    body = VALUES.replace("$LEVELS", str(len(levels["tiles"])))
                    body = body.replace("$PLAIN", f"$TILES.SampleLevel(samples, {place}, level)" if hlsl else f"textureLod($TILES, {place}, level)")
                    body = body.replace("$FOUR", "float4" if hlsl else "vec4")
                    found = memoryview(self.draw(pack, language, self.text(pack, language), body, (256, 256 * len(bands)), False, levels, True)).cast("f")
                    off = [max(map(abs, map(sub, found[band << 18:(band + 1) << 18], expected[band]))) for band in bands]
                    if kind != "rotated":  # there a float finds another texel where two are equally near
                        self.assertEqual(off[0], 0)
                    self.assertLessEqual(max(off[1:]), 2 * off[3] + 2e-5, off)


if __name__ == "__main__":
    unittest.main()
