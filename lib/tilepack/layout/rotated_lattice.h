#pragma once

#include "tilepack/layout/layout.h"

#include <cstdint>

namespace tilepack {

/// A place of a rotated layout in whole lattice steps: `east` steps along the tiles' east sides, `south`
/// along their south sides. Many steps lead to one place, since the texture wraps; see site_at.
struct LatticeStep {
  std::int64_t east = 0;
  std::int64_t south = 0;
};

/// The geometry of a scheme on its texture, in exact arithmetic.
///
/// Its places ("sites") are numbered 0..N-1. In units of 1/columns and 1/rows of the texture's sides, a
/// site's north-west corner has whole coordinates, those of Cell.
class RotatedLattice {
public:
  explicit RotatedLattice(const RotatedScheme& scheme);

  int sites() const { return static_cast<int>(steps.size()); }
  int columns() const { return column_count; }
  int rows() const { return row_count; }

  int site_at(LatticeStep step) const;

  /// One way to get to a site from site 0; 0 <= east.
  LatticeStep step_to(int site) const { return steps[static_cast<std::size_t>(site)]; }

  /// Column and row of a site's north-west corner (tile is left 0).
  Cell cell_of(int site) const;

  /// The site whose corner is at this column and row, or -1 if the scheme has none there.
  int site_with(int column, int row) const;

  int east_of(int site) const { return neighbour(site, 1, 0); }
  int south_of(int site) const { return neighbour(site, 0, 1); }

  /// The site that owns a texel of a texture of this size, and where in it the texel's centre lies, as
  /// fractions 0 <= x, y < 1 of the cell's sides. A centre on a border belongs to the site east or south of
  /// it.
  struct Owner {
    int site = 0;
    double x = 0;
    double y = 0;
  };
  Owner owner_of(Size texture, int texel_x, int texel_y) const;

private:
  int neighbour(int site, int east, int south) const;
  std::int64_t key(LatticeStep step) const;

  RotatedScheme scheme;
  int column_count = 0;
  int row_count = 0;
  std::vector<LatticeStep> steps; // by site
  std::vector<std::int64_t> keys; // by site, rising
};

} // namespace tilepack
