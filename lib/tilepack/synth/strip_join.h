#pragma once

#include "tilepack/exemplar/feature_pyramid.h"
#include "tilepack/seam/source_canvas.h"
#include "tilepack/synth/strip_axes.h"

namespace tilepack {

/// At the scale of the first level, the canvas of a strip whose window lies at `place`, the corner patches at its two ends (as in FrameSources) cut
/// into it. Within `guard` of the ends, and at them at least, only they are shown.
SourceCanvas joined_strip(const FeaturePyramid& pyramid, const FrameShape& shape, const StripAxes& axes,
                          SourceTexel place, SourceTexel first, SourceTexel second);

} // namespace tilepack
