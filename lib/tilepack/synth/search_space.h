#pragma once

#include "tilepack/exemplar/feature_pyramid.h"
#include "tilepack/exemplar/sample_analysis.h"
#include "tilepack/match/patch_search.h"
#include "tilepack/synth/frame.h"

#include <utility>

namespace tilepack {

/// Where the parts of a framed set are looked for: the sample, at full size and at that of the search, and the
/// shape of the frame at both. `sample` must outlive it.
struct SearchSpace {
  SearchSpace(const SampleAnalysis& analysed_sample, const FrameShape& frame_shape, FeaturePyramid levels)
      : sample(analysed_sample), shape(frame_shape), pyramid(std::move(levels)), search(pyramid.back()),
        small_shape(halved(frame_shape, static_cast<int>(pyramid.size()) - 1)) {}

  const SampleAnalysis& sample;
  FrameShape shape;       ///< at full size
  FeaturePyramid pyramid; ///< of sample.features; its last level is searched
  PatchSearch search;     ///< of the last level
  FrameShape small_shape; ///< at the scale of the search

  const FeatureImage& image() const { return pyramid.front(); }
  const FeatureImage& small_image() const { return pyramid.back(); }
  int levels() const { return static_cast<int>(pyramid.size()); }
  /// Texels of the sample to one of the search, along each axis.
  int scale() const { return 1 << (levels() - 1); }
};

} // namespace tilepack
