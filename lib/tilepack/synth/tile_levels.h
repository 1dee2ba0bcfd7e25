#pragma once

#include "tilepack/synth/search_space.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tilepack {

/// What a framed tile shows of its strips, at each level of the space's pyramid: what a window of the sample for
/// its inside overlaps. Level 0 is read from the canvas itself, the others are built once.
class TileLevels {
public:
  /// `tile`: see framed_tiles. Both must outlive it.
  TileLevels(const SearchSpace& search_space, const SourceCanvas& tile);

  /// The texels of strips outside of the guard, each with weight 1; at smaller levels those of which all four
  /// texels of the level before are such.
  Overlap overlap(std::size_t level) const;

  /// best_near() of that overlap in that level, row by row and without the overlap, which takes 20 bytes a texel and
  /// more.
  SourceTexel best_near(std::size_t level, SourceTexel start, int distance) const;

private:
  struct Level {
    FeatureImage features;
    std::vector<std::uint8_t> known; // 1 where features holds something
  };
  Level full_size() const;
  static Level half_of(const Level& fine);

  const SearchSpace* space;
  const SourceCanvas* canvas;
  std::vector<Level> smaller; // levels 1, 2, …
};

/// Of every tile.
std::vector<TileLevels> tile_levels(const SearchSpace& space, const std::vector<SourceCanvas>& framed);

} // namespace tilepack
