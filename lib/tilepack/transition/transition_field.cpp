#include "tilepack/transition/transition_field.h"

#include "tilepack/numeric/random.h"
#include "tilepack/tileset/limits.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

constexpr double edge_reach = 0.16; // of a tile: how far from an edge its own noise fades out
// Of the noise inside tiles: all borders that cross an edge between two colors cross it at one place, and the further off
// that is from its middle, the more it shows that they come back to it.
constexpr double edge_noise_share = 0.3;
constexpr double fine_wave = 0.42; // of the long wave
constexpr double fine_share = 0.4; // of the long wave's height
constexpr int most_takes = 64;

double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Values at the points of a square lattice, smoothly between them: -1..1.
double value_noise(std::uint64_t seed, std::uint64_t of, double x, double y) {
  const double left = std::floor(x);
  const double top = std::floor(y);
  const auto value = [&](double i, double j) {
    const auto place = static_cast<std::uint64_t>(static_cast<std::int64_t>(j) + (1 << 20)) << 24 |
                       static_cast<std::uint64_t>(static_cast<std::int64_t>(i) + (1 << 20));
    return static_cast<double>(mixed(seed ^ mixed(of ^ mixed(place))) >> 40) / (1 << 23) - 1;
  };
  const double s = smooth(x - left);
  const double t = smooth(y - top);
  const double upper = value(left, top) * (1 - s) + value(left + 1, top) * s;
  const double lower = value(left, top + 1) * (1 - s) + value(left + 1, top + 1) * s;
  return upper * (1 - t) + lower * t;
}

} // namespace

TransitionField::TransitionField(Size tile_size, int colors, double how_rough, double long_wave,
                                 std::uint64_t of)
    : tile(tile_size), colors_of_material(colors), roughness(how_rough), wave(long_wave),
      seed(random_bits(of, "transition", 0)) {}

double TransitionField::noise(std::uint64_t of, double x, double y) const {
  return value_noise(seed, of, x / wave, y / wave) +
         fine_share * value_noise(seed, of + 1, x / (fine_wave * wave), y / (fine_wave * wave));
}

double TransitionField::edge_noise(bool horizontal, int first, int second, int material, double along,
                                   double across) const {
  const auto of = static_cast<std::uint64_t>(
      2 *
      (((horizontal ? 1 : 0) * limits::most_corner_colors + first) * limits::most_corner_colors + second));
  // What one of the two materials gains the other loses, so a border is moved as far as both say.
  const double sign = material == material_of(std::min(first, second)) ? 1 : -1;
  // A border moves by as much of the edge as both weights together change.
  const double shift = material == material_of(first) ? shifts[shift_index(horizontal, first, second)]
                                                      : -shifts[shift_index(horizontal, first, second)];
  return shift / std::max(0.05, roughness) + sign * edge_noise_share * noise(of, along, across);
}

double TransitionField::weight(const CornerTile& c, int variant, int take, int material, int x, int y) const {
  const double u = (x + 0.5) / tile.width;
  const double v = (y + 0.5) / tile.height;
  const auto is = [&](int corner) { return material_of(corner) == material ? 1.0 : 0.0; };
  const double bilinear =
      (is(c.nw) * (1 - u) + is(c.ne) * u) * (1 - v) + (is(c.sw) * (1 - u) + is(c.se) * u) * v;
  const auto near = [](double distance) { return 1 - smooth(distance / edge_reach); };
  const double north = near(v), south = near(1 - v), west = near(u), east = near(1 - u);
  const double px = x + 0.5, py = y + 0.5;
  const auto edge = [&](bool horizontal, int first, int second, double along, double across) {
    const int here = material_of(first);
    const int there = material_of(second);
    const bool meets = here != there && (material == here || material == there);
    return meets ? edge_noise(horizontal, first, second, material, along, across) : 0.0;
  };
  double moved = 0;
  if (north > 0) moved += north * edge(true, c.nw, c.ne, px, py);
  if (south > 0) moved += south * edge(true, c.sw, c.se, px, py - tile.height);
  if (west > 0) moved += west * edge(false, c.nw, c.sw, py, px);
  if (east > 0) moved += east * edge(false, c.ne, c.se, py, px - tile.width);
  const double of_edges = north + south + west + east;
  moved /= std::max(1.0, of_edges);
  if (of_edges < 1) {
    const int own =
        (id_in_complete_set(c, limits::most_corner_colors) * limits::most_variants + variant) * most_takes +
        take;
    const auto of = static_cast<std::uint64_t>(5000 + 2 * (limits::most_corner_colors * own + material));
    moved += (1 - of_edges) * noise(of, px, py);
  }
  return bilinear + roughness * moved;
}

double TransitionField::edge_weight(bool horizontal, int first, int second, int material, int along,
                                    int across) const {
  const double u = (along + 0.5) / (horizontal ? tile.width : tile.height);
  const double straight =
      (material == material_of(first) ? 1 - u : 0.0) + (material == material_of(second) ? u : 0.0);
  if (material_of(first) == material_of(second)) return straight;
  return straight + roughness * edge_noise(horizontal, first, second, material, along + 0.5, across + 0.5);
}

} // namespace tilepack
