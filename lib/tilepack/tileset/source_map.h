#pragma once

#include "tilepack/tileset/tile_set.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tilepack {

/// A texel of the sample, 0 <= x < width, 0 <= y < height.
struct SourceTexel {
  std::int32_t x = 0;
  std::int32_t y = 0;
  bool operator==(const SourceTexel&) const = default;
};

/// Where each texel of each tile was taken from: what synthesis decides, once for all maps of a material.
/// Tiles are made by copying, so texels are verbatim and maps can't lose their register.
struct SourceMap {
  Size tile_size;
  ColorCounts colors;
  TileColors tiles; ///< id → colors
  std::vector<std::vector<SourceTexel>>
      texels;    ///< id → tile_size.height * tile_size.width sources, row by row
  int guard = 0; ///< see TileSet::guard
};

/// Copies the texels of every sample map to where `sources` says. The maps have one size.
TileSet assembled(const SourceMap& sources, std::span<const SampleMap> samples);

} // namespace tilepack
