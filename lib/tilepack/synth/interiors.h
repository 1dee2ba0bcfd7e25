#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/synth/framed_set_settings.h"
#include "tilepack/synth/search_space.h"

#include <vector>

namespace tilepack {

/// A canvas for each tile with the frame's strips along its borders and nothing inside: there, texels further
/// than `reach` from all borders, the source is `no_source`. At the diagonals a texel belongs to the nearer
/// strip, the horizontal one where equal.
std::vector<SourceCanvas> framed_tiles(const FrameShape& shape, const Frame& frame);

struct InteriorChoice {
  std::vector<SourceTexel> places; ///< of each tile's north-west texel; whole tiles lie inside the sample
  double cost = 0.0;               ///< by fit, reuse and statistics together, at the scale of the search
};

/// Chooses a window of the sample for the inside of each tile, all tiles together: by how it fits the tile's
/// strips, and by how often its parts are shown already by strips and other tiles. What is chosen depends on
/// the order in which tiles choose, so several orders are tried side by side.
///
/// The choice is made in the last level of the space's pyramid and refined in the others. `sources`: of the
/// frame, at full size; `framed`: the tiles with it, see framed_tiles.
InteriorChoice chosen_interiors(const SearchSpace& space, const FrameSources& sources,
                                const std::vector<SourceCanvas>& framed, const InteriorOptions& options,
                                const Progress& progress = {});

/// Joins each tile's window to its strips by one closed cut; `bias`: see lay_patch. The cut is found at the scale of the
/// search, and at full size within a band round it.
void join_interiors(const SearchSpace& space, const std::vector<SourceTexel>& interiors, std::int64_t bias,
                    std::vector<SourceCanvas>& tiles);

} // namespace tilepack
