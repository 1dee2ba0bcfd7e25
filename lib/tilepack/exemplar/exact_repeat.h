#pragma once

#include "tilepack/tileset/material_map.h"

#include <span>

namespace tilepack {

/// The shortest distances after which all maps show themselves again, texel by texel, moved along one axis: what
/// drawn patterns do, checkerboards, stripes, grids. 1: the same all along the axis; 0: no such distance up to a
/// quarter of the side. Costs next to nothing where there is none.
struct ExactRepeat {
  int x = 0;
  int y = 0;

  /// A window of one repeat shows all there is.
  bool both() const { return x > 0 && y > 0; }
};

/// `samples`: maps of one size.
ExactRepeat exact_repeat(std::span<const SampleMap> samples);

} // namespace tilepack
