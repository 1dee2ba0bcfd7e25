#include "tilepack/tileset/border_agreement.h"

#include "tilepack/tileset/border_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
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

// The colors of the edges that meet at a corner, and its texels counted from there: `east` and `south` tell
// which corner it is.
struct Corner {
  bool east;
  bool south;

  std::pair<int, int> colors(const BorderColors& b) const {
    return {south ? b.south : b.north, east ? b.east : b.west};
  }
  std::span<const float> texel(const Image& tile, int i, int j) const {
    return tile.texel(east ? tile.width() - 1 - i : i, south ? tile.height() - 1 - j : j);
  }
};

constexpr std::array corners{Corner{false, false}, Corner{true, false}, Corner{false, true},
                             Corner{true, true}};

bool corner_texels_shared(const TileSet& set) {
  for (const TileMap& map : set.maps)
    for (const Corner& corner : corners)
      for (const Image& tile : map.tiles)
        if (!std::ranges::equal(corner.texel(tile, 0, 0), corner.texel(map.tiles.front(), 0, 0)))
          return false;
  return true;
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

double agreed_corner_width(const TileSet& set) {
  if (coloring_of(set.tiles) == Coloring::corner || corner_texels_shared(set)) return 0;
  const std::vector<BorderColors> borders = border_colors(set.tiles);
  const int half = std::min(set.tile_size.width, set.tile_size.height) / 2;
  double nearest = half; // lookup that reads a texel in which such tiles differ
  for (const Corner& corner : corners) {
    std::map<std::pair<int, int>, std::size_t> first;
    for (std::size_t id = 0; id < borders.size(); ++id) {
      const auto [known, fresh] = first.try_emplace(corner.colors(borders[id]), id);
      if (fresh) continue;
      for (const TileMap& map : set.maps)
        for (int j = 0; j <= half; ++j)
          for (int i = 0; i <= half; ++i) {
            // A texel counts for lookups less than one texel from its centre along both axes.
            const double x = std::max(0.0, i - 0.5);
            const double y = std::max(0.0, j - 0.5);
            const double distance = std::sqrt(x * x + y * y);
            if (distance < nearest && !std::ranges::equal(corner.texel(map.tiles[id], i, j),
                                                          corner.texel(map.tiles[known->second], i, j)))
              nearest = distance;
          }
    }
  }
  constexpr double mending =
      3.25; // twice sqrt(0.5² + 1.5²), where a filter last reads a corner beyond a border
  const double width = std::max(nearest, std::min({2 * nearest, mending, static_cast<double>(half)}));
  return std::floor(4 * width) / 4;
}

} // namespace tilepack
