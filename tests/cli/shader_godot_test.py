"""What is written for Godot 4, run in Godot 3.2 (Debian's godot3-runner) under Xvfb: tiles and texels are those of C.

Godot 3.2 has no unsigned literals and no constant arrays outside of functions: both are put in other words here, nothing else is
changed. Where the packages are missing these tests are left out, also in CI."""

import os
import re
import shutil
import subprocess
import unittest

from shader_case import CELL_OF, PLACE_OF, ShaderCase, dialect

SIDE = 1024  # of a picture of cells; 256 of texels
PROJECT = """config_version=4
[application]
config/name="lookup"
run/main_scene="res://main.tscn"
[rendering]
quality/driver/driver_name="GLES3"
quality/driver/fallback_to_gles2=false
"""
SCENE = """[gd_scene load_steps=2 format=2]
[ext_resource path="res://main.gd" type="Script" id=1]
[node name="Main" type="Node"]
script = ExtResource( 1 )
"""
# Draws the shader into a viewport of 8 bits as often as asked, `turn` counting up, and writes the pictures one after another.
SCRIPT = """extends Node

func read(name):
	var file = File.new()
	file.open("res://" + name, File.READ)
	var data = file.get_buffer(file.get_len())
	file.close()
	return data

func _ready():
	var job = parse_json(read("job.json").get_string_from_utf8())
	var view = Viewport.new()
	view.size = Vector2(job.side, job.side)
	view.usage = Viewport.USAGE_2D
	view.render_target_update_mode = Viewport.UPDATE_ALWAYS
	view.render_target_v_flip = true
	view.hdr = false
	view.disable_3d = true
	add_child(view)
	var shader = Shader.new()
	shader.code = read("shader.txt").get_string_from_utf8()
	var material = ShaderMaterial.new()
	material.shader = shader
	if job.texture > 0:
		var image = Image.new()
		image.create_from_data(job.texture, job.texture, true, Image.FORMAT_RGBAF, read("texture.bin"))
		var texture = ImageTexture.new()
		texture.create_from_image(image, Texture.FLAG_MIPMAPS | Texture.FLAG_REPEAT | Texture.FLAG_FILTER)
		material.set_shader_param("tiles_map", texture)
	var rect = ColorRect.new()
	rect.rect_size = view.size
	rect.material = material
	view.add_child(rect)
	var out = File.new()
	out.open("res://out.bin", File.WRITE)
	for turn in range(job.turns):
		material.set_shader_param("turn", turn)
		for i in range(3):
			yield(VisualServer, "frame_post_draw")
		var image = view.get_texture().get_data()
		image.convert(Image.FORMAT_RGBA8)
		out.store_buffer(image.get_data())
	out.close()
	get_tree().quit()
"""
CELLS = """
void fragment() {
  uint i = uint(turn) * 1048576u + uint(floor(UV.y * 1024.0)) * 1024u + uint(floor(UV.x * 1024.0));
  int x = int(cell_word(i, 1u)), y = int(cell_word(i, 2u));
  uint id = tilepack_tile(x, y), place = tilepack_place(x, y);
  COLOR = vec4(float(id & 255u), float(id >> 8u), float((place & 15u) | (place >> 16u) << 4u), 255.0) / 255.0;
}
"""
VALUES = """
void fragment() {
  uint i = uint(floor(UV.y * 256.0)) * 256u + uint(floor(UV.x * 256.0));
  int x = place_cell(i, 1u), y = place_cell(i, 2u);
  float fx = place_fraction(i, 1u), fy = place_fraction(i, 2u), level = place_level(i, LEVELSu);
  vec4 value = vec4(0.0);
  if (turn == 0) { value = tilepack_nearest(tiles_map, x, y, fx, fy, int(level)); }
  if (turn == 1) { value = tilepack_level(tiles_map, x, y, fx, fy, level); }
  if (turn == 2) { value = tilepack_level(tiles_map, x, y, fx, fy, level + 0.25 * float(i % 4u)); }
  if (turn == 3) { value = tilepack_exact(tiles_map, x, y, fx, fy, level + 0.25 * float(i % 4u)); }
  COLOR = vec4(value.rgb, 1.0);
}
"""


