#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/exemplar/sample_analysis.h"
#include "tilepack/seam/patch_match.h"
#include "tilepack/seam/seam_repair.h"
#include "tilepack/synth/frame_search.h"
#include "tilepack/synth/interiors.h"
#include "tilepack/synth/synth_options.h"

namespace tilepack {

/// All that decides how a framed set is made, apart from what the user asked for.
struct FramedSetSettings {
  double reach = 0.125;          ///< half the width of a strip, of the tile's smaller side
  double corner_reach = 0.1875;  ///< how far corner patches reach along the edges, likewise
  int smallest_search_tile = 32; ///< frame and insides are searched at the scale at which the tile's smaller
                                 ///< side is at least this
  FrameSearchOptions frame;
  InteriorOptions interiors;
  SeamRepairOptions repair;       ///< of each strip, and then of each tile
  PatchMatchOptions coarse_match; ///< at half size, before
  PatchMatchOptions fine_match;
};

/// More effort: more starts, more places tried, more mended, longer polishing.
FramedSetSettings settings_for(int effort, std::uint64_t seed);

/// Construction::framed: chooses a frame, gives every tile its own inside, joins them by cuts, and mends what is
/// worst. Both colorings; see FrameShape for the construction.
/// Where tiles hold whole periods of the sample, all parts are kept in step with them.
SourceMap framed_set(const SampleAnalysis& sample, const SynthOptions& options,
                     const FramedSetSettings& settings, const Progress& progress = {});

} // namespace tilepack
