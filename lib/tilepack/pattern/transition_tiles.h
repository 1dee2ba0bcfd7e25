#pragma once

#include <cstdint>

namespace tilepack {

/// The materials at the corners of a cell: those of cell (i, j), (i+1, j), (i, j+1) and (i+1, j+1) of the map that says
/// which material is where, whose cells are the lattice points here.   [LN03, section 3.3]
///
///   nw ── ne
///   │      │
///   sw ── se
struct CornerMaterials {
  std::int64_t nw = 0, ne = 0, sw = 0, se = 0;

  /// One material all round: no transition is needed, and what comes in is passed through.
  constexpr bool plain() const { return nw == ne && nw == sw && nw == se; }
  bool operator==(const CornerMaterials&) const = default;
};

/// The transition tile among m⁴: the corners are its digits, as they are of the id in a complete set of corner tiles of m
/// colors (lookup, id_in_complete_set()), so that a set whose corner colors are materials is looked up by it.
/// Materials 0..m-1.
constexpr std::int64_t transition_code(const CornerMaterials& c, std::int64_t m) {
  return ((c.nw * m + c.ne) * m + c.sw) * m + c.se;
}

/// The tile among 2⁴ that shows the border of one family on clear ground, over whatever else is there: a digit is 1 where
/// the corner is of the family. 0: nothing of it, 15: nothing else.
constexpr std::int64_t border_code(const CornerMaterials& c, std::int64_t family) {
  return transition_code({c.nw == family, c.ne == family, c.sw == family, c.se == family}, 2);
}

} // namespace tilepack
