"""What a lookup costs in a shader beside what engines offer: times of whole pictures on Mesa's software renderer, or whatever
EGL finds (LIBGL_ALWAYS_SOFTWARE=0), in turn, as ratios to plain texturing.

    python3 tests/bench/shader_cost.py build/release/tilepack [--size 1920x1080] [--rounds 9]
    python3 tests/bench/shader_cost.py build/release/tilepack --append times.jsonl --minutes 5 [--columns coherent-1,grazing-6]
    python3 tests/bench/shader_cost.py --table times.jsonl

Rounds can be gathered in slices, while other work goes on: in a round all methods are timed in turn, and only their ratios count, of which
the table has medians. With a software renderer times are those of the processor, summed over its threads, so that waiting for others is no
part of them. --append adds each round to a file, that with the fewest rounds first, until it has --rounds of each column or the
minutes are over; --table prints what a file has.

Bakes packs of samples/pebbles.png, 64 x 64 texels a tile. Peers' methods are written after their authors' pages and abstracts: hex tiling after
Mikkelsen, "Practical Real-Time Hex-Tiling" (JCGT 11(3), 2022), histogram-preserving blending after Heitz and Neyret (HPG
2018; the inverse transform as one more fetch), and the methods that Babylon.js's page on texture repetition lists, by their counts
of fetches: blend of two offsets by a low noise (3), offsets and mirrors of four cells blended (4), Voronoi bombing (9)."""

import argparse
import ctypes
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(FOLDER), "cli"))

import gl_context  # noqa: E402
from png_image import read_png  # noqa: E402

