#pragma once

#include <span>

namespace tilepack {

/// How much of each of several materials shows at a place, by how high they stand there.
///
/// Material i stands at level(i) = coverage(i) + relief * height(i). Those within `softness` of the highest one show,
/// each in proportion to how far it is above that limit. So stones of one stick out of the sand of the other, and
/// where all are equally high the border runs where coverage is equal, softness wide in units of coverage.
///
/// coverage: 0..1 each, summing to 1, as of interpolated areas. height: 0..1 each. `relief` >= 0, `softness` > 0 and
/// relief + softness <= 1, so that what has no coverage never shows and nothing jumps where coverage ends. Weights sum
/// to 1.
void height_weights(std::span<const double> coverage, std::span<const double> height, double relief,
                    double softness, std::span<double> weights);

/// Blends unit vectors stored as n * 0.5 + 0.5 as what they are: slopes. (x/z, y/z) is averaged, which is what adding
/// surfaces up does, and (x, y, 1) made a unit vector. Averaged as vectors, steep ones would count for too little.
/// Sum up with add(), `weight`s summing to 1; z is held at 1/64 or more.
struct SlopeSum {
  double x = 0, y = 0;
  void add(std::span<const double> stored, double weight);
  void resolve(std::span<double> stored) const; ///< the first 3 channels
};

} // namespace tilepack
