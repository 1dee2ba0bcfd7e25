#pragma once

#include "tilepack/match/patch_search.h"
#include "tilepack/synth/frame.h"

namespace tilepack {

enum class Direction { horizontal, vertical };

/// The two ends of a strip: west and east, or north and south.
enum class End { first, second };

/// A strip of either direction in one frame of reference: `along` its edge, `across` it.
struct StripAxes {
  Direction direction = Direction::horizontal;
  int length = 0;       ///< along: the tile's side
  int reach = 0;        ///< across: half the width
  int corner_reach = 0; ///< along: how far the corner patches at its ends reach

  int width() const { return direction == Direction::horizontal ? length : 2 * reach; }
  int height() const { return direction == Direction::horizontal ? 2 * reach : length; }
  /// (along, across) as (x, y) of the strip's window.
  SourceTexel at(int along, int across) const {
    return direction == Direction::horizontal ? SourceTexel{along, across} : SourceTexel{across, along};
  }
};

StripAxes axes_of(const FrameShape& shape, Direction direction);

inline SourceTexel sum(SourceTexel a, SourceTexel b) {
  return {a.x + b.x, a.y + b.y};
}

/// Where the corner patch `corner` (see FrameSources) at one end puts the strip's north-west texel, as a place in
/// the sample.
SourceTexel corner_origin(const StripAxes& axes, SourceTexel corner, End end);

/// Where a strip's window lies in the tile south or east of its edge, in texels of a sample `scale` times as
/// large.
inline SourceTexel strip_place(const StripAxes& axes, int scale) {
  return axes.at(0, -axes.reach * scale);
}

/// What a strip's window overlaps at its two ends.
Overlap end_overlap(const FeatureImage& image, const FrameShape& shape, const StripAxes& axes,
                    SourceTexel first, SourceTexel second);

} // namespace tilepack
