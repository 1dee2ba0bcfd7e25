#pragma once

#include "tilepack/tileset/material_map.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace tilepack {

/// What synthesis looks at: all maps of a sample in one image of small integers, so that a squared difference
/// of two texels says how visible it is to put one beside the other.
///
/// Channels, by the role of the map they come from, in units in which 255 is the full range:
///   color, emissive  encoded values; of a linear map v / (v + mean), which has no upper end and spreads the brightness
///              of any exposure evenly (sparks hardly count to the mean); times alpha where there is one
///   normal     the stored components, weight 1/2
///   roughness  weight 3/8
///   height     stretched to the range of nearly all of the map, weight 5/8
///   the rest   weight 1/4
/// Channels that don't vary are left out (one is always kept). Values out of 0..1 of maps that are not height
/// or linear color are clamped.
///
/// Integers make every sum exact, so the choices of synthesis depend on no processor and no library.
struct FeatureImage {
  int width = 0;
  int height = 0;
  int channels = 0;                 ///< 1..max_feature_channels
  std::vector<std::uint8_t> values; ///< row by row, channels interleaved
  int guides = 0; ///< of the channels, the last so many: they guide comparisons, but nothing is seen of them
  int flat_seam = 0; ///< with guides: what a seam costs beyond its difference where the last channel is 255
  /// How well a difference is seen at each texel, in 1 / sensitivity_unit; none: equally well everywhere. What is
  /// busy hides differences, and what is flat shows them.
  std::vector<std::uint8_t> sensitivity = {};

  const std::uint8_t* texel(int x, int y) const {
    return values.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels);
  }
  /// The texel nearest to (x, y) that exists: a patch is continued past the border of the sample by its last
  /// texel.
  const std::uint8_t* clamped_texel(int x, int y) const {
    return texel(std::clamp(x, 0, width - 1), std::clamp(y, 0, height - 1));
  }
};

constexpr int sensitivity_unit = 32;

/// At most this many channels are kept, in the order of the maps; further ones are not looked at.
constexpr int max_feature_channels = 16;

/// The sum over channels of squared differences of two texels.
inline int squared_difference(const std::uint8_t* a, const std::uint8_t* b, int channels) {
  int sum = 0;
  for (int c = 0; c < channels; ++c) {
    const int d = static_cast<int>(a[c]) - static_cast<int>(b[c]);
    sum += d * d;
  }
  return sum;
}

/// `samples`: one or more maps of one size.
FeatureImage feature_image(std::span<const SampleMap> samples);

/// Half the size, each texel the rounded mean of 2 × 2; an odd last row or column is dropped. Both sides must
/// be at least 2.
FeatureImage halved(const FeatureImage& image);

} // namespace tilepack
