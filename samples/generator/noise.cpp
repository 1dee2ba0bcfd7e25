#include "noise.h"

#include "tilepack/numeric/random.h"

#include <algorithm>
#include <cmath>

namespace samples {
namespace {

std::uint64_t hash_of(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  const std::uint64_t point = tilepack::mixed(static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u + seed);
  return tilepack::mixed(point + static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu);
}

double unit(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) / 9007199254740992.0; // 2^53
}

double fade(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

} // namespace

double random_at(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  return unit(hash_of(x, y, seed));
}

// A point of the square is drawn until it lies in the disk, then pushed to the circle: no sine needed.
Direction direction_at(std::int64_t x, std::int64_t y, std::uint64_t seed) {
  std::uint64_t bits = hash_of(x, y, seed ^ 0x5bd1e995u);
  for (int attempt = 0; attempt < 16; ++attempt) {
    const double u = 2 * unit(bits) - 1;
    bits = tilepack::mixed(bits + 1);
    const double v = 2 * unit(bits) - 1;
    bits = tilepack::mixed(bits + 1);
    const double length = std::sqrt(u * u + v * v);
    if (length > 0.1 && length <= 1) return {u / length, v / length};
  }
  return {};
}

double noise(double x, double y, std::uint64_t seed) {
  const double cell_x = std::floor(x), cell_y = std::floor(y);
  const double u = x - cell_x, v = y - cell_y;
  const auto gradient = [&](int i, int j) {
    const Direction d =
        direction_at(static_cast<std::int64_t>(cell_x) + i, static_cast<std::int64_t>(cell_y) + j, seed);
    return d.x * (u - i) + d.y * (v - j);
  };
  const double top = mix(gradient(0, 0), gradient(1, 0), fade(u));
  const double bottom = mix(gradient(0, 1), gradient(1, 1), fade(u));
  return 1.5 * mix(top, bottom, fade(v));
}

double fractal(double x, double y, int octaves, std::uint64_t seed) {
  double sum = 0, strength = 0.5;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += strength * noise(x, y, seed + static_cast<std::uint64_t>(octave));
    const double turned = 1.6 * x - 1.2 * y; // a turn by 37 degrees hides the lattice
    y = 1.2 * x + 1.6 * y;
    x = turned;
    strength *= 0.5;
  }
  return sum;
}

Cells cells(double x, double y, std::uint64_t seed) {
  Cells result{9, 9, 0};
  const auto cell_x = static_cast<std::int64_t>(std::floor(x));
  const auto cell_y = static_cast<std::int64_t>(std::floor(y));
  for (std::int64_t j = cell_y - 1; j <= cell_y + 1; ++j)
    for (std::int64_t i = cell_x - 1; i <= cell_x + 1; ++i) {
      const double dx = static_cast<double>(i) + random_at(i, j, seed) - x;
      const double dy = static_cast<double>(j) + random_at(i, j, seed + 1) - y;
      const double distance = std::sqrt(dx * dx + dy * dy);
      if (distance < result.nearest) {
        result.second = result.nearest;
        result.nearest = distance;
        result.id = hash_of(i, j, seed + 2);
      } else {
        result.second = std::min(result.second, distance);
      }
    }
  return result;
}

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double mix(double a, double b, double t) {
  return a + (b - a) * t;
}

} // namespace samples
