// A mown meadow from above: thousands of blades, painted from the lowest to the highest.

#include "noise.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>

namespace samples {
namespace {

// A blade is a bent stroke: it starts at its root, leans over, and its tip is bright where the base lies in
// the dark.
struct Blade {
  double x, y; // root
  Direction lean;
  double length, bend, width;
  double base; // height of the root
  Rgb color;
};

Blade blade_number(int index, int size, std::uint64_t seed) {
  const auto r = [&](int k) { return random_at(index, k, seed); };
  Blade blade{};
  blade.x = (r(0) * 1.2 - 0.1) * size;
  blade.y = (r(1) * 1.2 - 0.1) * size;
  const Direction free = direction_at(index, 2, seed);
  const double wind_x = 0.35 + 0.5 * noise(blade.x / 80, blade.y / 80, seed + 3);
  const double wind_y = 0.5 * noise(blade.x / 80, blade.y / 80, seed + 4);
  const double length =
      std::sqrt((free.x + wind_x) * (free.x + wind_x) + (free.y + wind_y) * (free.y + wind_y));
  blade.lean = {(free.x + wind_x) / std::max(length, 1e-3), (free.y + wind_y) / std::max(length, 1e-3)};
  blade.length = 12 + 26 * r(5) * r(5) + 8 * r(6);
  blade.bend = (r(7) - 0.5) * 0.9;
  blade.width = 0.7 + 0.75 * r(8);
  const double lush = 0.5 + 0.8 * fractal(blade.x / 70, blade.y / 70, 3, seed + 9);
  const Rgb green = mix(Rgb{0.13, 0.2, 0.03}, Rgb{0.05, 0.13, 0.018}, std::clamp(lush, 0.0, 1.0));
  const Rgb dry{0.42, 0.33, 0.14};
  blade.color =
      mix(green, dry, r(10) < 0.09 + 0.1 * (1 - std::clamp(lush, 0.0, 1.0)) ? 0.8 : 0.25 * r(11) * r(11));
  blade.color = blade.color * (0.7 + 0.6 * r(12));
  return blade;
}

void paint(Surface& surface, const Blade& blade, int oversampling) {
  const int side = surface.height.width();
  const int steps = static_cast<int>(blade.length * oversampling * 1.5);
  for (int step = 0; step <= steps; ++step) {
    const double t = static_cast<double>(step) / steps;
    const double along = blade.length * t, aside = blade.bend * blade.length * t * t;
    const double x = (blade.x + blade.lean.x * along - blade.lean.y * aside) * oversampling;
    const double y = (blade.y + blade.lean.y * along + blade.lean.x * aside) * oversampling;
    const double reach = blade.width * oversampling * (1 - 0.85 * t * t);
    const double rise = blade.base + 4.5 * t * (1.6 - t);
    for (int j = static_cast<int>(std::floor(y - reach)); j <= static_cast<int>(std::floor(y + reach)); ++j)
      for (int i = static_cast<int>(std::floor(x - reach)); i <= static_cast<int>(std::floor(x + reach));
           ++i) {
        if (i < 0 || j < 0 || i >= side || j >= side) continue;
        const double dx = i + 0.5 - x, dy = j + 0.5 - y;
        const double off = (dx * -blade.lean.y + dy * blade.lean.x) / std::max(reach, 0.3);
        if (dx * dx + dy * dy > reach * reach) continue;
        const double height = (rise - 0.35 * off * off) * oversampling;
        if (height < static_cast<double>(surface.height.texel(i, j)[0])) continue;
        surface.height.texel(i, j)[0] = static_cast<float>(height);
        const Rgb color = blade.color * (0.5 + 0.75 * t) * (1 + 0.22 * off);
        const auto albedo = surface.albedo.texel(i, j);
        albedo[0] = static_cast<float>(std::clamp(color.r, 0.0, 1.0));
        albedo[1] = static_cast<float>(std::clamp(color.g, 0.0, 1.0));
        albedo[2] = static_cast<float>(std::clamp(color.b, 0.0, 1.0));
      }
  }
}

} // namespace

Surface meadow(int size, int oversampling, std::uint64_t seed) {
  Surface surface = surface_of(size, oversampling, [seed](double x, double y) {
    const double crumbs = fractal(x / 4, y / 4, 3, seed + 20);
    return Point{-3 + crumbs, Rgb{0.09, 0.06, 0.035} * (1 + 0.6 * crumbs), 0.95};
  });
  const int count = size * size / 19;
  for (int index = 0; index < count; ++index) {
    Blade blade = blade_number(index, size, seed);
    blade.base = -3.5 + 5.5 * index / count;
    paint(surface, blade, oversampling);
  }
  return surface;
}

} // namespace samples
