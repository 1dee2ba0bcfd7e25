#pragma once

#include "tilepack/layout/layout.h"
#include "tilepack/tileset/tile_colors.h"

#include <vector>

namespace tilepack {

struct Arrangement {
  Matching matching = Matching::none;
  std::vector<int> tiles; ///< found: site of RotatedLattice → tile id
};

/// Places the tiles on the sites of `scheme` so that colors agree across all borders, round the torus. The
/// set must have as many tiles as the scheme (Error, internal). Complete sets on a grid of their own size lie
/// as in tile_index_layout or de_bruijn_layout; everything else is searched for, deterministically, comparing
/// at most `most_trials` tiles with sites.
Arrangement matching_arrangement(const TileColors& tiles, const RotatedScheme& scheme,
                                 long long most_trials = 30000000);

} // namespace tilepack
