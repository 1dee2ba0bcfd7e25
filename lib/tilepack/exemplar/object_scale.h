#pragma once

#include "tilepack/exemplar/feature_image.h"

namespace tilepack {

/// How large what a sample shows is: the distance, in texels, at which brightness has become all but
/// independent (correlation below a tenth), without what varies over more than about 80 texels. Means over four
/// directions. Grass, gravel, sand: 3 to 5; litter 7; cracked mud 9; walls 9; pebbles 13; bricks 17; what is seen as
/// one object is about four times as wide.
///
/// At most `longest_lag`.
double object_scale(const FeatureImage& image);
constexpr int longest_lag = 32;

} // namespace tilepack