SRGB8, RGB, UNSIGNED_BYTE = 0x8C41, 0x1907, 0x1401
HASH = """
vec2 offset_of(ivec2 cell) {
  uint x = uint(cell.x) * 0x9e3779b1u ^ uint(cell.y) * 0x85ebca6bu;
  x = (x ^ (x >> 15u)) * 0xc2b2ae35u; x ^= x >> 13u;
  return vec2(float(x & 65535u), float(x >> 16u)) / 65536.0;
}
float noise_of(vec2 p) {
  ivec2 c = ivec2(floor(p)); vec2 f = fract(p); f = f * f * (3.0 - 2.0 * f);
  return mix(mix(offset_of(c).x, offset_of(c + ivec2(1, 0)).x, f.x), mix(offset_of(c + ivec2(0, 1)).x, offset_of(c + ivec2(1, 1)).x, f.x), f.y);
}
"""
# A grid of equilateral triangles, 3.46 to the texture's side: the corners of the one that holds a place, and its shares of them.
TRIANGLE = """
const float triangles = 3.4641016, root = 1.7320508;
vec2 point_of(ivec2 v) { return vec2(float(v.x) + 0.5 * float(v.y), 0.5 * root * float(v.y)) / triangles; }
void triangle(vec2 p, out vec3 w, out ivec2 a, out ivec2 b, out ivec2 c) {
  vec2 q = triangles * vec2(p.x - p.y / root, 2.0 * p.y / root), cell = floor(q), f = q - cell;
  bool upper = f.x + f.y > 1.0;
  a = ivec2(cell) + (upper ? ivec2(1, 1) : ivec2(0, 0));
  b = ivec2(cell) + ivec2(1, 0);
  c = ivec2(cell) + ivec2(0, 1);
  w = upper ? vec3(f.x + f.y - 1.0, 1.0 - f.y, 1.0 - f.x) : vec3(1.0 - f.x - f.y, f.x, f.y);
}
mat2 turn_of(ivec2 cell) { float a = offset_of(cell).x * 6.2831853; return mat2(cos(a), sin(a), -sin(a), cos(a)); }
"""
PLAIN = "vec4 get(sampler2D t, vec2 p, vec2 dx, vec2 dy) { return textureGrad(t, p / 4.0, dx / 4.0, dy / 4.0); }"
HEX = HASH + TRIANGLE + """
vec4 get(sampler2D t, vec2 p, vec2 dx, vec2 dy) {
  vec3 w; ivec2 a, b, c; triangle(p, w, a, b, c);
  mat2 ra = turn_of(a), rb = turn_of(b), rc = turn_of(c);
  vec4 va = textureGrad(t, ra * p / 4.0 + offset_of(a), ra * dx / 4.0, ra * dy / 4.0);
  vec4 vb = textureGrad(t, rb * p / 4.0 + offset_of(b), rb * dx / 4.0, rb * dy / 4.0);
  vec4 vc = textureGrad(t, rc * p / 4.0 + offset_of(c), rc * dx / 4.0, rc * dy / 4.0);
  vec3 luma = vec3(0.299, 0.587, 0.114);
  vec3 d = mix(vec3(1.0), vec3(dot(va.rgb, luma), dot(vb.rgb, luma), dot(vc.rgb, luma)), 0.6);
  w = d * pow(w, vec3(7.0)); w /= w.x + w.y + w.z;
  return w.x * va + w.y * vb + w.z * vc;
}"""
HISTOGRAM = HASH + TRIANGLE + """
uniform sampler2D inverse;
vec4 get(sampler2D t, vec2 p, vec2 dx, vec2 dy) {
  vec3 w; ivec2 a, b, c; triangle(p, w, a, b, c);
  vec4 v = w.x * textureGrad(t, p / 4.0 + offset_of(a), dx / 4.0, dy / 4.0) + w.y * textureGrad(t, p / 4.0 + offset_of(b), dx / 4.0, dy / 4.0) +
           w.z * textureGrad(t, p / 4.0 + offset_of(c), dx / 4.0, dy / 4.0);
  v = (v - 0.5) / length(w) + 0.5;
  return textureLod(inverse, v.xy, 0.0);
}"""
NOISE = HASH + """
vec4 get(sampler2D t, vec2 p, vec2 dx, vec2 dy) {
  float k = textureLod(t, p / 64.0, 4.0).x * 8.0, f = fract(k); ivec2 a = ivec2(int(floor(k)), 0);
  return mix(textureGrad(t, p / 4.0 + offset_of(a), dx / 4.0, dy / 4.0), textureGrad(t, p / 4.0 + offset_of(a + ivec2(1, 0)), dx / 4.0, dy / 4.0),
             smoothstep(0.2, 0.8, f));
}"""
FOUR = HASH + """
vec4 cell_value(sampler2D t, ivec2 cell, vec2 p, vec2 dx, vec2 dy) {
  vec2 o = offset_of(cell), s = sign(o - 0.5);
  return textureGrad(t, p / 4.0 * s + o, dx / 4.0 * s, dy / 4.0 * s);
}
vec4 get(sampler2D t, vec2 p, vec2 dx, vec2 dy) {
  ivec2 c = ivec2(floor(p / 4.0)); vec2 b = smoothstep(0.25, 0.75, fract(p / 4.0));
  return mix(mix(cell_value(t, c, p, dx, dy), cell_value(t, c + ivec2(1, 0), p, dx, dy), b.x),
             mix(cell_value(t, c + ivec2(0, 1), p, dx, dy), cell_value(t, c + ivec2(1, 1), p, dx, dy), b.x), b.y);
}"""
VORONOI = HASH + """
vec4 get(sampler2D t, vec2 p, vec2 dx, vec2 dy) {
  ivec2 c = ivec2(floor(p / 4.0)); vec2 f = fract(p / 4.0); vec4 sum = vec4(0.0); float all = 0.0;
  for (int j = -1; j <= 1; ++j) for (int i = -1; i <= 1; ++i) {
    vec2 o = offset_of(c + ivec2(i, j)), r = vec2(float(i), float(j)) - f + o;
    float w = exp(-5.0 * dot(r, r));
    sum += w * textureGrad(t, p / 4.0 + o, dx / 4.0, dy / 4.0); all += w;
  }
  return sum / all;
}"""


