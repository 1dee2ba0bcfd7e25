#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/tileset/source_map.h"

#include <cstddef>
#include <span>
#include <vector>

namespace tilepack {

/// How unlike the rest each part of a sample is, in cells of `side` × `side` texels (a rest at the east and
/// south borders belongs to none): the largest deviation from the mean of all cells, in standard deviations
/// over all cells, of
///   the means of up to three channels (brightness, as it were),
///   the differences between the means of neighbouring ones (hue), and
///   the mean step between neighbouring texels (contrast).
/// Of a thousand cells of photos without anything that catches the eye ten to thirty deviate by more than 3.
struct Saliency {
  int wide = 0;
  int high = 0;
  std::vector<double> values; ///< row by row
  int side = 16;              ///< texels

  double at(int x, int y) const { return values[static_cast<std::size_t>(y) * wide + x]; }
};
constexpr double salient_deviation = 3.0;
/// `halvings`: cells are twice as large for each, as things are that catch the eye in larger tiles.
Saliency saliency_of(const FeatureImage& image, int halvings = 0);

/// By how much more than `salient_deviation` the most unlike cell in `area` deviates, of those of which half
/// or more lies in it; 0 if none does. In texels of the sample.
double excess_in(const Saliency& saliency, Rect area);

/// The spot of the sample that the eye is most likely to find again: a cell unlike the others that many tiles
/// show.
struct Landmark {
  SourceTexel centre;
  double deviation = 0; ///< see Saliency
  double shown = 0;     ///< share of the tiles that show it, averaged over its texels
};

/// Of all cells that deviate by more than `salient_deviation` the one with the greatest product of what they
/// deviate more and of how often they are shown. `showing`: how many of `tiles` tiles show each
/// texel of a sample of this size, row by row.
Landmark most_seen(const Saliency& saliency, Size sample, std::span<const int> showing, std::size_t tiles);

} // namespace tilepack
