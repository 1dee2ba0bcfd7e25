// Boards of weathered larch, their grain bent round knots.

#include "noise.h"
#include "scenes.h"

#include <algorithm>
#include <cmath>

namespace samples {
namespace {

constexpr double board_height = 64; // texels; boards run east-west
constexpr double knot_spacing = 150;

struct Knot {
  double distance = 1e9; // in knot radii
  double ring = 0;       // grows outward
  double bend = 0;       // texels by which the grain gives way
};

// Knots sit on a wide lattice along each board; the grain flows round them.
Knot knot_near(double x, double y, std::int64_t board, std::uint64_t seed) {
  Knot knot;
  const auto place = static_cast<std::int64_t>(std::floor(x / knot_spacing));
  for (std::int64_t i = place - 1; i <= place + 1; ++i) {
    if (random_at(i, board, seed) > 0.55) continue;
    const double centre_x = (static_cast<double>(i) + random_at(i, board, seed + 1)) * knot_spacing;
    const double centre_y = (0.25 + 0.5 * random_at(i, board, seed + 2)) * board_height;
    const double radius = 2.5 + 4.0 * random_at(i, board, seed + 3);
    const double dx = (x - centre_x) / (radius * 1.35), dy = (y - centre_y) / radius;
    const double distance = std::sqrt(dx * dx + dy * dy) + 0.22 * fractal(x / 5, y / 5, 2, seed + 4);
    const double side = dy / (0.6 + std::abs(dy)); // -1 above, 1 below
    const double along = 1 / (1 + 0.09 * dx * dx * dx * dx + 0.25 * dx * dx);
    knot.bend -= side * radius * 1.5 * along / (1 + 0.12 * dy * dy);
    if (distance < knot.distance) {
      knot.distance = distance;
      knot.ring = distance * radius;
    }
  }
  return knot;
}

} // namespace

Surface planks(int size, int oversampling, std::uint64_t seed) {
  return surface_of(size, oversampling, [seed](double x, double y) {
    const auto board = static_cast<std::int64_t>(std::floor(y / board_height));
    const auto tag = static_cast<std::uint64_t>(board + 1000);
    const double v = y - static_cast<double>(board) * board_height;
    const double start = 400 * random_at(board, 1, seed);
    const Knot knot = knot_near(x + start, v, board, seed + 30);

    // Year rings cut lengthwise: bands that drift slowly, closer together towards one edge of the board.
    const double drift = 9 * fractal((x + start) / 210, y / 60, 3, seed + tag) + knot.bend;
    const double across = v + drift + 14 * random_at(board, 2, seed);
    const double ring = across / (3.6 + 1.8 * random_at(board, 3, seed)) + 0.012 * across * across / 4;
    const double phase = ring - std::floor(ring);
    double late = smooth_step(0.35, 0.92, phase) * (1 - smooth_step(0.92, 1.0, phase)); // dark late wood
    late *= 0.75 + 0.5 * random_at(static_cast<std::int64_t>(std::floor(ring)), board, seed + 4);

    const double fibre = noise(x / 26, (y + 0.6 * drift) / 0.9, seed + 5);
    const double fine = noise(x / 9, (y + 0.6 * drift) / 0.55, seed + 6);
    const double check =
        smooth_step(0.66, 0.84, noise((x + start) / 55, (y + drift) / 1.7, seed + 7)); // drying cracks
    const double patina = fractal(x / 90, y / 45, 3, seed + 8 + tag);

    Rgb color = mix(Rgb{0.36, 0.22, 0.115}, Rgb{0.4, 0.3, 0.2}, random_at(board, 5, seed));
    color = color * (0.72 + 0.45 * random_at(board, 6, seed));
    color = mix(color, Rgb{0.145, 0.072, 0.034}, 0.62 * late);
    color = color * (1 + 0.2 * fibre + 0.14 * fine);
    color = mix(color, Rgb{0.26, 0.24, 0.22}, std::clamp(0.25 + 0.9 * patina, 0.0, 0.7));
    const double heart = smooth_step(1.25, 0.8, knot.distance);
    const double rim = smooth_step(0.5, 0.0, std::abs(knot.distance - 1.1));
    const double knot_ring = 0.5 + 0.5 * noise(knot.ring * 1.1, 0.5, seed + 9);
    color = mix(color, mix(Rgb{0.12, 0.055, 0.025}, Rgb{0.2, 0.1, 0.05}, knot_ring), heart);
    color = mix(color, Rgb{0.06, 0.03, 0.018}, 0.7 * rim);
    color = mix(color, Rgb{0.035, 0.022, 0.015}, 0.85 * check);

    const double edge =
        std::min(v, board_height - v) + 0.5 * noise(x / 30, static_cast<double>(board), seed + 10);
    const double body = smooth_step(0.4, 2.6, edge);
    const double height = 5 * body + 0.5 * late + 0.22 * fibre - 1.5 * check + 0.6 * heart +
                          1.2 * (random_at(board, 7, seed) - 0.5);
    return Point{height, mix(Rgb{0.02, 0.014, 0.01}, color, smooth_step(0.2, 1.4, edge)), 0.75};
  });
}

} // namespace samples
