#pragma once

#include "tilepack/exemplar/feature_image.h"

#include <cstdint>

namespace tilepack {

/// How far from an outline the channel of structure tells distances apart, texels of the image that it is seen on.
constexpr int structure_range = 12;

/// Of all texels, the steepest, lie on a strong edge.
constexpr double strong_share = 0.1;

struct StructureOptions {
  double weight = 1.0; ///< 0..1, of the channel beside those of color; at 0 the image is returned as it is
  /// FeatureImage::flat_seam as a share of the variance of all channels together. With 0.4 cuts keep out of
  /// stones; at none, two grey stones grow together for nothing.
  double flat_seam_share = 0.4;
  /// At f, differences are seen (1 + f) / f times as well where nothing else changes as where as much changes as on
  /// average (FeatureImage::sensitivity), before the mean is made 1. The less, the more cuts shun what is flat: at
  /// 0.3 hairlines come out in speckled mud, at 1 tan and grey stones grow together.
  double sensitivity_floor = 0.6;
  /// So many texels, as a share of all, lie on a strong edge at most. More than strong_share only where they stand out
  /// from what is flat, as joints of a wall do: its steepest tenth would be the joints of some bricks and not of others.
  double most_strong_share = strong_share;
};

/// The image with one more channel, last: the distance of each texel to the nearest strong edge, 0 on it and
/// `weight` · 255 from structure_range texels on. With it comparisons see outlines, and not colors alone: the
/// middle of one stone does not pass for the edge of another, and a cut between two stones runs where both
/// have their gaps [LH06].
///
/// Strong are the edges of the tenth of all texels at which the smoothed color changes most (strong_share). Where that is a
/// matter of grains, no texel is far from an edge, and the channel says next to nothing, as it should.
///
/// An image with max_feature_channels channels is returned as it is.
///
/// FeatureImage::flat_seam is set: a cut through the middle of two things of one color is not seen as a step of
/// color, but as a thing of no shape. Cuts that pay for it run along outlines.
///
/// All of this is seen on the image halved `halvings` times, and brought back: in a photo of 4096² outlines are
/// those of things that make up its tiles, and not of the grit on them.
///
/// FeatureImage::sensitivity is set: a difference that is lost among grit is seen on the face of a stone, so cuts are
/// drawn to where much changes anyway, as by the gradients of [Kwatra03].
FeatureImage with_structure(const FeatureImage& image, const StructureOptions& options = {},
                            int halvings = 0);

/// The variance of all channels together, rounded.
std::int64_t variance_of(const FeatureImage& image);

} // namespace tilepack
