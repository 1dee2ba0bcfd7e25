// A weathered wall in running bond: no two bricks of one color, chipped edges, sandy mortar.

#include "noise.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>

namespace samples {
namespace {

constexpr double course = 32; // texels from course to course
constexpr double length = 96; // from brick to brick
constexpr double joint = 4.5; // width of the mortar

Rgb brick_color(double u, double v) {
  const Rgb red{0.32, 0.095, 0.055}, orange{0.43, 0.17, 0.08}, brown{0.17, 0.075, 0.05},
      dark{0.075, 0.055, 0.055};
  if (u < 0.5) return mix(red, orange, v);
  if (u < 0.85) return mix(red, brown, v);
  return mix(brown, dark, v);
}

Point mortar(double x, double y, std::uint64_t seed) {
  const double grit = noise(x / 1.1, y / 1.1, seed + 20);
  const double damp = fractal(x / 70, y / 70, 3, seed + 21);
  const Rgb color = mix(Rgb{0.33, 0.3, 0.26}, Rgb{0.2, 0.18, 0.155}, 0.5 + damp);
  return {0.35 * grit + 0.5 * fractal(x / 9, y / 9, 2, seed + 22), color * (1 + 0.25 * grit), 0.95};
}

} // namespace

Surface bricks(int size, int oversampling, std::uint64_t seed) {
  return surface_of(size, oversampling, [seed](double x, double y) {
    // The mason's hand: joints waver a little, slowly along the wall.
    const double wavering_y = y + 1.1 * noise(x / 90, y / 40, seed);
    const double wavering_x = x + 1.3 * noise(x / 40, y / 25, seed + 1);
    const auto row = static_cast<std::int64_t>(std::floor(wavering_y / course));
    const double shift = (row % 2 == 0 ? 0.0 : length / 2) + 8 * (random_at(row, 0, seed + 2) - 0.5);
    const auto column = static_cast<std::int64_t>(std::floor((wavering_x + shift) / length));
    const double u = wavering_x + shift - static_cast<double>(column) * length;
    const double v = wavering_y - static_cast<double>(row) * course;

    const Point bed = mortar(x, y, seed);
    const double inset_x = std::min(u, length - u) - joint / 2 - 1.2 * random_at(column, row, seed + 3);
    const double inset_y = std::min(v, course - v) - joint / 2 - 0.8 * random_at(column, row, seed + 4);
    const double chips = 1.6 * fractal(x / 6, y / 6, 3, seed + 5) +
                         4.0 * std::max(0.0, fractal(x / 13, y / 13, 2, seed + 6) - 0.25);
    // Rounded corners: the distance to a rectangle shrunk by 2 texels.
    const double a = std::max(0.0, 2.5 - inset_x), b = std::max(0.0, 2.5 - inset_y);
    const double inset = std::min({std::min(inset_x, inset_y), 2.5 - std::sqrt(a * a + b * b), 6.0}) - chips;
    if (inset <= 0) return bed;

    const double tilt = (random_at(column, row, seed + 7) - 0.5) * 0.03 * (u - length / 2) +
                        (random_at(column, row, seed + 8) - 0.5) * 0.06 * (v - course / 2);
    const double rough = fractal(x / 3.2, y / 2.6, 3, seed + 9);
    const double pit = smooth_step(0.42, 0.6, noise(x / 2.3, y / 2.3, seed + 10));
    const double height = 2.4 * smooth_step(0, 2.2, inset) + 0.9 * random_at(column, row, seed + 11) + tilt +
                          0.45 * rough - 0.9 * pit;
    if (height <= bed.height) return bed;

    Rgb color = brick_color(random_at(column, row, seed + 12), random_at(column, row, seed + 13));
    const double burnt =
        fractal(u / 30 + 7 * static_cast<double>(column), v / 20 + static_cast<double>(row), 3, seed + 14);
    color = color * (1 + 0.8 * burnt) * (1 + 0.3 * rough);
    const double lime = smooth_step(0.18, 0.5, fractal(x / 22, y / 15, 4, seed + 15)) *
                        smooth_step(0.3, 0.8, random_at(column, row, seed + 16));
    color = mix(color, Rgb{0.46, 0.4, 0.34}, 0.55 * lime);
    return Point{height, mix(color, Rgb{0.08, 0.05, 0.04}, 0.5 * pit), 0.9};
  });
}

} // namespace samples
