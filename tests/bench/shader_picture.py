"""The picture on top of the README: ways not to show a texture's repeat, at equal memory, near and from afar.

    /usr/bin/python3 tests/bench/shader_picture.py build/release/tilepack samples/pebbles.png samples/pictures/methods.jpg [FOLDER]

From left to right: the sample repeated, hex tiling (Mikkelsen 2022), histogram-preserving blending (Heitz and Neyret 2018, each
channel for itself), and a pack baked of the sample with as many texels, by `tilepack shader`. All are drawn by one program on Mesa's
software renderer. The upper row shows texels as they are; the lower one four times as far, each pixel the mean light of 16 places, so that nobody's
mips count. The peers' pieces never reach across the border of the sample, which does not tile. A .jpg needs python3-opencv; FOLDER
takes each method's picture for other tools."""

import ctypes
import os
import statistics
import subprocess
import sys
import tempfile

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(FOLDER), "cli"))
sys.path.insert(0, FOLDER)

import gl_context  # noqa: E402
from png_image import read_png, write_png  # noqa: E402
from shader_cost import HASH, RGB, SRGB8, TRIANGLE, UNSIGNED_BYTE  # noqa: E402

WIDTH, HEIGHT, GAP, FAR = 352, 264, 8, 4
RGB8 = 0x8051
SIZE = 512.0  # texels of the sample, and of the pack
MAIN = """
uniform float texels_a_pixel;
out vec4 result;
vec3 encoded(vec3 c) { c = clamp(c, 0.0, 1.0); return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)); }
void main() {
  vec2 pixel = vec2(gl_FragCoord.x, HEIGHT - gl_FragCoord.y);
  int n = texels_a_pixel > 1.5 ? 4 : 1;
  vec3 sum = vec3(0.0);
  for (int j = 0; j < n; ++j) for (int i = 0; i < n; ++i)
    sum += get((pixel - 0.5 + (vec2(float(i), float(j)) + 0.5) / float(n)) * texels_a_pixel + 40.0);
  result = vec4(encoded(sum / float(n * n)), 1.0);
}
""".replace("HEIGHT", f"{HEIGHT}.0")
PLAIN = "uniform sampler2D t;\nvec3 get(vec2 p) { return textureLod(t, p / 512.0, 0.0).rgb; }\n"
# Where a lattice point's piece of the sample lies: its center so far inside that the piece stays inside.
PIECE = HASH + TRIANGLE + """
vec2 piece(ivec2 v, vec2 p, float turned) {
  mat2 m = turned > 0.0 ? turn_of(v) : mat2(1.0);
  return m * (p - point_of(v)) + 0.36 + 0.28 * offset_of(v);
}
"""
HEX = PIECE + """
uniform sampler2D t;
vec3 get(vec2 at) {
  vec2 p = at / 512.0; vec3 w; ivec2 a, b, c; triangle(p, w, a, b, c);
  vec3 va = textureLod(t, piece(a, p, 1.0), 0.0).rgb, vb = textureLod(t, piece(b, p, 1.0), 0.0).rgb, vc = textureLod(t, piece(c, p, 1.0), 0.0).rgb;
  vec3 luma = vec3(0.299, 0.587, 0.114);
  vec3 d = mix(vec3(1.0), vec3(dot(va, luma), dot(vb, luma), dot(vc, luma)), 0.6);
  w = d * pow(w, vec3(7.0)); w /= w.x + w.y + w.z;
  return w.x * va + w.y * vb + w.z * vc;
}
"""
HISTOGRAM = PIECE + """
uniform sampler2D t, back;
vec3 get(vec2 at) {
  vec2 p = at / 512.0; vec3 w; ivec2 a, b, c; triangle(p, w, a, b, c);
  vec3 v = w.x * textureLod(t, piece(a, p, 0.0), 0.0).rgb + w.y * textureLod(t, piece(b, p, 0.0), 0.0).rgb + w.z * textureLod(t, piece(c, p, 0.0), 0.0).rgb;
  v = clamp((v - 0.5) / length(w) + 0.5, 0.0, 1.0);
  return vec3(textureLod(back, vec2(v.r, 0.5), 0.0).r, textureLod(back, vec2(v.g, 0.5), 0.0).g, textureLod(back, vec2(v.b, 0.5), 0.0).b);
}
"""
PACK = """
uniform sampler2D t;
vec3 get(vec2 at) {
  vec2 p = at / 128.0, c = floor(p), f = min(p - c, 0.99999994);
  return tilepack_level(t, int(c.x), int(c.y), f.x, f.y, 0.0).rgb;
}
"""


