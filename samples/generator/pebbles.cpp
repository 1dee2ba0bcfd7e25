// Stones from a river, of four sizes, lying on coarse sand.

#include "noise.h"
#include "scenes.h"

#include <array>
#include <cmath>

namespace samples {
namespace {

struct Layer {
  double spacing; // texels between stones
  double radius;  // of the largest, in spacings
  double rise;    // how far the centre lies above the sand, in radii
  double share;   // of places that hold a stone
};

constexpr std::array<Layer, 4> layers{
    {{46, 0.66, 0.35, 0.9}, {27, 0.64, 0.1, 0.95}, {13, 0.6, 0.0, 0.95}, {5, 0.62, 0.0, 1.0}}};

Rgb stone_color(double u, double v) {
  const Rgb slate{0.17, 0.18, 0.19}, warm{0.34, 0.27, 0.2}, pale{0.52, 0.48, 0.42}, dark{0.08, 0.08, 0.085};
  if (u < 0.45) return mix(slate, dark, v * 0.8);
  if (u < 0.8) return mix(slate, warm, 0.3 + 0.7 * v);
  return mix(warm, pale, v);
}

Point sand(double x, double y, std::uint64_t seed) {
  const double grit = noise(x * 0.9, y * 0.9, seed + 40);
  const double drift = fractal(x / 60, y / 60, 3, seed + 41);
  return {-4 + 0.7 * grit + 2 * drift, mix(Rgb{0.13, 0.1, 0.07}, Rgb{0.26, 0.21, 0.15}, 0.5 + 0.5 * grit),
          0.95};
}

// Raises `point` to the stone of cell (i, j) of a layer if that lies above it there.
void lay_stone(Point& point, double x, double y, const Layer& layer, std::int64_t i, std::int64_t j,
               std::uint64_t seed) {
  if (random_at(i, j, seed) > layer.share) return;
  const double centre_x = (static_cast<double>(i) + 0.15 + 0.7 * random_at(i, j, seed + 1)) * layer.spacing;
  const double centre_y = (static_cast<double>(j) + 0.15 + 0.7 * random_at(i, j, seed + 2)) * layer.spacing;
  const double radius = layer.spacing * layer.radius * (0.62 + 0.38 * random_at(i, j, seed + 3));
  const double flatness = 0.62 + 0.33 * random_at(i, j, seed + 4);
  const Direction axis = direction_at(i, j, seed + 5);
  const double u = ((x - centre_x) * axis.x + (y - centre_y) * axis.y) / radius;
  const double v = ((y - centre_y) * axis.x - (x - centre_x) * axis.y) / (radius * flatness);
  if (u * u + v * v > 1.7) return;
  const double bumps =
      fractal(u * 1.3 + static_cast<double>(i), v * 1.3 + static_cast<double>(j), 2, seed + 6);
  const double distance = u * u + v * v + 0.35 * bumps;
  if (distance >= 1) return;
  const double dome = std::sqrt(1 - distance * distance); // flatter on top than a ball
  const double lift = layer.rise + 0.5 * random_at(i, j, seed + 7);
  const double pits = fractal(x / 2.2, y / 2.2, 2, seed + 8);
  const double height = radius * (0.62 * dome + lift - 0.3) + 0.12 * pits;
  if (height <= point.height) return;
  const Rgb base = stone_color(random_at(i, j, seed + 9), random_at(i, j, seed + 10));
  const double stain = fractal(x / 9 + 31, y / 9, 4, seed + 11 + static_cast<std::uint64_t>(i & 7));
  const double speck = smooth_step(0.35, 0.6, noise(x / 1.3, y / 1.3, seed + 12));
  const double vein =
      smooth_step(0.06, 0.0, std::abs(fractal(u + 9 * static_cast<double>(j), v, 3, seed + 13)));
  Rgb color = base * (1 + 0.55 * stain) + Rgb{0.1, 0.1, 0.09} * speck;
  if (random_at(i, j, seed + 14) < 0.25) color = mix(color, Rgb{0.5, 0.48, 0.45}, 0.6 * vein);
  point = {height, color, 0.6};
}

} // namespace

Surface pebbles(int size, int oversampling, std::uint64_t seed) {
  return surface_of(size, oversampling, [seed](double x, double y) {
    Point point = sand(x, y, seed);
    for (std::size_t k = 0; k < layers.size(); ++k) {
      const auto i = static_cast<std::int64_t>(std::floor(x / layers[k].spacing));
      const auto j = static_cast<std::int64_t>(std::floor(y / layers[k].spacing));
      for (std::int64_t dj = -1; dj <= 1; ++dj)
        for (std::int64_t di = -1; di <= 1; ++di)
          lay_stone(point, x, y, layers[k], i + di, j + dj, seed + 100 * (k + 1));
    }
    return point;
  });
}

} // namespace samples
