#pragma once

#include "tilepack/exemplar/feature_pyramid.h"
#include "tilepack/exemplar/sample_analysis.h"
#include "tilepack/match/patch_search.h"
#include "tilepack/synth/frame.h"

#include <cstdint>
#include <limits>
#include <utility>

namespace tilepack {

/// Where the parts of a framed set are looked for: the sample, at full size and at that of the search, and the
/// shape of the frame at both. `sample` must outlive it.
struct SearchSpace {
  /// The first of `levels` must outlive the space, too. `most_searched_texels`: see PatchSearch; without it all of the last level is searched.
  SearchSpace(const SampleAnalysis& analysed_sample, const FrameShape& frame_shape, FeaturePyramid levels,
              std::int64_t most_searched_texels = std::numeric_limits<std::int64_t>::max())
      : sample(analysed_sample), shape(frame_shape), pyramid(std::move(levels)),
        small_shape(halved(frame_shape, static_cast<int>(pyramid.size()) - 1)),
        search(pyramid.back(), small_shape.tile, most_searched_texels) {}

  const SampleAnalysis& sample;
  FrameShape shape; ///< at full size
  FeaturePyramid
      pyramid; ///< of sample.features, with a channel of structure (with_structure) in a framed set;
               ///< its last level is searched
  FrameShape small_shape; ///< at the scale of the search
  PatchSearch search;     ///< of the last level

  const FeatureImage& image() const { return pyramid.front(); }
  const FeatureImage& small_image() const { return pyramid.back(); }
  int levels() const { return static_cast<int>(pyramid.size()); }
  /// Texels of the sample to one of the search, along each axis.
  int scale() const { return 1 << (levels() - 1); }
};

} // namespace tilepack
