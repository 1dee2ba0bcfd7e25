#include "tilepack/layout/tile_index.h"

#include "tilepack/error/error.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {
// The strip is an Euler circuit of the complete directed graph on the colors (loops included), so that every
// pair (a, b) is walked once. Color m adds to the circuit of the colors below it the detour
//
//   0 → m → 1 → m → 2 → … → m-1 → m → m → 0
//
// whose 2m + 1 steps fill the places m² .. (m+1)² - 1. Read off: (a, m) is step 2a, (m, b) step 2b - 1,
// (m, m) the last but one, (m, 0) the last.
int tile_index_1d(int a, int b) {
  if (a < b) return b * b + 2 * a;
  if (a == b) return a > 0 ? (a + 1) * (a + 1) - 2 : 0;
  return b > 0 ? a * a + 2 * b - 1 : (a + 1) * (a + 1) - 1;
}

ColorPair color_pair_at(int index) {
  int m =
      0; // the largest color of the pair: floor of the square root; colors are few, so counting up is fine
  while ((m + 1) * (m + 1) <= index) ++m;
  const int step = index - m * m;
  if (step == 2 * m) return {m, 0};
  if (step == 2 * m - 1) return {m, m};
  if (step % 2 == 0) return {step / 2, m};
  return {m, (step + 1) / 2};
}

Layout tile_index_layout(const std::vector<EdgeTile>& complete_set) {
  int horizontal = 0;
  int vertical = 0;
  for (const EdgeTile& tile : complete_set) {
    for (const int color : {tile.north, tile.east, tile.south, tile.west})
      if (color < 0 || color >= limits::most_edge_colors)
        throw Error(
            ErrorKind::usage, "layout tile-index",
            fmt::format("edge color {}; colors are 0 to {} here", color, limits::most_edge_colors - 1));
    horizontal = std::max({horizontal, tile.north + 1, tile.south + 1});
    vertical = std::max({vertical, tile.west + 1, tile.east + 1});
  }
  Layout layout;
  layout.kind = LayoutKind::tile_index;
  layout.columns = vertical * vertical;
  const int variant_rows = horizontal * horizontal;
  const int copies = whole_copies(complete_set.size(), layout.columns * variant_rows);
  layout.rows = copies * variant_rows;

  std::vector<int> taken(static_cast<std::size_t>(layout.columns) * static_cast<std::size_t>(layout.rows),
                         -1);
  for (std::size_t id = 0; id < complete_set.size(); ++id) {
    const EdgeTile& tile = complete_set[id];
    const Cell cell{static_cast<int>(id), tile_index_1d(tile.west, tile.east),
                    tile_index_1d(tile.north, tile.south) +
                        static_cast<int>(id) * copies / static_cast<int>(complete_set.size()) * variant_rows};
    int& owner = taken[static_cast<std::size_t>(cell.row * layout.columns + cell.column)];
    if (owner >= 0)
      throw Error(
          ErrorKind::invalid_content, "layout tile-index",
          fmt::format("tiles {} and {} have the same edge colors (north {}, east {}, south {}, west {}); "
                      "this layout holds each combination once",
                      owner, id, tile.north, tile.east, tile.south, tile.west));
    owner = static_cast<int>(id);
    layout.cells.push_back(cell);
  }
  const auto gap = std::find(taken.begin(), taken.end(), -1);
  if (gap != taken.end() || taken.empty()) {
    const int place = static_cast<int>(gap - taken.begin());
    const ColorPair across = color_pair_at(layout.columns > 0 ? place % layout.columns : 0);
    const ColorPair down = color_pair_at(layout.columns > 0 ? place / layout.columns % variant_rows : 0);
    throw Error(
        ErrorKind::invalid_content, "layout tile-index",
        fmt::format("no tile has north {}, east {}, south {}, west {}; this layout needs all {} "
                    "combinations of {} horizontal and {} vertical colors; rotated and array do with fewer",
                    down.first, across.second, down.second, across.first, taken.size(), horizontal,
                    vertical));
  }
  return layout;
}

} // namespace tilepack
