#include "tilepack/layout/corner_grid.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <cstddef>

namespace tilepack {
CornerCell corner_cell(int left, int right, int up, int down) {
  return {tile_index_1d(left, right), tile_index_1d(up, down)};
}

CornerGrid corner_grid(int horizontal_colors, int vertical_colors) {
  for (const int colors : {horizontal_colors, vertical_colors})
    if (colors < 1 || colors > limits::most_edge_colors)
      throw Error(ErrorKind::usage, "corner pack",
                  fmt::format("{} edge colors; 1 to {}", colors, limits::most_edge_colors));
  CornerGrid grid{horizontal_colors * horizontal_colors, vertical_colors * vertical_colors, {}};
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int left = color_pair_at(column).first;
      const int up = color_pair_at(row).first;
      grid.tiles.push_back(
          id_in_complete_set(EdgeTile{left, up, left, up}, horizontal_colors, vertical_colors));
    }
  return grid;
}

Image corner_atlas(const std::vector<Image>& tiles, const CornerGrid& grid) {
  const Size tile = tiles.at(0).size();
  Image image(grid.columns * tile.width, grid.rows * tile.height, tiles.front().channels());
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int id = grid.tiles[static_cast<std::size_t>(row * grid.columns + column)];
      paste(image, tiles.at(static_cast<std::size_t>(id)), column * tile.width, row * tile.height);
    }
  return image;
}

} // namespace tilepack
