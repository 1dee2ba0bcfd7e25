"""The lookup in GLSL and HLSL as SPIR-V: it is valid, fetches as often as a plain texture, and HLSL, turned into GLSL
again, finds the tiles of C on Mesa's software renderer."""

import os
import re
import shutil
import subprocess
import unittest

import gl_context
from command import SOURCE
from shader_case import CELL_OF, PACKS, ShaderCase, dialect

GLSL = """
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 result;
BINDINGS
void main() { result = VALUE; }
"""
HLSL = """
BINDINGS
float4 main(float2 place : TEXCOORD0) : SV_Target { return VALUE; }
"""
HLSL_CELLS = dialect(CELL_OF) + """
BINDINGS
uint2 main(float4 at : SV_Position) : SV_Target {
  uint i = uint(at.y) * 4096u + uint(at.x);
  int x = int(cell_word(i, 1u)), y = int(cell_word(i, 2u));
  return uint2(tilepack_tile(IDS x, y), tilepack_place(IDS x, y));
}
"""
# Of optimised programs, a twentieth more than they have.
MOST_INSTRUCTIONS = {"even": 335, "mix": 210, "permutation": 180, "index": 82}


class ShaderSpirvTest(ShaderCase):
    def setUp(self):
        super().setUp()
        for tool in ("glslangValidator", "spirv-val", "spirv-dis", "spirv-cross"):
            if not shutil.which(tool):
                self.skip(f"no {tool}")

    def run_tool(self, *arguments):
        done = subprocess.run(arguments, cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, f"{arguments}\n{done.stdout}{done.stderr}")
        return done.stdout

    def spirv(self, text, hlsl):
        """The file of a fragment program."""
        self.write("program.frag", text if hlsl else "#version 450\n" + text)
        self.run_tool("glslangValidator", *(["-D"] if hlsl else []), "-V", "-S", "frag", "-e", "main", "-o", "program.spv", "program.frag")
        self.run_tool("spirv-val", "program.spv")
        return "program.spv"

    def test_what_is_written_for_godot_compiles_as_glsl(self):
        for kind in PACKS:
            if kind in ("index", "rotated"):  # this one has an index map too
                continue
            with self.subTest(kind):
                self.spirv(self.fragment(self.bake(kind), False, "gdshader"), False)

    def test_it_compiles_pasted_after_a_version(self):
        """Of desktops and of GLSL ES, which knows no precision of floats and samplers by itself."""
        with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as file:
            recipe = re.search(r'^    #include "pebbles.glsl".*?\n((?:    .*\n)+)', file.read(), re.MULTILINE).group(1)
        for kind in PACKS:
            pack = self.bake(kind)
            samplers = "sampler2DArray" if self.layers(pack) else "sampler2D"
            more = [("sampler2D", "corners")] * self.has_corners(pack) + [("usampler2D", "ids")] * bool(self.ids_of(pack)[0])
            uniforms = "".join(f"uniform {sampler} {name};\n" for sampler, name in more)
            program = uniforms + recipe.replace("sampler2D", samplers, 1).replace("(pebbles,", "(pebbles, " + "".join(n + ", " for _, n in more))
            for version in ("300 es", "330"):
                with self.subTest(kind, version=version):
                    self.write("program.frag", f"#version {version}\n" + self.text(pack, "glsl") + program)
                    self.run_tool("glslangValidator", "-S", "frag", "program.frag")

    def fragment(self, pack, hlsl, language=None):
        layers, corners, ids = self.layers(pack), self.has_corners(pack), bool(self.ids_of(pack)[0])
        names = ["tiles"] + ["corners"] * corners + ["ids"] * ids
        if hlsl:
            kinds = {"tiles": "Texture2DArray" if layers else "Texture2D", "corners": "Texture2D", "ids": "Texture2D<uint>"}
            bindings = "".join(f"{kinds[n]} {n}_map : register(t{i});\n" for i, n in enumerate(names)) + "SamplerState samples : register(s9);"
            arguments = [n + "_map" for n in names] + ["samples"]
        else:
            kinds = {"tiles": "sampler2DArray" if layers else "sampler2D", "corners": "sampler2D", "ids": "usampler2D"}
            bindings = "".join(f"layout(binding = {i}) uniform {kinds[n]} {n}_map;\n" for i, n in enumerate(names))
            arguments = [n + "_map" for n in names]
        value = f"tilepack_sample({', '.join(arguments)}, place)"
        return self.text(pack, language or ("hlsl" if hlsl else "glsl")) + (HLSL if hlsl else GLSL).replace("BINDINGS", bindings).replace("VALUE", value)

    def test_it_is_valid_and_fetches_no_more_than_a_plain_texture(self):
        for kind in PACKS:
            pack = self.bake(kind)
            for hlsl in (False, True):
                with self.subTest(kind, hlsl=hlsl):
                    self.spirv(self.fragment(pack, hlsl), hlsl)
                    self.run_tool("spirv-opt", "-O", "program.spv", "-o", "small.spv")  # what is not called goes
                    code = self.run_tool("spirv-dis", "small.spv")
                    fetches = len(re.findall(r"= OpImage(Sample|Fetch|Gather)", code))
                    self.assertEqual(fetches, {"corners": 2, "index": 2, "rotated": 2}.get(kind, 1))
                    body = code[code.index("OpFunction "):]
                    count = len(re.findall(r"\bOp(?!Label|Function|SelectionMerge|LoopMerge|Variable|Return)", body))
                    if kind in MOST_INSTRUCTIONS and not hlsl:
                        self.assertLessEqual(count, MOST_INSTRUCTIONS[kind])

    def wrong(self, pack, text, expected):
        """Whether any of 10 485 760 cells has another tile."""
        ids = self.ids_of(pack)[0]
        cells = HLSL_CELLS.replace("BINDINGS", "Texture2D<uint> ids : register(t0);" if ids else "").replace("IDS", "ids," if ids else "")
        self.spirv(text + cells, True)
        glsl = self.run_tool("spirv-cross", "program.spv", "--version", "330", "--no-es", "--no-420pack-extension")
        gl = self.gl
        program = gl.program(glsl.split("\n", 1)[1])
        if ids:
            size = self.ids_of(pack)[1]
            gl.texture(0, [(*size, ids)], internal=gl_context.R16UI, kind=gl_context.RED_INTEGER,
                       component=gl_context.UNSIGNED_SHORT)
        gl.target(4096, 2560)
        self.assertIsNotNone(program)
        return gl.draw() != expected.cells(0, 4096 * 2560)

    gl = None

    def test_hlsl_finds_the_tiles_of_c_and_a_wrong_constant_is_noticed(self):
        if ShaderSpirvTest.gl is None:
            try:
                ShaderSpirvTest.gl = gl_context.Gl()
            except gl_context.GlError as error:
                self.skip(f"OpenGL: {error}")
        for kind in ("even", "mix", "permutation", "index"):
            with self.subTest(kind):
                pack = self.bake(kind)
                expected, text = self.c_lookup(pack), self.text(pack, "hlsl")
                self.assertFalse(self.wrong(pack, text, expected))
                if kind == "mix":
                    at = text.index("0x") + 9
                    self.assertTrue(self.wrong(pack, text[:at] + ("0" if text[at] != "0" else "1") + text[at + 1:], expected))


if __name__ == "__main__":
    unittest.main()