def older(text):
    """Godot 4's language in the words of 3.2."""
    def literal(match):
        value = int(match.group(1), 0)
        return f"uint({value})" if value < 1 << 31 else f"(~uint({value ^ 0xffffffff}))"
    text = re.sub(r"\b(0x[0-9a-f]+|\d+)u\b", literal, re.sub(r"//.*", "", text))
    for whole, name, count, entries in re.findall(r"(const uint (\w+)\[(\d+)\] = (\{.*?\});)", text, re.DOTALL):
        text = text.replace(whole, f"uint {name}_at(int i) {{ uint entries[{count}] = {entries}; return entries[i]; }}")
        text = re.sub(name + r"\[([^\]]*)\]", name + r"_at(int(\1))", text)
    return text


@unittest.skipUnless(shutil.which("godot3-runner") and shutil.which("xvfb-run") and shutil.which("xauth"),
                     "not run: no godot3-runner and xvfb")
class ShaderGodotTest(ShaderCase):
    def draw(self, text, body, side, turns, levels=()):
        """The pictures, 4 bytes a pixel."""
        for name, data in (("project.godot", PROJECT), ("main.tscn", SCENE), ("main.gd", SCRIPT)):
            self.write(name, data)
        head = "shader_type canvas_item;\nrender_mode blend_disabled;\nuniform int turn;\n" + ("uniform sampler2D tiles_map;\n" if levels else "")
        self.write("shader.txt", head + older(text + dialect(CELL_OF + PLACE_OF) + body))
        self.write("texture.bin", b"".join(data for _, _, data in levels))
        self.write("job.json", f'{{"side": {side}, "turns": {turns}, "texture": {levels[0][0] if levels else 0}}}')
        environment = dict(os.environ, LIBGL_ALWAYS_SOFTWARE="1", HOME=self.folder, LANG="en_US.UTF-8")
        done = subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 320x240x24", "godot3-runner", "--path", self.folder, "--audio-driver", "Dummy"],
                              capture_output=True, text=True, check=False, env=environment, timeout=600)
        with open(self.path("out.bin"), "rb") as file:
            data = file.read()
        self.assertEqual(len(data), 4 * side * side * turns, done.stdout[-3000:] + done.stderr[-3000:])
        return data

    def wrong(self, text, expected, turns):
        data = self.draw(text, CELLS, SIDE, turns)
        faults = 0
        for turn in range(turns):
            cells = expected.cells(turn * SIDE * SIDE, SIDE * SIDE)
            part = data[4 * SIDE * SIDE * turn:4 * SIDE * SIDE * (turn + 1)]
            places = bytes(column | row << 4 for column, row in zip(cells[4::8], cells[6::8]))
            faults += (part[0::4], part[1::4], part[2::4]) != (cells[0::8], cells[1::8], places)
        return faults

    def test_ten_million_cells_have_the_tiles_of_c_and_a_wrong_constant_is_noticed(self):
        for kind, turns in (("even", 10), ("mix", 2), ("permutation", 2)):
            with self.subTest(kind):
                pack = self.bake(kind)
                text, expected = self.text(pack, "gdshader"), self.c_lookup(pack)
                self.assertEqual(self.wrong(text, expected, turns), 0)
                at = text.index("0x") + 9  # the last digit of the first constant
                self.assertEqual(self.wrong(text[:at] + ("0" if text[at] != "0" else "1") + text[at + 1:], expected, 1), 1)

    def test_texels_are_those_of_c(self):
        # Godot 3.2 takes whole chains only.
        self.bake("even")
        self.run_tilepack("bake", "sample.png", "-o", "chain.pack", "--tile-size", "16", "--effort", "0", "--full-mips")
        levels, compiled = self.levels("chain.pack"), self.c_lookup("chain.pack")
        self.assertEqual(levels[-1][:2], (1, 1))
        data = self.draw(self.text("chain.pack", "gdshader"), VALUES.replace("LEVELS", str(len(levels))), 256, 4, levels)
        for turn, allowed in enumerate((0, 2, 2, 2)):  # of 255; the picture rounds to one, and llvmpipe weighs in 256ths
            values = memoryview(compiled.values(turn, 1 << 16, levels, 1, None)).cast("f")
            picture = data[turn << 18:(turn + 1) << 18]
            off = max(abs(code - 255 * value) for i, (code, value) in enumerate(zip(picture, values)) if i % 4 < 3)
            self.assertLessEqual(off, allowed + 0.5 + 1e-3, turn)


if __name__ == "__main__":
    unittest.main()
