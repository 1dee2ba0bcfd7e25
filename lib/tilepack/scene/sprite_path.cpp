#include "tilepack/scene/sprite_path.h"

#include <cmath>
#include <numbers>

namespace tilepack {
namespace {

struct OnPath {
  double value = 0, slope = 0;
};

// The cubic through b and c, at 0 <= t <= 1 between them.
OnPath catmull_rom(double a, double b, double c, double d, double t) {
  const double p = 2 * b, q = c - a, r = 2 * a - 5 * b + 4 * c - d, s = 3 * b - a - 3 * c + d;
  return {0.5 * (p + t * (q + t * (r + t * s))), 0.5 * (q + t * (2 * r + t * 3 * s))};
}

TileCoordinate wrapped(double cells, std::int64_t count) {
  return within(normalised({static_cast<std::int64_t>(std::floor(cells)), cells - std::floor(cells)}), count,
                WrapMode::wrap);
}

} // namespace

Sprite sprite_at_time(const SceneSprite& sprite, double time, const PatternGrid& grid) {
  const std::size_t count = sprite.path.size();
  OnPath x{sprite.path[0][0], 1}, y{sprite.path[0][1], 0};
  if (count > 1) {
    const double rounds = sprite.start + time / sprite.period;
    const double at = (rounds - std::floor(rounds)) * static_cast<double>(count);
    const auto stretch = static_cast<std::size_t>(std::floor(at)) % count;
    const auto point = [&](std::size_t offset, std::size_t axis) {
      return sprite.path[(stretch + offset + count - 1) % count][axis];
    };
    const double t = at - std::floor(at);
    x = catmull_rom(point(0, 0), point(1, 0), point(2, 0), point(3, 0), t);
    y = catmull_rom(point(0, 1), point(1, 1), point(2, 1), point(3, 1), t);
  }
  double angle = 2 * std::numbers::pi * sprite.rotate;
  if (sprite.follows) angle += std::atan2(y.slope, x.slope);
  return {sprite.pattern,
          {wrapped(x.value, grid.width), wrapped(y.value, grid.height)},
          sprite.scale,
          std::cos(angle),
          std::sin(angle)};
}

} // namespace tilepack
