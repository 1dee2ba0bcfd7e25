#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/synth/frame.h"

namespace tilepack {

/// Brings a plan found in an image of half the size to `image`, the sample at 1 / scale of its size: each
/// place doubled, and strips moved by up to a few texels to where they fit their corner patches best.
///
/// At full size corner patches are put exactly in step (see Phase), and strips are chosen together so that
/// the mean step between neighbouring texels across all edges, in either direction, comes out as it is in the
/// sample: a border that is busier or calmer than its surroundings shows as a line, however well it is
/// joined.
void refine_frame(const FeatureImage& image, const FrameShape& shape, int scale, FrameSources& plan);

} // namespace tilepack
