#pragma once

#include "tilepack/layout/rotated_scheme.h"
#include "tilepack/tileset/tile_colors.h"

#include <vector>

namespace tilepack {

/// The outcome of a search for places that let every tile of a rotated layout agree with its neighbours.
enum class Matching {
  found,     ///< filtering across borders reads texels that could lie there in the plane: no gutter needed
  none,      ///< every arrangement was ruled out
  not_found, ///< the search ended at its limit
};

struct Arrangement {
  Matching matching = Matching::none;
  std::vector<int> tiles; ///< found: site of RotatedLattice → tile id
};

/// Places the tiles on the sites of `scheme` so that colors agree across all borders, round the torus. The
/// set must have as many tiles as the scheme (Error, internal). Deterministic; ends after at most
/// `most_placements` trials.
Arrangement matching_arrangement(const TileColors& tiles, const RotatedScheme& scheme,
                                 int most_placements = 100000);

} // namespace tilepack
