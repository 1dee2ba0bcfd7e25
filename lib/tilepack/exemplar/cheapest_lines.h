#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/exemplar/period.h"
#include "tilepack/tileset/source_map.h"

namespace tilepack {

/// In a sample that repeats, the column and the row of its first period along which parts in step can be joined at
/// the least cost: the joints between bricks, the grooves between boards, the gaps between lines of text. Tiles whose
/// borders lie there can be cut without going through anything.
///
/// Parts in step show, at one line of theirs, lines of the sample that lie whole periods apart. So what a cut along a
/// line is expected to cost is what seam_cost() gives for two of these in the mean: twice their variance, weighted as
/// differences are seen there, and what is paid for flat places. Lines beside it count too, for joints are wide.
///
/// `image` is the sample with its structure (with_structure). Texels of the sample; 0 along an axis without a period.
SourceTexel cheapest_lines(const FeatureImage& image, const Periodicity& periods);

} // namespace tilepack
