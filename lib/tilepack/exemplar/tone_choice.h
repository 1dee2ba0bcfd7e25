#pragma once

#include "tilepack/exemplar/flatten.h"
#include "tilepack/exemplar/period.h"
#include "tilepack/tileset/material_map.h"

#include <optional>
#include <span>

namespace tilepack {

/// What is done to the slow tones of a sample, if it is left to the sample.
struct ToneChoice {
  int flatten = 0;                    ///< percent, 0 or 100
  std::optional<EvenCourses> courses; ///< each of them by itself
};

/// Where tones lie in lines, tiles cut them off as straight as their borders run, and that is seen at once:
///
///   courses that follow one another along one axis, such as boards, are evened out course by course, where tiles
///   of this size hold whole ones and half of the variance of brightness or more lies between rows (planks have
///   0.7 and 0.8; bricks, whose tone is a matter of each brick, 0.1 to 0.3)
///   a sample without courses is flattened, where a quarter lies between rows (wood has 0.3, all other
///   photos that were looked at 0.1 at most) and tone drifts slowly (SampleTraits::shading of 0.018; wood 0.05)
///
/// All else stays as it is: patches of moss or rust are what such a sample is of, and hide where they are cut. So do
/// drawn patterns that repeat texel by texel, and ink on paper. `samples`: maps of one size, as tiles are made of
/// them, with these periods.
ToneChoice tone_choice(std::span<const SampleMap> samples, const Periodicity& periods, Size tile);

} // namespace tilepack
