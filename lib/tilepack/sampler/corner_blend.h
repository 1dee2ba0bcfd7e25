#pragma once

#include "tilepack/sampler/pack_texels.h"

#include <cstdint>

namespace tilepack {

/// How far from a corner, in texels of the level looked up, the corner pack counts unless told otherwise:
/// what mending a corner takes, since a filter that crosses a border reads a texel in the very corner of a
/// tile up to 1.58 texels away.
inline constexpr double default_corner_width = 4.0;

/// The share of the corner pack at a point of a tile (fractions of its sides, whose texels are `tile`): 1 up
/// to half of `width` texels from the nearest corner, then falling to 0 at `width`. Continuous with its first
/// derivative, also from tile to tile: `width` is cut to half the shorter side.   [Wei04, App. B]
double corner_weight(double fraction_x, double fraction_y, Size tile, double width);

/// The corner pack of an edge-colored pack as a filter uses it beside the tiles.
class CornerTexels {
public:
  /// `width` as in corner_weight, for all levels; each cuts it to CornerPack::width, which is in texels of
  /// level 0: farther from corners the corner pack shows other tiles. Throws Error (usage) if the pack has no
  /// corner pack.
  CornerTexels(const Pack& pack, int map, double width, int first_level = 0, int last_level = 1 << 20);

  double weight(int level, double fraction_x, double fraction_y) const;

  /// The cell of pack_texels() that stands for cell (x, y) at a point of it, found through the corner nearest
  /// to the point.
  PackTexels::Place place(std::int64_t cell_x, std::int64_t cell_y, double fraction_x,
                          double fraction_y) const;
  const PackTexels& pack_texels() const { return texels; }

private:
  const PackLookup& lookup() const { return texels.lookup(); }

  PackTexels texels;
  double blend_width;
  double widest; // CornerPack::width
};

} // namespace tilepack