def packed(text, function="tilepack_grad", ids=False):
    """The lookup of a pack by a text of `tilepack shader`."""
    return text + ("uniform usampler2D ids;" if ids else "") + """
vec4 get(sampler2D t, vec2 p, vec2 dx, vec2 dy) {
  vec2 c = floor(p), f = min(p - c, 0.99999994);
  return %s(t, %sint(c.x), int(c.y), f.x, f.y, dx.x, dx.y, dy.x, dy.y);
}""" % (function, "ids, " if ids else "")


MAIN = """
uniform vec2 size;
out vec4 result;
void main() {
  vec2 s = (gl_FragCoord.xy - 0.5 * size) / size.y;
  vec2 p = PLACE;
  vec2 dx = dFdx(p), dy = dFdy(p);
  result = VALUE;
}
"""
VIEWS = {"coherent": "s * size.y * 1.3 / 64.0 + 37.0", "grazing": "vec2(s.x, 1.0) / (0.55 - s.y) * 4.0 + 37.0"}


class Bench:
    def __init__(self, program, width, height):
        self.gl = gl_context.Gl()
        self.size = (width, height)
        self.software = "llvmpipe" in self.gl.renderer()
        self.gl.target(width, height, gl_context.RGBA32F)
        self.folder = tempfile.TemporaryDirectory(prefix="tilepack_cost_")
        source = os.path.join(os.path.dirname(os.path.dirname(FOLDER)), "samples", "pebbles.png")
        self.texts = {}
        for name, options in (("even", ["--mapping", "even"]), ("mix", ["--mapping", "mix"]), ("index", ["--mapping", "index"])):
            pack = os.path.join(self.folder.name, name)
            subprocess.run([program, "bake", source, "-o", pack, "--tile-size", "64", "--effort", "0", "--mips", "box", "--quiet", *options], check=True,
                           stdout=subprocess.DEVNULL)
            self.texts[name] = subprocess.run([program, "shader", pack, "--lang", "glsl"], check=True, capture_output=True, text=True).stdout
        levels = []
        for level in range(7):
            rows, _, _ = read_png(os.path.join(self.folder.name, "even", f"color_{level}.png"))
            levels.append((len(rows[0]) // 3, len(rows), b"".join(bytes(row) for row in rows)))
        for unit in range(6):
            self.gl.texture(unit, levels, internal=SRGB8, kind=RGB, component=UNSIGNED_BYTE, linear=True)
        rows, _, _ = read_png(os.path.join(self.folder.name, "index", "index.png"))
        ids = b"".join(value.to_bytes(2, "little") for row in rows for value in row)
        self.gl.texture(8, [(len(rows[0]), len(rows), ids)], internal=gl_context.R16UI, kind=gl_context.RED_INTEGER,
                        component=gl_context.UNSIGNED_SHORT)
        self.gl.texture(9, levels[2:3], internal=SRGB8, kind=RGB, component=UNSIGNED_BYTE, linear=True)

    def program(self, get, maps, view):
        samplers = "".join(f"uniform sampler2D tiles{i};\n" for i in range(maps))
        value = " + ".join(f"get(tiles{i}, p, dx, dy)" for i in range(maps))
        program = self.gl.program(get + samplers + MAIN.replace("PLACE", VIEWS[view]).replace("VALUE", value))
        for i in range(maps):
            self.gl.uniform(program, f"tiles{i}", i)
        for name, unit in (("ids", 8), ("inverse", 9)):
            place = self.gl.call("glGetUniformLocation", program, name.encode(), result=ctypes.c_int)
            self.gl.call("glUniform1i", place, unit)
        place = self.gl.call("glGetUniformLocation", program, b"size", result=ctypes.c_int)
        self.gl.call("glUniform2f", place, ctypes.c_float(self.size[0]), ctypes.c_float(self.size[1]))
        return program

    def seconds(self, program):
        clock = time.process_time if self.software else time.perf_counter
        self.gl.call("glUseProgram", program)
        self.gl.call("glFinish")
        start = clock()
        self.gl.call("glDrawArrays", 4, 0, 3)
        self.gl.call("glFinish")
        return clock() - start

    def methods(self):
        return [("plain", 1, PLAIN), ("pack, `mix`", 1, packed(self.texts["mix"])), ("pack, `even`", 1, packed(self.texts["even"])),
                ("pack, `index`", "1 + 1 for all", packed(self.texts["index"], ids=True)),
                ("pack, `mix`, exact", "2 to 8", packed(self.texts["mix"], "tilepack_exact_grad")),
                ("noise blend of two", 3, NOISE), ("hex tiling", 3, HEX), ("histogram blending", 4, HISTOGRAM),
                ("four mirrored offsets", 4, FOUR), ("Voronoi bombing", 9, VORONOI)]

    def rounds(self, column):
        """Rounds of a column without end, each the seconds of every method in turn."""
        view, maps = column.split("-")
        methods = self.methods()
        programs = [self.program(get, int(maps), view) for _, _, get in methods]
        for program in programs:  # compiles and warms up
            self.seconds(program)
        while True:
            yield {"renderer": self.gl.renderer(), "clock": "processor" if self.software else "wall", "size": self.size, "column": column,
                   "fetches": {name: fetches for name, fetches, _ in methods},
                   "seconds": {name: self.seconds(program) for (name, _, _), program in zip(methods, programs)}}


def table(rounds):
    """The table of rounds that were gathered, all on one renderer at one size."""
    heads = {(r["renderer"], tuple(r["size"]), r["clock"]) for r in rounds}
    if len(heads) != 1:
        sys.exit(f"rounds of {len(heads)} renderers or sizes; a table is of one")
    (renderer, (width, height), clock), = heads
    columns = [c for c in COLUMNS if any(r["column"] == c for r in rounds)]
    counts = [sum(r["column"] == c for r in rounds) for c in columns]
    print(f"{renderer}, {width} x {height}, {clock} time, medians of {min(counts)} to {max(counts)} rounds in turn; speed, plain = 1\n")
    print("| method | fetches a map | " + " | ".join(c.replace("-", ", ") + (" map" if c.endswith("-1") else " maps") for c in columns) + " |")
    print("|---" * (2 + len(columns)) + "|")
    for name, fetches in rounds[0]["fetches"].items():
        ratios = [statistics.median(r["seconds"]["plain"] / r["seconds"][name] for r in rounds if r["column"] == c) for c in columns]
        print(f"| {name} | {fetches} | " + " | ".join(f"{ratio:.2f}" for ratio in ratios) + " |")


COLUMNS = [f"{view}-{maps}" for view in VIEWS for maps in (1, 3, 6)]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", nargs="?")
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--columns", default=",".join(COLUMNS))
    parser.add_argument("--append")
    parser.add_argument("--minutes", type=float, default=1e9)
    parser.add_argument("--table")
    a = parser.parse_args()
    if a.table:
        with open(a.table, encoding="utf-8") as file:
            return table([json.loads(line) for line in file])
    bench, end = Bench(os.path.abspath(a.program), *map(int, a.size.split("x"))), time.time() + 60 * a.minutes
    gathered = []
    if a.append and os.path.exists(a.append):
        with open(a.append, encoding="utf-8") as file:
            gathered = [json.loads(line) for line in file]
    columns = a.columns.split(",")
    count = {c: sum(r["column"] == c for r in gathered) for c in columns}
    for column in sorted(columns, key=count.get):
        source = bench.rounds(column)
        while count[column] < a.rounds and time.time() < end:
            gathered.append(next(source))
            count[column] += 1
            if a.append:
                with open(a.append, "a", encoding="utf-8") as file:
                    file.write(json.dumps(gathered[-1]) + "\n")
    if gathered:
        table(gathered)


if __name__ == "__main__":
    main()
