#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/synth/strip_axes.h"

namespace tilepack {

/// The mean step (sum over channels of absolute differences) between texels that are neighbours across an
/// edge of `direction`, over the whole image.
double mean_step(const FeatureImage& image, Direction direction);

/// The same across the edge in the middle of a strip that lies at `place`. A border with larger or smaller steps
/// than the sample shows as a line.
double step_across(const FeatureImage& image, const StripAxes& axes, SourceTexel place);

/// With the corner patches `first` and `second` (see FrameSources) shown as far as their cuts run on average:
/// what tiles will show at their borders.
double step_across(const FeatureImage& image, const StripAxes& axes, SourceTexel place, SourceTexel first,
                   SourceTexel second);

} // namespace tilepack
