#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/synth/frame.h"
#include "tilepack/synth/framed_set_settings.h"

namespace tilepack {

/// Brings the sources of a frame found in an image of half the size to `image`, the sample at 1 / scale of its
/// size: each place doubled, and strips moved by up to a few texels to where they fit their corner patches best.
/// `shape` at the scale of the image.
///
/// At full size corner patches are put exactly in step (see PeriodAlignment), and strips are chosen together so
/// that the mean step between neighbouring texels across all edges, in either direction, comes out as it is in
/// the sample (nearly: FrameRefineOptions::wanted_step): a border with larger or smaller steps than its
/// surroundings shows as a line, however well it is joined.
void refine_frame(const FeatureImage& image, const FrameShape& shape, int scale,
                  const FrameRefineOptions& options, FrameSources& sources);

} // namespace tilepack
