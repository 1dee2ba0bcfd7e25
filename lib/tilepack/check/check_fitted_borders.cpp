#include "tilepack/check/level_view.h"
#include "tilepack/check/structure_checks.h"
#include "tilepack/layout/place_tiles.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/mip/mip_chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tilepack {
namespace {

// Of the range. The level is rounded, and level 0 was, so twice half a code at the least; where it was measured (eleven
// packs of photos and elevations of 8 and 16 bits and of half floats, weights from 0 to 1000, effort 0) the most was half a code.
constexpr double largest_difference = 2.0 / 255;

bool finite(const Image& image) {
  return std::all_of(image.data().begin(), image.data().end(), [](float v) { return std::isfinite(v); });
}

struct Difference {
  double most = 0;
  Size at;
};

Difference ring_difference(const Image& is, const Image& should) {
  Difference difference;
  const auto look_at = [&](int x, int y) {
    const auto a = is.texel(x, y);
    const auto b = should.texel(x, y);
    for (std::size_t c = 0; c < a.size(); ++c)
      if (const double d = std::abs(double{a[c]} - double{b[c]}); d > difference.most)
        difference = {d, {x, y}};
  };
  for (int x = 0; x < is.width(); ++x)
    for (const int y : {0, is.height() - 1}) look_at(x, y);
  for (int y = 0; y < is.height(); ++y)
    for (const int x : {0, is.width() - 1}) look_at(x, y);
  return difference;
}

void check_fitted_map(const Pack& pack, const PackedMap& map, std::vector<Issue>& issues) {
  const int levels = std::min(static_cast<int>(map.levels.size()), level_count(pack.tile_size));
  for (int level = 0; level < levels; ++level) {
    const Image& image = map.levels[static_cast<std::size_t>(level)];
    if (!has_right_size(pack, image, level) || image.channels() != map.channels) return;
  }
  if (levels < 2 || !finite(map.levels.front())) return;
  TileSet set{pack.tile_size, pack.colors, pack.tiles, {}, pack.guard};
  set.maps.push_back({map, tiles_at_level(map.levels.front(), pack.layout, pack.tile_size, 0)});
  const std::vector<TileMap> fitted = coarser_levels(
      set, 0, {.mode = MipMode::least_squares, .jump_weight = *pack.jump_weight}, &pack.layout);
  const double range = full_range(map);
  for (int level = 1; level < levels; ++level) {
    if (exact_through_guard(pack.guard, level)) continue; // check_texels and check_chain hold those
    const std::vector<Image> stored =
        tiles_at_level(map.levels[static_cast<std::size_t>(level)], pack.layout, pack.tile_size, level);
    for (std::size_t id = 0; id < stored.size(); ++id) {
      const Difference found =
          ring_difference(stored[id], fitted[static_cast<std::size_t>(level - 1)].tiles[id]);
      if (found.most <= largest_difference * range) continue;
      issues.push_back({Rule::fitted_border, fmt::format("{}, tile {}", place_name(map, level), id),
                        fmt::format("texel ({}, {}) of the tile is {:.3g}/255 of the range off the fit",
                                    found.at.width, found.at.height, found.most / range * 255),
                        fmt::format("at most {:.2g}/255, what rounding explains", largest_difference * 255)});
    }
  }
}

} // namespace

std::vector<Issue> check_fitted_borders(const Pack& pack) {
  std::vector<Issue> issues;
  if (pack.mip_mode != MipMode::least_squares || !pack.jump_weight) return issues;
  if (pack.layout.kind == LayoutKind::rotated || !places_are_sound(pack.layout, tile_count(pack.tiles)) ||
      !check_tiles(pack).empty() || !check_layout(pack).empty())
    return issues;
  for (const PackedMap& map : pack.maps)
    if (plain_boxes(map) && !map.levels.empty()) check_fitted_map(pack, map, issues);
  return issues;
}

} // namespace tilepack
