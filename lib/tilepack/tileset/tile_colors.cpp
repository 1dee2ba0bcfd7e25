#include "tilepack/tileset/tile_colors.h"

#include <algorithm>

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
  return counts;
}

bool is_complete_set(const TileColors& tiles) {
  const ColorCounts k = color_counts(tiles);
  const bool edge = coloring_of(tiles) == Coloring::edge;
  // Counting first: the complete set of the colors at hand may be far larger than the set.
  const long long complete = edge ? 1LL * k.horizontal * k.horizontal * k.vertical * k.vertical
                                  : 1LL * k.corner * k.corner * k.corner * k.corner;
  if (complete != tile_count(tiles)) return false;
  return tiles == (edge ? TileColors(complete_edge_set(k.horizontal, k.vertical))
                        : TileColors(complete_corner_set(k.corner)));
}

int tile_count(const TileColors& tiles) {
  return static_cast<int>(std::visit([](const auto& list) { return list.size(); }, tiles));
}

Coloring coloring_of(const TileColors& tiles) {
  return std::holds_alternative<std::vector<EdgeTile>>(tiles) ? Coloring::edge : Coloring::corner;
}

} // namespace tilepack
