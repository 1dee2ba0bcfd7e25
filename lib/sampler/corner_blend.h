#pragma once

#include "tilepack/sampler/pack_texels.h"

#include <cstdint>

namespace tilepack {

/// How far from a corner, in texels of the level looked up, the corner pack counts unless told otherwise.
inline constexpr double default_corner_width = 4.0;

/// The share of the corner pack at a point of a tile (fractions of its sides, whose texels are `tile`): 1 as
/// far as a filter that crosses a border can read a texel in the very corner of a tile, 1.58 texels from it;
/// then falling with the distance to 0 at `width` texels. Continuous with its first derivative, also from
/// tile to tile: `width` is cut to half the shorter side, and the flat part to half of that.   [Wei04, App.
/// B]
///
/// Away from the corner the corner pack shows other tiles, so a wide blend trades the error at corners for
/// one round them, unless tiles share a guard band of `width` texels.
double corner_weight(double fraction_x, double fraction_y, Size tile, double width);

/// The corner pack of an edge-colored pack as a filter uses it beside the tiles.
class CornerTexels {
public:
  /// `width` as in corner_weight. Throws Error (usage) if the pack has no corner pack.
  CornerTexels(const Pack& pack, int map, double width, int first_level = 0, int last_level = 1 << 20);

  double weight(int level, double fraction_x, double fraction_y) const {
    return corner_weight(fraction_x, fraction_y, texels.tile_size(level), blend_width);
  }

  /// The cell of pack_texels() that stands for cell (x, y) at a point of it, found through the corner nearest
  /// to the point.
  PackTexels::Place place(std::int64_t cell_x, std::int64_t cell_y, double fraction_x,
                          double fraction_y) const;
  const PackTexels& pack_texels() const { return texels; }

private:
  const Pack* pack;
  PackTexels texels;
  double blend_width;
};

} // namespace tilepack
