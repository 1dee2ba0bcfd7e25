#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/tileset/source_map.h"

#include <vector>

namespace tilepack {

/// How much each part of an image differs from what lies round it, in cells of `side` × `side` texels (a rest at the
/// east and south borders belongs to none): the squared distance of its mean color, without guides, from that of
/// `around` × `around` cells in whose middle it lies, as a multiple of the mean over all cells. A stone in moss has much of
/// it, the moss between little; pebbles have the same everywhere, however much that is.
///
/// Meant for a sample at the scale at which it is searched, where a tile is 32 texels or somewhat more: then cells are as
/// large as what makes a tile's details, whatever its resolution.
///
/// Unlike Saliency it says nothing of how rare something is: stones that cover half of a sample are not rare, but
/// the same one at every lattice point shows the grid.
struct LocalContrast {
  static constexpr int side = 2;
  static constexpr int around = 5;
  int wide = 0;
  int high = 0;
  std::vector<double> values; ///< row by row; all 0 in a sample without any

  double at(int x, int y) const { return values[static_cast<std::size_t>(y) * wide + x]; }
};
LocalContrast local_contrast(const FeatureImage& image);

/// The mean over the cells whose middles lie in `area`, texels of the image; 1 if none do.
double mean_in(const LocalContrast& contrast, Rect area);

} // namespace tilepack
