#pragma once

#include "tilepack/match/period_alignment.h"
#include "tilepack/match/use_counts.h"
#include "tilepack/synth/search_space.h"

#include <cstdint>
#include <vector>

namespace tilepack {

struct SetRepairOptions {
  int rounds = 1;          ///< over all lattice points and edges
  int corner_tries = 2;    ///< windows laid round each lattice point; 0: none
  int edge_spots = 3;      ///< worst places of each edge at which one is laid; 0: none
  int screened = 4;        ///< places of each look-up whose gain is found out at the scale of the search
  double reuse_weight = 4; ///< at f, a window shown as often as the average counts 1 + f times as unlike
  /// Of the energy that a window could change it is to bring so much at least: for less it is not worth the new seams.
  double least_gain = 0.2;
  std::int64_t price = 0; ///< see LaidWindow
};

/// Replaces what joins worst across the borders of tiles, in all tiles at once: round the lattice points, where four tiles
/// meet, and along edges. Every move lays one window of the sample over all that a color of corner or edge lets meet
/// (SharedWindow), along cuts that are best for the whole set, and is made only if the energy of the set falls
/// by enough [Kwatra03]. So nothing gets worse, tiles keep matching, and what many tiles share is mended where it meets all
/// of them, which no repair of single tiles can do.
///
/// Windows are twice and once as wide as the frame's reach, so that they hold what the sample shows whole. Where they
/// come from is looked up by likeness to what is shown there, of the whole window and without its middle (what is
/// wrong in its middle should not be found again); of what is found those are laid that bring most at the scale of
/// the search.
void repair_set(const SearchSpace& space, const PeriodAlignment& alignment, const UseTable& uses,
                const SetRepairOptions& options, std::vector<SourceCanvas>& tiles);

} // namespace tilepack
