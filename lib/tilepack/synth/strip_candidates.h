#pragma once

#include "tilepack/synth/framed_set_settings.h"
#include "tilepack/synth/search_space.h"
#include "tilepack/synth/strip_axes.h"

#include <array>
#include <vector>

namespace tilepack {

/// A place in the sample for a strip.
struct StripCandidate {
  SourceTexel place;
  double mismatch = 0.0; ///< of its ends, per texel of overlap depth, with all that counts against the place
};

/// The part of a strip's window that tiles show on average, in texels of a sample `scale` times as large.
Rect shown_area(const StripAxes& axes, SourceTexel place, int scale);

/// Lists the best places for a strip, at the scale of the search. `space` and `options` must outlive it.
class StripRanking {
public:
  StripRanking(const SearchSpace& space, const FrameSearchOptions& options);

  /// Of the positions of `map` (mismatches at the strip's ends, `depth` texels deep at each) the best ones by
  /// mismatch, mean color, step across the edge and saliency together, no two within a few texels; at most
  /// options.candidates, best first.
  std::vector<StripCandidate> best(const PositionMap& map, const StripAxes& axes, int depth) const;

private:
  double mean_color_cost(SourceTexel at, const StripAxes& axes) const;

  const FeatureImage& image;
  const Saliency& saliency; // of the sample, which is `scale` times as large as the image
  int scale;
  const FrameSearchOptions& options;
  std::vector<double> mean;         // of the image, by channel
  std::array<double, 2> usual_step; // across horizontal edges, across vertical ones
};

} // namespace tilepack
