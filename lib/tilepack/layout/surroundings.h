#pragma once

#include "tilepack/image/image.h"
#include "tilepack/layout/layout.h"
#include "tilepack/tileset/tile_colors.h"

#include <vector>

namespace tilepack {

/// Tiles round a tile in some legal tiling of the plane, by id; -1 where there is none.
///
///     nw n ne
///      w   e
///     sw s se
struct Surroundings {
  int nw = -1, n = -1, ne = -1;
  int w = -1, e = -1;
  int sw = -1, s = -1, se = -1;
  bool operator==(const Surroundings&) const = default;
};

/// For each tile its surroundings: side neighbours are the first tiles whose colors fit, corner neighbours
/// the first that fit both side neighbours next to them. In a complete set all eight exist.
std::vector<Surroundings> fitting_surroundings(const TileColors& tiles);

/// The surroundings of each tile in a rotated layout, read off the torus: for arrangements whose colors
/// match.
std::vector<Surroundings> packed_surroundings(const Layout& rotated);

/// Whether the colors of neighbours agree on all borders of such a torus.
bool colors_match(const TileColors& tiles, const std::vector<Surroundings>& packed);

/// Each tile with `margin` texels more on every side, taken from its surroundings; where a tile is lacking,
/// and beyond one tile, the nearest texel at hand is repeated. No surroundings at all: own texels only.
std::vector<Image> with_margin(const std::vector<Image>& tiles, const std::vector<Surroundings>& surroundings,
                               int margin);

} // namespace tilepack
