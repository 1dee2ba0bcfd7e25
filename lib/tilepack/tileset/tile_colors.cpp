#include "tilepack/tileset/tile_colors.h"

#include "tilepack/tileset/limits.h"

#include <algorithm>
#include <utility>

namespace tilepack {

std::vector<EdgeTile> complete_edge_set(int horizontal_colors, int vertical_colors) {
  std::vector<EdgeTile> tiles;
  for (int north = 0; north < horizontal_colors; ++north)
    for (int east = 0; east < vertical_colors; ++east)
      for (int south = 0; south < horizontal_colors; ++south)
        for (int west = 0; west < vertical_colors; ++west) tiles.push_back({north, east, south, west});
  return tiles;
}

std::vector<CornerTile> complete_corner_set(int corner_colors) {
  std::vector<CornerTile> tiles;
  for (int nw = 0; nw < corner_colors; ++nw)
    for (int ne = 0; ne < corner_colors; ++ne)
      for (int sw = 0; sw < corner_colors; ++sw)
        for (int se = 0; se < corner_colors; ++se) tiles.push_back({nw, ne, sw, se});
  return tiles;
}

namespace {

template <typename Tile>
TileColors repeated(const std::vector<Tile>& set, int times) {
  std::vector<Tile> tiles;
  for (int i = 0; i < times; ++i) tiles.insert(tiles.end(), set.begin(), set.end());
  return tiles;
}

// How many complete sets of these colors the tiles are, one after the other; 0 where they are anything else.
// Counting first: the complete set of the colors at hand may be far larger than the tiles, or than an int.
int copies_of_complete_set(const TileColors& tiles, ColorCounts k) {
  const long long one = k.corner > 0 ? 1LL * k.corner * k.corner * k.corner * k.corner
                                     : 1LL * k.horizontal * k.horizontal * k.vertical * k.vertical;
  const long long count = tile_count(tiles);
  if (count == 0 || one > count || count % one != 0 || count / one > limits::most_variants) return 0;
  k.variants = static_cast<int>(count / one);
  return tiles == complete_set(k) ? k.variants : 0;
}

} // namespace

int combinations(const ColorCounts& k) {
  return k.corner > 0 ? k.corner * k.corner * k.corner * k.corner
                      : k.horizontal * k.horizontal * k.vertical * k.vertical;
}

int whole_copies(std::size_t tiles, int combinations) {
  const auto one = static_cast<std::size_t>(combinations);
  if (combinations <= 0 || tiles == 0 || tiles % one != 0 || tiles / one > limits::most_variants) return 1;
  return static_cast<int>(tiles / one);
}

TileColors complete_set(const ColorCounts& k) {
  return k.corner > 0 ? repeated(complete_corner_set(k.corner), k.variants)
                      : repeated(complete_edge_set(k.horizontal, k.vertical), k.variants);
}

int id_in_complete_set(const EdgeTile& tile, int horizontal_colors, int vertical_colors) {
  return ((tile.north * vertical_colors + tile.east) * horizontal_colors + tile.south) * vertical_colors +
         tile.west;
}

int id_in_complete_set(const CornerTile& tile, int corner_colors) {
  return ((tile.nw * corner_colors + tile.ne) * corner_colors + tile.sw) * corner_colors + tile.se;
}

ColorCounts color_counts(const TileColors& tiles) {
  ColorCounts counts;
  if (const auto* edges = std::get_if<std::vector<EdgeTile>>(&tiles))
    for (const EdgeTile& t : *edges) {
      counts.horizontal = std::max({counts.horizontal, t.north + 1, t.south + 1});
      counts.vertical = std::max({counts.vertical, t.west + 1, t.east + 1});
    }
  else
    for (const CornerTile& t : std::get<std::vector<CornerTile>>(tiles))
      counts.corner = std::max({counts.corner, t.nw + 1, t.ne + 1, t.sw + 1, t.se + 1});
  counts.variants = std::max(1, copies_of_complete_set(tiles, counts));
  return counts;
}

bool is_complete_set(const TileColors& tiles) {
  return copies_of_complete_set(tiles, color_counts(tiles)) > 0;
}

int tile_count(const TileColors& tiles) {
  return static_cast<int>(std::visit([](const auto& list) { return list.size(); }, tiles));
}

Coloring coloring_of(const TileColors& tiles) {
  return std::holds_alternative<std::vector<EdgeTile>>(tiles) ? Coloring::edge : Coloring::corner;
}

} // namespace tilepack
