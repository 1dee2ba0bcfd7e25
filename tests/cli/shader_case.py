"""What the tests of `tilepack shader` share: packs of every kind, the lookup in C as a library, and what both are asked."""

import ctypes
import os
import struct
import subprocess

from command import CommandCase
from png_image import read_png

# Cell number i of a run, in any language with words of 32 bits: strewn, near the origin, and at both ends of 32 bits.
CELL_OF = """
{word} cell_word({word} i, {word} axis) {{
  {word} h = (i ^ (axis * 0x5bd1e995u)) * 0x9e3779b1u;
  h = (h ^ (h >> 15u)) * 0x85ebca6bu;
  h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
  h = h ^ (h >> 16u);
  {word} near = h % 400u - 200u;
  {word} kind = (i >> axis) & 3u;
  return kind == 0u ? h : (kind == 1u ? near : (kind == 2u ? near + 0x80000000u : near + 0x40000000u));
}}
"""

# Place number i: a cell near the origin, steps of 1/1024 within it, a level, whole or (mode 2 and beyond) any quarter.
PLACE_OF = """
{word} place_word({word} i) {{ return cell_word(i, 0u); }}
{whole} place_cell({word} i, {word} axis) {{ return {whole}(((place_word(i * 7u + axis)) >> 5u) % 20u) - 8; }}
{real} place_fraction({word} i, {word} axis) {{ return {real}((place_word(i * 11u + axis) >> 7u) & 1023u) / 1024.0; }}
{real} place_level({word} i, {word} levels) {{ return {real}((place_word(i * 13u) >> 9u) % levels); }}
"""

# name -> options of `bake`; together they have every mapping, layout and kind of table.
PACKS = {
    "even": ["--colors", "2"],
    "even3": ["--colors", "3", "--virtual-size", "1000x7"],
    "mix": ["--mapping", "mix", "--coloring", "edge", "--colors", "2x3"],
    "permutation": ["--mapping", "permutation", "--virtual-size", "100x77"],
    "index": ["--mapping", "index", "--coloring", "edge", "--virtual-size", "70x33"],
    "array": ["--layout", "array", "--border", "2", "--coloring", "edge"],
    "full": ["--colors", "3", "--full-mips"],
    "corners": ["--coloring", "edge", "--corner-pack", "--interior", "quilt", "--mapping", "mix"],
    "rotated": ["--set", "sequential", "--coloring", "edge", "--layout", "rotated", "--virtual-size", "24x24"],
}


def dialect(text, word="uint", whole="int", real="float"):
    return text.format(word=word, whole=whole, real=real)


class _Image(ctypes.Structure):
    _fields_ = [("texels", ctypes.c_char_p), ("width", ctypes.c_int), ("height", ctypes.c_int)]


class _Texture(ctypes.Structure):
    _fields_ = [("levels", ctypes.POINTER(_Image)), ("level_count", ctypes.c_int), ("channels", ctypes.c_int)]


