#include "tilepack/sampler/corner_blend.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
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
    : texels(PackTexels::of_corners(of_pack, map, first_level, last_level)), blend_width(width),
      widest(of_pack.corner_pack->width) {}

double CornerTexels::weight(int level, double fraction_x, double fraction_y) const {
  const int of_tiles = std::min(level, texels.levels() - 1); // far levels go on as the last
  const double here = widest / static_cast<double>(1 << of_tiles);
  return corner_weight(fraction_x, fraction_y, texels.tile_size(of_tiles), std::min(blend_width, here));
}

// The corner is lattice point (x, y). In the corner pack it is the south-east corner of its cell, so a point
// east of it lies one column on.
PackTexels::Place CornerTexels::place(std::int64_t cell_x, std::int64_t cell_y, double fraction_x,
                                      double fraction_y) const {
  const std::uint32_t east = fraction_x < 0.5 ? 1 : 0;
  const std::uint32_t south = fraction_y < 0.5 ? 1 : 0;
  LatticeCell point = cell_at(lookup().lattice, cell_x, cell_y);
  if (east == 0) point.x = next_cell(point.x, lookup().lattice.width);
  if (south == 0) point.y = next_cell(point.y, lookup().lattice.height);
  const TexturePlace place = corner_place(lookup(), point);
  return {static_cast<int>((place.column + east) % lookup().corner_columns),
          static_cast<int>((place.row + south) % lookup().corner_rows), 0};
}

} // namespace tilepack