def gaussian(rows):
    """The sample with each channel's values made normal (mean 1/2, a sixth of deviation), and the table that leads back."""
    flat = [value for row in rows for value in row]
    result, back = [0] * len(flat), []
    normal = statistics.NormalDist(0.5, 1 / 6)
    table = [normal.inv_cdf((i + 0.5) / 4096) for i in range(4096)]
    for channel in range(3):
        order = sorted(range(channel, len(flat), 3), key=flat.__getitem__)
        count = len(order)
        for rank, index in enumerate(order):
            result[index] = min(max(round(255 * table[rank * 4096 // count]), 0), 255)
        back.append([flat[order[min(int(normal.cdf((i + 0.5) / 256) * count), count - 1)]] for i in range(256)])
    return bytes(result), bytes(value for texel in zip(*back) for value in texel)


def draw(gl, fragment, textures):
    """Near and far, as rows of bytes."""
    program = gl.program(fragment + MAIN)
    for unit, (name, (width, height, data), internal, repeat) in enumerate(textures):
        gl.texture(unit, [(width, height, data)], internal=internal, kind=RGB, component=UNSIGNED_BYTE, linear=True, repeat=repeat)
        gl.call("glUniform1i", gl.call("glGetUniformLocation", program, name.encode(), result=ctypes.c_int), unit)
    pictures = []
    for scale in (1.0, float(FAR)):
        gl.uniform(program, "texels_a_pixel", scale)
        values = memoryview(gl.draw()).cast("f")
        rows = [[round(255 * values[4 * (y * WIDTH + x) + c]) for x in range(WIDTH) for c in range(3)] for y in range(HEIGHT)]
        pictures.append(rows[::-1])
    return pictures


def save(path, rows):
    if not path.endswith(".jpg"):
        write_png(path, rows, 3)
        return
    import cv2  # pylint: disable=import-outside-toplevel
    import numpy  # pylint: disable=import-outside-toplevel
    picture = numpy.array(rows, dtype=numpy.uint8).reshape(len(rows), -1, 3)[:, :, ::-1]
    cv2.imwrite(path, picture, [cv2.IMWRITE_JPEG_QUALITY, 88])


def main():
    program, sample, output = sys.argv[1:4]
    rows, channels, bits = read_png(sample)
    assert (len(rows), len(rows[0]), channels, bits) == (SIZE, 3 * SIZE, 3, 8), "a sample of 512 x 512 texels, RGB of 8 bits"
    plain = (512, 512, b"".join(bytes(row) for row in rows))
    normal, back = gaussian(rows)
    gl = gl_context.Gl()
    gl.target(WIDTH, HEIGHT, gl_context.RGBA32F)
    with tempfile.TemporaryDirectory() as folder:
        pack = os.path.join(folder, "sample.pack")
        subprocess.run([program, "bake", sample, "-o", pack, "--tile-size", "128", "--quiet"], check=True, stdout=subprocess.DEVNULL)
        text = subprocess.run([program, "shader", pack, "--lang", "glsl"], check=True, capture_output=True, text=True).stdout
        drawn = read_png(os.path.join(pack, "color_0.png"))[0]
        assert len(drawn) == SIZE, "a pack of as many texels as the sample"
        tiles = b"".join(bytes(row) for row in drawn)
    methods = {
        "repeat": draw(gl, PLAIN, [("t", plain, SRGB8, True)]),
        "hex": draw(gl, HEX, [("t", plain, SRGB8, True)]),
        "histogram": draw(gl, HISTOGRAM, [("t", (512, 512, normal), RGB8, True), ("back", (256, 1, back), SRGB8, False)]),
        "pack": draw(gl, text + PACK, [("t", (512, 512, tiles), SRGB8, True)]),
    }
    white = [255] * 3 * GAP
    picture = []
    for row in range(2):
        if row:
            picture += [[255] * (3 * (4 * WIDTH + 3 * GAP)) for _ in range(GAP)]
        for y in range(HEIGHT):
            line = []
            for number, pictures in enumerate(methods.values()):
                line += (white if number else []) + pictures[row][y]
            picture.append(line)
    save(output, picture)
    if len(sys.argv) > 4:
        os.makedirs(sys.argv[4], exist_ok=True)
        for name, (near, far) in methods.items():
            write_png(os.path.join(sys.argv[4], name + "_near.png"), near, 3)
            write_png(os.path.join(sys.argv[4], name + "_far.png"), far, 3)


if __name__ == "__main__":
    main()
