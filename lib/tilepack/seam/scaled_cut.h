#pragma once

#include "tilepack/exemplar/feature_pyramid.h"
#include "tilepack/seam/graph_cut.h"

#include <cstdint>
#include <vector>

namespace tilepack {

/// The scale, texels of the sample to one, from which a cut's line is brought to full size at once: round it a band of
/// three of its texels is free, which is room enough. From coarser ones bands would be so wide that cuts take longer
/// than all else, and places would be too many to compare, so both come down scale by scale.
constexpr int widest_step = 8;

/// What a cut settles for a cut `factor` times as fine, on an area of size `fine`: all but a band round its line. `taken`:
/// 1 for each texel of the area of size `coarse` that takes the new material, row by row.
std::vector<CutConstraint> settled_by(const std::vector<std::uint8_t>& taken, Size coarse, Size fine,
                                      int factor);

/// lay_patch() for large canvases, at the scale of the first level: where the last level is a fourth of it or larger, the
/// same; else the cut is found at the scale of the last level and comes down scale by scale, in bands round its line. A
/// thousandth of the nodes are left then, of tiles of 1280 texels. What of a coarse texel must stay or be taken holds for all of
/// it. The seam energy may rise a little, unlike that of lay_patch().
bool lay_patch_by_scales(const FeaturePyramid& pyramid, SourceCanvas& canvas, const LaidPatch& patch);

} // namespace tilepack
