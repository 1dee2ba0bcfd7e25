#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/exemplar/feature_pyramid.h"
#include "tilepack/exemplar/sample_analysis.h"
#include "tilepack/match/patch_search.h"
#include "tilepack/synth/frame.h"

#include <vector>

namespace tilepack {

/// A canvas for each tile with the frame's strips along its borders and nothing inside: there, texels further
/// than `reach` from all borders, the source is `no_source`. At the diagonals a texel belongs to the nearer
/// strip, the horizontal one where equal.
std::vector<SourceCanvas> framed_tiles(const FrameShape& shape, const Frame& frame);

constexpr SourceTexel no_source{-1, -1};

/// How texels of a tile may change once it is framed: those within `guard` of a border never.
bool in_guard(const FrameShape& shape, int x, int y);

struct InteriorOptions {
  std::uint64_t seed = 0;
  double freshness = 8.0; ///< at f, a part shown as often as the average makes a fit count 1 + f times as bad
  double likeness = 1500.0; ///< weight of the distance between what the set shows and the sample's statistics
  double caution = 4.0;     ///< showing a part again that deviates by striking_deviation + d (Saliency)
                            ///< is 1 + caution · d times as bad
  int starts = 16;        ///< orders in which tiles choose; the best outcome is taken. Fewer for sets of more
                          ///< than 16 tiles, 1 beyond 128
  int rounds = 6;         ///< passes over all tiles
  std::int64_t bias = 10; ///< see lay_patch
};

struct InteriorChoice {
  std::vector<SourceTexel> places; ///< of each tile's north-west texel; whole tiles lie inside the sample
  double cost = 0.0;               ///< by fit, freshness and likeness together, at the scale of the search
};

/// Chooses a window of the sample for the inside of each tile, all tiles together: by how it fits the tile's
/// strips, and by how often its parts are shown already by strips and other tiles. What is chosen depends on
/// the order in which tiles choose, so several orders are tried side by side.
///
/// `search` searches the last level of `pyramid`; its finds are refined in the others.
InteriorChoice chosen_interiors(const FeaturePyramid& pyramid, const PatchSearch& search,
                                const SampleAnalysis& sample, const FrameShape& shape,
                                const FrameSources& plan, const std::vector<SourceCanvas>& framed,
                                const InteriorOptions& options, const Progress& progress = {});

/// Joins each tile's window to its strips by one closed cut.
void join_interiors(const FeatureImage& image, const FrameShape& shape,
                    const std::vector<SourceTexel>& interiors, std::int64_t bias,
                    std::vector<SourceCanvas>& tiles);

} // namespace tilepack
