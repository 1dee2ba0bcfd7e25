#pragma once

#include "tilepack/numeric/rect.h"
#include "tilepack/tileset/material_map.h"

#include <span>
#include <vector>

namespace tilepack {

/// Several materials as one sample: their maps side by side, so that a place in it says which material is shown and
/// where. What is made of several samples is made of copies of this one.
///
///     ┌─────────┐┐┌──────┐┐        each material's last column and last row are repeated, a texel to either side and
///     │    A    │││  B   ││        down to the height of the highest: what lies beyond a sample is never that of
///     └─────────┘│└──────┘│        another one
///      └──────────┘└───────┘
struct JoinedSamples {
  std::vector<SampleMap> maps; ///< as those of the first material, of the deepest depth, without files
  std::vector<Rect> places;    ///< of each material, from west to east

  /// Which material a column of the maps belongs to.
  int material_at(int x) const;
};

/// Throws Error (invalid_content) unless all have the same maps: names in the same order, roles, channels, encodings, contents,
/// ways of green and ranges.
void require_joinable(std::span<const std::span<const SampleMap>> materials);

/// `materials`: one or more, each the maps of a material in register. Sizes may differ from material to material. Throws
/// as require_joinable() does.
JoinedSamples joined(std::span<const std::span<const SampleMap>> materials);

} // namespace tilepack
