#pragma once

#include "tilepack/report/bake_verdict.h"

#include <string>
#include <vector>

namespace tilepack {

/// Where a bake chose the size of tiles by itself: what that comes to, and what would take less memory or show
/// more.
struct SizeChoice {
  double times_sample = 0; ///< texels that the tiles hold, in those of the sample

  /// The next smaller power of two as a side, its memory against the chosen one's, and about what it would show of
  /// the sample; none where tiles can't be smaller.
  std::vector<Cure> smaller;
  double smaller_memory = 0; ///< 0..1
  double smaller_shows = 0;  ///< 0..1, estimated

  /// More colors and tiles of this size; none where there are most already.
  std::vector<Cure> richer;
  int richer_tiles = 0;
};

SizeChoice size_choice(const BakeFacts& facts);

/// In a sentence or two, with marked fields.
std::string size_choice_text(const BakeFacts& facts);

} // namespace tilepack
