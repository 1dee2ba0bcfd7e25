#pragma once

#include "tilepack/exemplar/period.h"
#include "tilepack/match/patch_search.h"
#include "tilepack/tileset/source_map.h"

#include <algorithm>

namespace tilepack {

/// Keeps the parts of a set in step with a sample that repeats.
///
/// Where the sample has a period along an axis and tiles hold a whole number of them, two parts of it join
/// without breaking its courses if they are moved against the sample by amounts that differ by whole periods.
/// A part's move is told by the texel of the sample that its place puts at a tile's north-west texel. In
/// texels of the sample at full size throughout.
///
/// Of a sample that is nothing but lines without a repeat (Period::lines) all parts show the same ones, those of its
/// middle: lines run on from part to part, and repeat from tile to tile across them.
class PeriodAlignment {
public:
  /// Nothing repeats: everything is in step.
  PeriodAlignment() = default;

  /// Along an axis with a period of which `tile` holds a whole number (whole_periods): all parts in step with
  /// one that puts texel (0, 0) at a tile's north-west texel.
  PeriodAlignment(const Periodicity& periodicity, Size tile);

  /// The same, but in step with a part that puts `texel` there; where lines are fixed, still with these.
  PeriodAlignment through(SourceTexel texel) const;

  /// The same for parts whose move is told by the texel they put at `place` of a tile.
  PeriodAlignment seen_from(SourceTexel place) const;

  bool free() const { return x.free() && y.free(); }

  /// Whether the sample repeats along both axes, as bricks and paving do.
  bool lattice() const { return x.period > 0 && y.period > 0; }

  /// Along each axis, texels; 0 where nothing repeats.
  double period_x() const { return x.period; }
  double period_y() const { return y.period; }

  /// Whether it is known of the first part too where it lies: lines are fixed along an axis, or both axes repeat, so
  /// that borders may lie on joints (cheapest_lines).
  bool holds_first_part() const { return x.fixed || y.fixed || lattice(); }

  /// Whether a part that puts `texel` at a tile's north-west texel is in step: within half a step of a search
  /// that tries every `step`-th texel, and, where courses waver, in any case within a texel or a sixty-fourth of
  /// the period.
  bool allows(SourceTexel texel, int step) const;

  /// The texel nearest to `texel` that is exactly in step, to rounding; of those within `low`..`high`, if
  /// any.
  SourceTexel nearest(SourceTexel texel, SourceTexel low, SourceTexel high) const;

private:
  struct Axis {
    double period = 0.0; // 0: none
    double origin = 0.0;
    bool even = false;  // courses lie where they should: nothing but rounding is let pass
    bool fixed = false; // one place alone is in step, the origin
    Axis() = default;
    Axis(const Period& found, int tile);
    bool free() const { return period <= 0.0 && !fixed; }
    bool allows(int texel, int step) const;
    int nearest(int texel, int low, int high) const;
  };
  Axis x, y;
};

/// Rules out the positions of a map, made at 1 / scale of the sample's size, that are out of step.
void rule_out_of_step(PositionMap& map, const PeriodAlignment& alignment, int scale);

} // namespace tilepack
