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

/// Makes the free texels of `constraints` what is settled of them; none settled: all stay as they are.
void settle(const std::vector<CutConstraint>& settled, std::vector<CutConstraint>& constraints);

/// The last level of a pyramid up to which cuts and places are found at full size at once, a fourth of it: tiles of less than
/// 256 texels have no further ones.
constexpr int levels_at_once = 2;

/// lay_patch() for large canvases, at the scale of the first level: where the last level is levels_at_once or one before,
/// the same; else the cut is found at the scale of the last level and comes down scale by scale, in bands round its line.
/// What of a coarse texel must stay or be taken holds for all of it. The seam energy may rise a little then, unlike that of
/// lay_patch().
bool lay_patch_by_scales(const FeaturePyramid& pyramid, SourceCanvas& canvas, const LaidPatch& patch);

} // namespace tilepack
