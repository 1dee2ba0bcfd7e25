#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/image/image.h"

namespace tilepack {

/// How large what a sample shows is: the distance, in texels, at which brightness has become all but
/// independent (correlation below a tenth), without what varies over more than about 80 texels. Means over four
/// directions. Grass, gravel, sand: 3 to 5; litter 7; cracked mud 9; walls 9; pebbles 13; bricks 17; what is seen as
/// one object is about four times as wide.
///
/// Samples of which both sides have 1024 texels or more are looked at at half their size too, and so on while 512 are left:
/// where what is seen there has a fourth of the variance of all or more and is no grain, its scale counts if it is larger. A
/// photo of 4096² has the scale of its stones, be they 400 texels wide, and not that of the grit on them.
///
/// At most largest_object_scale().
double object_scale(const FeatureImage& image);
double largest_object_scale(Size sample);

} // namespace tilepack
