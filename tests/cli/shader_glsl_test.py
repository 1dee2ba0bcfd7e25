"""The lookup in GLSL, run on Mesa's software renderer: tiles and texels are those of C."""

import unittest

import gl_context
from shader_case import CELL_OF, PACKS, PLACE_OF, ShaderCase, dialect

SIDE = 1024  # pixels of a picture: 2^20 cells
CELLS = dialect(CELL_OF) + """
out uvec2 result;
uniform uint first;
void main() {
  uint i = first + uint(gl_FragCoord.y) * 1024u + uint(gl_FragCoord.x);
  int x = int(cell_word(i, 1u)), y = int(cell_word(i, 2u));
  result = uvec2(tilepack_tile(IDS x, y), tilepack_place(IDS x, y));
}
"""
VALUES = dialect(CELL_OF + PLACE_OF) + """
out vec4 result;
void main() {
  uint i = uint(gl_FragCoord.y) * 256u + uint(gl_FragCoord.x);
  int x = place_cell(i, 1u), y = place_cell(i, 2u);
  float fx = place_fraction(i, 1u), fy = place_fraction(i, 2u), level = place_level(i, LEVELSu);
  if (MODE >= 2) level += 0.25 * float(i % 4u);
  result = VALUE;
}
"""
VALUE_OF_MODE = ["tilepack_nearest(tiles, IDS x, y, fx, fy, int(level))", "tilepack_level(tiles, CORNERS IDS x, y, fx, fy, level)",
                 "tilepack_level(tiles, CORNERS IDS x, y, fx, fy, level)", "tilepack_exact(tiles, IDS x, y, fx, fy, level)",
                 "textureLod(tiles, PLACE, level)"]


class ShaderGlslTest(ShaderCase):
    gl = None

    def setUp(self):
        super().setUp()
        if ShaderGlslTest.gl is None:
            try:
                ShaderGlslTest.gl = gl_context.Gl()
            except gl_context.GlError as error:
                self.skip(f"OpenGL: {error}")

    def wrong(self, text, pack, rounds, expected):
        """How many rounds of 2^20 cells differ."""
        ids, _ = self.ids_of(pack)
        text += ("uniform usampler2D ids;" if ids else "") + CELLS.replace("IDS", "ids," if ids else "")
        program = self.gl.program(text)
        self.bind_ids(program, pack)
        self.gl.target(SIDE, SIDE)
        count, faults = SIDE * SIDE, 0
        for number in range(rounds):
            self.gl.uniform(program, "first", number * count)
            faults += self.gl.draw() != expected.cells(number * count, count)
        return faults

    def bind_ids(self, program, pack):
        ids, size = self.ids_of(pack)
        if ids:
            self.gl.texture(2, [(*size, ids)], internal=gl_context.R16UI, kind=gl_context.RED_INTEGER,
                            component=gl_context.UNSIGNED_SHORT)
            self.gl.uniform(program, "ids", 2)

    def largest_difference(self, pack, mode, compiled):
        """Between C and OpenGL, over 2^16 places."""
        text, layers = self.text(pack, "glsl"), self.layers(pack)
        corners = self.has_corners(pack)
        levels = self.levels(pack)
        corner_levels = self.levels(pack, corners=True) if corners else None
        uniforms = f"uniform {'sampler2DArray' if layers else 'sampler2D'} tiles;\n"
        uniforms += "uniform sampler2D corners;\n" if corners else ""
        uniforms += "uniform usampler2D ids;\n" if self.ids_of(pack)[0] else ""
        value = VALUE_OF_MODE[mode].replace("CORNERS", "corners," if corners else "").replace("IDS", "ids," if self.ids_of(pack)[0] else "")
        value = value.replace("PLACE", "vec3(fx, fy, 0.0)" if layers else "vec2(fx, fy)")
        program = self.gl.program(text + uniforms + VALUES.replace("LEVELS", str(len(levels))).replace("MODE", str(mode)).replace("VALUE", value))
        linear = mode > 0
        self.gl.texture(0, [(w, h // max(layers, 1), data) for w, h, data in levels], layers, linear=linear, repeat=not layers)
        self.gl.uniform(program, "tiles", 0)
        if corners:
            self.gl.texture(1, corner_levels, linear=linear)
            self.gl.uniform(program, "corners", 1)
        self.bind_ids(program, pack)
        self.gl.target(256, 256, gl_context.RGBA32F)
        found = memoryview(self.gl.draw()).cast("f")
        expected = memoryview(compiled.values(mode, 256 * 256, levels, max(layers, 1), corner_levels)).cast("f")
        return max(abs(a - b) for a, b in zip(found, expected))

    def test_texels_are_those_of_c_and_filters_err_as_on_a_plain_texture(self):
        for kind in PACKS:
            with self.subTest(kind):
                pack = self.bake(kind)
                compiled = self.c_lookup(pack)
                plain = self.largest_difference(pack, 4, compiled)
                if kind != "rotated":  # there a float finds another texel where two are equally near
                    self.assertEqual(self.largest_difference(pack, 0, compiled), 0)
                for mode in (1, 2, 3) if kind != "rotated" else (1, 2):
                    self.assertLessEqual(self.largest_difference(pack, mode, compiled), 2 * plain + 2e-5, mode)

    def test_ten_million_cells_have_the_tiles_of_c(self):
        for kind in PACKS:
            with self.subTest(kind):
                pack = self.bake(kind)
                rounds = 10 if kind in ("even", "mix") else 1
                self.assertEqual(self.wrong(self.text(pack, "glsl"), pack, rounds, self.c_lookup(pack)), 0)

    def test_a_wrong_constant_is_noticed(self):
        for kind in ("even", "mix", "permutation"):
            with self.subTest(kind):
                pack = self.bake(kind)
                text = self.text(pack, "glsl")
                at = text.index("0x") + 9  # the last digit of the first constant
                changed = text[:at] + ("0" if text[at] != "0" else "1") + text[at + 1:]
                self.assertEqual(self.wrong(changed, pack, 1, self.c_lookup(pack)), 1)


if __name__ == "__main__":
    unittest.main()
