#pragma once

#include "tilepack/seam/graph_cut.h"
#include "tilepack/seam/source_canvas.h"
#include "tilepack/synth/search_space.h"

#include <cstdint>
#include <vector>

namespace tilepack {

/// What joining an inside to a framed tile really costs: it is laid in along its best cut, and the seams that
/// are left are counted. A likeness over the whole overlap can't tell that: most of the overlap is never
/// shown, and what matters is whether some closed line through it fits.
class InsideCuts {
public:
  /// `framed` is a tile of framed_tiles() and `bias` that of lay_patch(), both at full size. `space` must outlive
  /// it. `level`: of the space's pyramid, at which cuts are made.
  InsideCuts(const SearchSpace& space, const SourceCanvas& framed, std::int64_t full_bias, int level);
  /// At the scale of the search.
  InsideCuts(const SearchSpace& space, const SourceCanvas& framed, std::int64_t full_bias)
      : InsideCuts(space, framed, full_bias, space.levels() - 1) {}

  /// What a cut at a coarser level settled for this one, row by row; what it left `free` is free as before.
  void settle(const std::vector<CutConstraint>& settled);

  /// The energy of the seams of the tile, and the bias of all that it keeps, with the inside at `place` (of
  /// the tile's north-west texel, at the scale of the level).
  std::int64_t cost(SourceTexel place) const;

  /// Which texels that cut takes, 1 each, row by row, at the scale of the level.
  std::vector<std::uint8_t> taken(SourceTexel place) const;

  Size size() const { return {frame.width, frame.height}; }

private:
  SourceCanvas laid(SourceTexel place) const;

  const FeatureImage& image; // the level
  SourceCanvas frame;
  std::vector<CutConstraint> constraints;
  std::int64_t bias;
};

} // namespace tilepack