def _texture(levels, layers):
    images = (_Image * len(levels))(*[_Image(data, width, height // layers) for width, height, data in levels])
    return _Texture(images, len(levels), 4)


class CLookup:
    """The C text of a pack, compiled: what other languages are held to. tests/shader holds it to the reference sampler."""

    def __init__(self, header, ids, exact=True, corners=False):
        source, library = header + ".c", header + ".so"  # a name of its own each: loaders keep what they loaded
        call = "ids, " if ids else ""
        with open(source, "w", encoding="utf-8") as file:
            texts = dialect(CELL_OF + PLACE_OF.replace("1024.0", "1024.0f"), "uint32_t", "(int32_t)", "(float)")
            texts = texts.replace("\n(int32_t) place", "\nint32_t place").replace("\n(float) place", "\nfloat place")
            exact = "tilepack_exact(tiles, " + call + "x, y, fx, fy, level)" if exact else "tilepack_none()"
            corner = "corners, " if corners else ""
            file.write(f'#include "{os.path.basename(header)}"\n' + texts + f"""
void cells(const uint16_t *ids, uint32_t first, uint32_t count, uint32_t *out) {{
  uint32_t i;
  (void)ids;
  for (i = 0; i < count; ++i) {{
    const int32_t x = (int32_t)cell_word(first + i, 1u), y = (int32_t)cell_word(first + i, 2u);
    out[2 * i] = tilepack_tile({call}x, y);
    out[2 * i + 1] = tilepack_place({call}x, y);
  }}
}}
uint32_t tile_at(const uint16_t *ids, int32_t x, int32_t y) {{
  (void)ids;
  return tilepack_tile({call}x, y);
}}
void values(const uint16_t *ids, const tilepack_texture *tiles, const tilepack_texture *corners, int mode, uint32_t count,
            tilepack_value *out) {{
  uint32_t i;
  (void)ids, (void)corners;
  for (i = 0; i < count; ++i) {{
    const int32_t x = place_cell(i, 1u), y = place_cell(i, 2u);
    const float fx = place_fraction(i, 1u), fy = place_fraction(i, 2u);
    float level = place_level(i, (uint32_t)tiles->level_count);
    if (mode >= 2) level += 0.25f * (float)(i % 4u);
    out[i] = mode == 0   ? tilepack_nearest(tiles, {call}x, y, fx, fy, (int32_t)level)
             : mode <= 2 ? tilepack_level(tiles, {corner}{call}x, y, fx, fy, level)
             : mode == 3 ? {exact}
                         : tilepack_filtered(tiles, fx, fy, 0, level);
  }}
}}
""")
        subprocess.run(["cc", "-std=c99", "-O2", "-shared", "-fPIC", "-o", library, source, "-lm"], check=True)
        self.library = ctypes.CDLL(library)
        self.ids = ids

    def cells(self, first, count):
        out = ctypes.create_string_buffer(8 * count)
        self.library.cells(self.ids, ctypes.c_uint32(first), ctypes.c_uint32(count), out)
        return out.raw

    def tile(self, x, y):
        return self.library.tile_at(self.ids, x, y)

    def values(self, mode, count, levels, layers, corner_levels):
        """Of places 0..count-1: 0 nearest, 1 a whole level, 2 between levels, 3 exact, 4 the plain texture."""
        out = ctypes.create_string_buffer(16 * count)
        corners = _texture(corner_levels, 1) if corner_levels else None
        self.library.values(self.ids, ctypes.byref(_texture(levels, layers)), ctypes.byref(corners) if corners else None, mode,
                            ctypes.c_uint32(count), out)
        return out.raw


class ShaderCase(CommandCase):
    def bake(self, kind, *more):
        """The folder of a pack of PACKS."""
        if not os.path.exists(self.path("sample.png")):
            self.noise_png("sample.png", 64, 64)
        name = kind + ".pack"
        if not os.path.exists(self.path(name)):
            self.run_tilepack("bake", "sample.png", "-o", name, "--tile-size", "16", "--effort", "0", *PACKS[kind], *more)
        return name

    def text(self, pack, language, *more):
        return self.run_tilepack("shader", pack, "--lang", language, *more).stdout

    def ids_of(self, pack):
        """The index map's words and size, or None."""
        mapping = self.read_json(os.path.join(pack, "pack.json"))["mapping"]
        if mapping["kind"] != "index":
            return None, (0, 0)
        rows, _, _ = read_png(self.path(pack, mapping["file"]))
        flat = [value for row in rows for value in row]
        return struct.pack(f"<{len(flat)}H", *flat), tuple(mapping["virtual_size"])

    def c_lookup(self, pack):
        text = self.text(pack, "c")
        name = self.write(pack.replace(".pack", ".h"), text)
        return CLookup(self.path(name), self.ids_of(pack)[0], "tilepack_exact(" in text, self.has_corners(pack))

    def has_corners(self, pack):
        return "corner_pack" in self.read_json(os.path.join(pack, "pack.json"))

    def layers(self, pack):
        return len(self.read_json(os.path.join(pack, "pack.json"))["layout"].get("cells")) if "array" in pack else 0

    def levels(self, pack, corners=False):
        """The color map's levels as floats of four channels, stored values: (width, height, bytes) each."""
        description = self.read_json(os.path.join(pack, "pack.json"))
        maps = description["corner_pack"]["maps"] if corners else description["maps"]
        result = []
        for level in maps[0]["levels"]:
            rows, channels, bits = read_png(self.path(pack, level["file"]))
            top = (1 << bits) - 1
            values = []
            for row in rows:
                for at in range(0, len(row), channels):
                    texel = [value / top for value in row[at:at + channels]]
                    values += texel + [0.0] * (4 - channels)
            result.append((len(rows[0]) // channels, len(rows), struct.pack(f"<{len(values)}f", *values)))
        return result
