// Split slate: layered ledges broken along joints, lichen on the flats. Made as a material, so its color
// carries no light.

#include "noise.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>

namespace samples {

Surface rock(int size, int oversampling, std::uint64_t seed) {
  return surface_of(size, oversampling, [seed](double x, double y) {
    const double wx = x + 16 * fractal(x / 70, y / 70, 4, seed),
                 wy = y + 16 * fractal(x / 70, y / 70, 4, seed + 9);
    // Ledges: a slow slope cut into steps, each step's edge ragged.
    const double slope = 3.2 * fractal(wx / 95, wy / 60, 4, seed + 20) + 0.012 * wy;
    const double layer = slope * 4;
    const double within = layer - std::floor(layer);
    const double ledge = (std::floor(layer) + smooth_step(0.72, 1.0, within) + 0.18 * within) / 4;
    const Cells blocks = cells(wx / 44, wy / 30, seed + 30);
    const double block = static_cast<double>(blocks.id >> 40) / 16777216.0;
    const double joint = smooth_step(0.09, 0.01, blocks.second - blocks.nearest);
    const double chip = fractal(x / 9, y / 6, 5, seed + 40);
    const double fine = noise(x / 1.4, y / 1.2, seed + 50);
    const double height = 13 * ledge + 3.2 * block + 2.6 * chip + 0.3 * fine - 3.5 * joint;

    const double tone = 0.5 + 0.5 * fractal(x / 26, y / 14, 4, seed + 60) + 0.3 * (block - 0.5);
    Rgb color = mix(Rgb{0.085, 0.095, 0.105}, Rgb{0.24, 0.235, 0.225}, std::clamp(tone, 0.0, 1.0));
    const double rust = smooth_step(0.12, 0.5, fractal(x / 40, y / 22, 4, seed + 70));
    color = mix(color, Rgb{0.25, 0.14, 0.07}, 0.55 * rust);
    const double lichen = smooth_step(0.2, 0.34, fractal(x / 17, y / 17, 5, seed + 80)) * (1 - joint) *
                          smooth_step(0.8, 0.5, within);
    color = mix(color, Rgb{0.36, 0.37, 0.27}, 0.75 * lichen);
    color = color * (1 + 0.3 * chip + 0.14 * fine);
    color = mix(color, Rgb{0.035, 0.033, 0.032}, 0.7 * joint);
    const double roughness = 0.55 + 0.3 * lichen + 0.2 * rust + 0.12 * chip + 0.15 * joint;
    return Point{height, color, roughness};
  });
}

} // namespace samples
