// A drawn sample of any size, to bake what no repository holds: stones of many sizes and tones with grit between
// them, on ground whose tone drifts. A smaller one is the north-west part of a larger one.
//
//   bench_large_sample SIDE FILE.png       SIDE: texels, such as 4096

#include "tilepack/image/image_file.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

using namespace tilepack;

namespace {

std::uint32_t hash(int x, int y, std::uint32_t stream) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1u ^
                    static_cast<std::uint32_t>(y) * 0x85ebca77u ^ stream * 0xc2b2ae3du;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  h ^= h >> 12;
  h *= 0x297a2d39u;
  return h ^ h >> 15;
}

float unit(std::uint32_t h) {
  return static_cast<float>(h >> 8) * 0x1p-24f;
}

float smooth(float t) {
  return t * t * (3.0f - 2.0f * t);
}

// Noise of one size, -1 to 1.
float noise(float x, float y, std::uint32_t stream) {
  const float fx = std::floor(x), fy = std::floor(y);
  const int i = static_cast<int>(fx), j = static_cast<int>(fy);
  const float s = smooth(x - fx), t = smooth(y - fy);
  const float north = std::lerp(unit(hash(i, j, stream)), unit(hash(i + 1, j, stream)), s);
  const float south = std::lerp(unit(hash(i, j + 1, stream)), unit(hash(i + 1, j + 1, stream)), s);
  return 2.0f * std::lerp(north, south, t) - 1.0f;
}

struct Stone {
  float inside = 0; // texels from its outline, negative beyond it
  std::uint32_t name = 0;
};

// Stones lie where their seed is nearest, a gap between them : the cells of one jittered grid.
Stone stone_at(float x, float y, float cell, std::uint32_t stream) {
  const int i0 = static_cast<int>(std::floor(x / cell)), j0 = static_cast<int>(std::floor(y / cell));
  float first = 1e9f, second = 1e9f;
  std::uint32_t name = 0;
  for (int j = j0 - 1; j <= j0 + 1; ++j)
    for (int i = i0 - 1; i <= i0 + 1; ++i) {
      const std::uint32_t h = hash(i, j, stream);
      const float dx = (static_cast<float>(i) + 0.1f + 0.8f * unit(h)) * cell - x;
      const float dy = (static_cast<float>(j) + 0.1f + 0.8f * unit(h * 0x9e3779b1u)) * cell - y;
      const float d = std::sqrt(dx * dx + dy * dy);
      if (d < first) {
        second = first;
        first = d;
        name = h;
      } else {
        second = std::min(second, d);
      }
    }
  return {0.5f * (second - first) - 0.06f * cell, name};
}

void draw(int x, int y, std::span<float> texel) {
  const auto u = static_cast<float>(x), v = static_cast<float>(y);
  float bend = 4.0f * noise(u / 23.0f, v / 23.0f, 1), sway = 4.0f * noise(u / 23.0f, v / 23.0f, 2);
  // A slow warp, so that the grid of seeds is no period of the sample.
  bend += 120.0f * noise(u / 900.0f, v / 900.0f, 8);
  sway += 120.0f * noise(u / 900.0f, v / 900.0f, 9);
  Stone stone = stone_at(u + bend, v + sway, 84.0f, 3);
  float size = 84.0f;
  if (stone.inside < 0 || stone.name % 5 == 0) { // small ones where a large one is missing
    const Stone small = stone_at(u + bend, v + sway, 21.0f, 4);
    if (stone.inside < 0 ? small.inside > 2.0f : true) {
      stone = small;
      size = 21.0f;
    }
  }
  const float drift = 0.03f * noise(u / 700.0f, v / 700.0f, 5);
  const float grit = 0.05f * noise(u / 1.7f, v / 1.7f, 6) + 0.03f * noise(u / 5.0f, v / 5.0f, 7);
  std::array<float, 3> color{0.29f, 0.25f, 0.20f};
  if (stone.inside >= 0) {
    const float tone = 0.35f + 0.4f * unit(stone.name * 0x85ebca77u),
                warm = 0.12f * unit(stone.name * 0xc2b2ae3du);
    const float round = smooth(std::min(1.0f, stone.inside / (0.18f * size)));
    const float vein = 0.06f * noise(u / 13.0f, v / 37.0f, stone.name & 0xffffu);
    const float light = (0.45f + 0.55f * round) * (tone + vein);
    color = {light + 0.5f * warm, light, light - warm};
  }
  for (std::size_t c = 0; c < 3; ++c) texel[c] = std::clamp(color[c] + grit + drift, 0.0f, 1.0f);
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 3 || std::atoi(argv[1]) < 16) {
    fmt::print(stderr, "usage: bench_large_sample SIDE FILE.png\n");
    return 1;
  }
  const int side = std::atoi(argv[1]);
  constexpr int band_rows = 64;
  ImageWriter writer(argv[2], {side, side}, 3, Depth::u8, Encoding::srgb);
  for (int y0 = 0; y0 < side; y0 += band_rows) {
    Image band(side, std::min(band_rows, side - y0), 3);
    tbb::parallel_for(0, band.height(), [&](int y) {
      for (int x = 0; x < side; ++x) draw(x, y0 + y, band.texel(x, y));
    });
    writer.write(band);
  }
  writer.finish();
}
