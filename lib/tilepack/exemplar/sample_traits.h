#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/exemplar/period.h"

namespace tilepack {

/// What a sample is like, as far as it decides whether tiles can be made of it and which options suit it.
struct SampleTraits {
  Periodicity periods;
  /// Share of the variance that is between squares of one tile's side: near 0 where every part looks alike, 1
  /// where brightness or hue changes over the sample and not within a tile. 0 if fewer than 4 squares fit.
  double drift = 0;
  /// What of such a share slow shading alone explains, 0 to 3/4: that between squares of the tile's side
  /// less a quarter of that between squares of half the side, which is what patches without order leave, be
  /// they grains or bricks; 0 where that is less than none. Where the sample is large for the tile, the
  /// squares are as many tiles wide as let 4 x 4 lie in it: shading runs on, patches end. 0 if fewer than 4
  /// squares fit.
  double shading = 0;
  /// Share of the variance of brightness that two groups of texels explain [Otsu79]: 0.64 for a bell curve,
  /// 1 for ink on paper.
  double two_tone = 0;
  double ink = 0; ///< share of texels in the smaller of the two groups
};

/// `periods` are handed on. Deterministic; costs less than reading the sample.
SampleTraits sample_traits(const FeatureImage& image, const Periodicity& periods, Size tile);

} // namespace tilepack
