#include "tilepack/tileset/border_agreement.h"

#include "tilepack/tileset/border_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace tilepack {
namespace {

constexpr std::array side_names{"north", "east", "south", "west"};

std::array<int, 4> sides_of(const BorderColors& b) {
  return {b.north, b.east, b.south, b.west};
}

std::string color_text(const TileColors& tiles, std::size_t tile, std::size_t side) {
  if (const auto* corners = std::get_if<std::vector<CornerTile>>(&tiles)) {
    const CornerTile& t = (*corners)[tile];
    const int ends[4][2] = {{t.nw, t.ne}, {t.ne, t.se}, {t.sw, t.se}, {t.nw, t.sw}};
    return "corner colors " + std::to_string(ends[side][0]) + ", " + std::to_string(ends[side][1]);
  }
  return "color " + std::to_string(sides_of(border_colors(tiles)[tile])[side]);
}

struct Place {
  int x;
  int y;
};

// Texel i of the row `depth` texels in from a side, from west to east or from north to south.
Place place_of(Size size, std::size_t side, int depth, int i) {
  switch (side) {
  case 0:
    return {i, depth};
  case 1:
    return {size.width - 1 - depth, i};
  case 2:
    return {i, size.height - 1 - depth};
  default:
    return {depth, i};
  }
}

// Compares one row of every tile with that of the first tile of its color; `use` gets tile, reference, side
// and a callable that compares texel by texel.
template <typename Use>
void for_each_pair(const TileSet& set, Use&& use) {
  const std::vector<BorderColors> borders = border_colors(set.tiles);
  for (std::size_t side = 0; side < 4; ++side) {
    std::map<int, std::size_t> first;
    for (std::size_t tile = 0; tile < borders.size(); ++tile) {
      const auto [known, fresh] = first.try_emplace(sides_of(borders[tile])[side], tile);
      if (!fresh) use(tile, known->second, side);
    }
  }
}

} // namespace

std::vector<BorderDifference> border_differences(const TileSet& set, double tolerance) {
  std::vector<BorderDifference> found;
  const int skip = coloring_of(set.tiles) == Coloring::edge ? 1 : 0;
  for (const TileMap& map : set.maps)
    for_each_pair(set, [&](std::size_t tile, std::size_t reference, std::size_t side) {
      BorderDifference worst;
      const int length = side % 2 == 0 ? set.tile_size.width : set.tile_size.height;
      for (int i = skip; i < length - skip; ++i) {
        const Place at = place_of(set.tile_size, side, 0, i);
        const auto a = map.tiles[tile].texel(at.x, at.y);
        const auto b = map.tiles[reference].texel(at.x, at.y);
        bool differs = false;
        for (std::size_t c = 0; c < a.size(); ++c) {
          const double d = std::fabs(static_cast<double>(a[c]) - static_cast<double>(b[c]));
          if (!(d > tolerance)) continue;
          differs = true;
          if (d > worst.difference) {
            worst.x = at.x;
            worst.y = at.y;
            worst.channel = static_cast<int>(c);
            worst.difference = d;
          }
        }
        worst.texels += differs ? 1 : 0;
      }
      if (worst.texels == 0) return;
      worst.map = map.name;
      worst.tile = static_cast<int>(tile);
      worst.reference = static_cast<int>(reference);
      worst.side = side_names[side];
      worst.color = color_text(set.tiles, tile, side);
      found.push_back(std::move(worst));
    });
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.difference > b.difference; });
  return found;
}

int agreed_guard(const TileSet& set) {
  const int most = std::max(1, std::min(set.tile_size.width, set.tile_size.height) / 8);
  const bool edge = coloring_of(set.tiles) == Coloring::edge;
  for (int depth = 0; depth < most; ++depth) {
    bool agree = true;
    const int skip = edge ? depth + 1 : 0;
    for (const TileMap& map : set.maps)
      for_each_pair(set, [&](std::size_t tile, std::size_t reference, std::size_t side) {
        const int length = side % 2 == 0 ? set.tile_size.width : set.tile_size.height;
        for (int i = skip; i < length - skip && agree; ++i) {
          const Place at = place_of(set.tile_size, side, depth, i);
          const auto a = map.tiles[tile].texel(at.x, at.y);
          const auto b = map.tiles[reference].texel(at.x, at.y);
          agree = std::equal(a.begin(), a.end(), b.begin());
        }
      });
    if (!agree) return depth;
  }
  return most;
}

} // namespace tilepack
