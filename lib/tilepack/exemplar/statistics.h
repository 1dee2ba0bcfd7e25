#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/image/image.h"

#include <cstdint>
#include <vector>

namespace tilepack {

/// What a sample is made of, so that a choice of its parts can be held against the whole: distribution
/// functions of each channel's value, of its mean over a wider square (brightness that varies slowly), and of
/// the local contrast, each taken at 15 thresholds that split the sample's texels into 16 equal parts.
class SampleStatistics {
public:
  SampleStatistics() = default; ///< of nothing, to be assigned to

  /// Works at the first level of half size, half of that, … that has at most `most_texels` texels.
  explicit SampleStatistics(const FeatureImage& image, int most_texels = 40'000);

  /// A sum over areas: how many texels, and how many of them lie below each threshold.
  struct Tally {
    double texels = 0.0;
    std::vector<double> below;
  };
  Tally empty() const { return {0.0, std::vector<double>(static_cast<std::size_t>(functions))}; }

  /// Adds the texels of `area` (in texels of the image given to the constructor), each counted `weight`
  /// times, which may be negative.
  void add(Tally& tally, Rect area, double weight) const;

  /// How far the tally with `area` added is from the whole sample: the mean over all functions of the squared
  /// difference. 0 for the sample itself, about 0.003 for a random tenth of a natural sample.
  double distance_with(const Tally& tally, Rect area, double weight) const;
  double distance(const Tally& tally) const;

private:
  struct Corners {
    const std::int32_t* low_low;
    const std::int32_t* high_low;
    const std::int32_t* low_high;
    const std::int32_t* high_high;
    int texels;
  };
  Corners corners(Rect area) const;

  int scale = 1;
  int width = 0;
  int height = 0;
  int functions = 0;
  std::vector<std::int32_t> sums; ///< summed areas, (width + 1) × (height + 1) × functions
  std::vector<double> target;     ///< of the whole sample, per function
};

} // namespace tilepack
