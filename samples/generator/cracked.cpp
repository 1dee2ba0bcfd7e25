// A dried mud flat: plates of several sizes, curled at their rims, dust and grit on top.

#include "noise.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>

namespace samples {
namespace {

// Distance to the nearest crack in texels, for plates of about `spacing` texels. The borders of random cells
// are too straight to be cracks, so the plane is warped first, coarsely and finely.
struct Plate {
  double inset = 0;
  std::uint64_t id = 0;
};
Plate plate_at(double x, double y, double spacing, std::uint64_t seed) {
  const double warp = spacing * 0.22;
  const double wx = x + warp * fractal(x / (0.8 * spacing), y / (0.8 * spacing), 4, seed + 50);
  const double wy = y + warp * fractal(x / (0.8 * spacing), y / (0.8 * spacing), 4, seed + 60);
  const Cells cell = cells(wx / spacing, wy / spacing, seed);
  return {(cell.second - cell.nearest) * spacing * 0.5, cell.id};
}

} // namespace

Surface cracked(int size, int oversampling, std::uint64_t seed) {
  return surface_of(size, oversampling, [seed](double x, double y) {
    const Plate large = plate_at(x, y, 58, seed);
    const Plate small = plate_at(x, y, 24, seed + 7);
    const double own = static_cast<double>(large.id >> 40) / 16777216.0; // 0..1, one a plate

    const double wide = 1.3 + 1.1 * noise(x / 50, y / 50, seed + 1);
    const double gap = smooth_step(wide + 1.1, wide - 0.6, large.inset);
    const double hair =
        smooth_step(1.0, 0.25, small.inset) * smooth_step(-0.1, 0.25, noise(x / 45, y / 45, seed + 2));
    const double grain = noise(x / 1.2, y / 1.2, seed + 3);
    const double lumps = fractal(x / 11, y / 11, 4, seed + 4);
    const double curl = 1.8 * smooth_step(14, 2, large.inset);
    const double height = 2.2 + curl + 1.4 * (own - 0.5) + 1.2 * lumps + 0.25 * grain - 8 * gap - 1.4 * hair;

    Rgb color = mix(Rgb{0.42, 0.3, 0.2}, Rgb{0.5, 0.39, 0.28}, own);
    color = color * (1 + 0.45 * lumps + 0.16 * grain);
    const double dust = smooth_step(-0.1, 0.45, fractal(x / 33, y / 33, 4, seed + 5));
    color = mix(color, Rgb{0.56, 0.46, 0.35}, 0.45 * dust);
    color = mix(color, Rgb{0.3, 0.19, 0.12}, 0.5 * smooth_step(6, 1, large.inset) * (1 - gap));
    color = mix(color, Rgb{0.07, 0.045, 0.03}, 0.85 * gap);
    color = mix(color, Rgb{0.16, 0.1, 0.07}, 0.55 * hair);

    // Grit lies about, more of it in some places.
    const Cells stones = cells(x / 7, y / 7, seed + 6);
    const double pick = static_cast<double>(stones.id >> 40) / 16777216.0;
    const double radius = 0.05 + 0.22 * pick * pick;
    if (pick < 0.4 || stones.nearest > radius) return Point{height, color, 0.95};
    const double dome = std::sqrt(1 - stones.nearest * stones.nearest / (radius * radius));
    const double shade = static_cast<double>((stones.id >> 16) & 255) / 255.0;
    return Point{height + 7 * radius * dome,
                 mix(Rgb{0.26, 0.2, 0.15}, Rgb{0.55, 0.5, 0.43}, shade) * (1 + 0.2 * grain), 0.8};
  });
}

} // namespace samples
