#include "tilepack/sampler/corner_blend.h"

#include "tilepack/layout/corner_grid.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace tilepack {
namespace {

const EdgeTile& edge_tile(const Pack& pack, std::int64_t x, std::int64_t y) {
  const auto& tiles = std::get<std::vector<EdgeTile>>(pack.tiles);
  return tiles[static_cast<std::size_t>(tile_at(pack.mapping, pack.colors, x, y))];
}

} // namespace

double corner_weight(double fraction_x, double fraction_y, Size tile, double width) {
  const double outer = std::min(width, 0.5 * std::min(tile.width, tile.height));
  const double inner = 0.5 * outer;
  const double x = (fraction_x < 0.5 ? fraction_x : 1.0 - fraction_x) * tile.width;
  const double y = (fraction_y < 0.5 ? fraction_y : 1.0 - fraction_y) * tile.height;
  const double distance = std::sqrt(x * x + y * y);
  if (!(distance < outer)) return 0.0;
  if (distance <= inner) return 1.0;
  const double t = (outer - distance) / (outer - inner);
  return t * t * (3.0 - 2.0 * t); // no slope at either end
}

CornerTexels::CornerTexels(const Pack& of_pack, int map, double width, int first_level, int last_level)
    : pack(&of_pack), texels(PackTexels::of_corners(of_pack, map, first_level, last_level)),
      blend_width(width) {}

double CornerTexels::weight(int level, double fraction_x, double fraction_y) const {
  const double widest = pack->corner_pack->width / static_cast<double>(1 << level);
  return corner_weight(fraction_x, fraction_y, texels.tile_size(level), std::min(blend_width, widest));
}

// The corner is lattice point (x, y). Edges that end in it: on its left the north edge of cell (x-1, y), on
// its right that of (x, y), above it the west edge of (x, y-1), below it that of (x, y). In the corner pack
// it is the south-east corner of its cell, so a point east of it lies one column on.
PackTexels::Place CornerTexels::place(std::int64_t cell_x, std::int64_t cell_y, double fraction_x,
                                      double fraction_y) const {
  const bool east = fraction_x < 0.5;
  const bool south = fraction_y < 0.5;
  const std::int64_t x = east ? cell_x : cell_x + 1;
  const std::int64_t y = south ? cell_y : cell_y + 1;
  const EdgeTile& below_right = edge_tile(*pack, x, y);
  const CornerCell cell = corner_cell(edge_tile(*pack, x - 1, y).north, below_right.north,
                                      edge_tile(*pack, x, y - 1).west, below_right.west);
  return {(cell.column + (east ? 1 : 0)) % pack->corner_pack->columns,
          (cell.row + (south ? 1 : 0)) % pack->corner_pack->rows, 0};
}

} // namespace tilepack
