#pragma once

#include <cstddef>
#include <cstdint>

namespace tilepack {

/// Many lookups at once, as a structure of arrays. Sample i lies at tile_x[i] + x[i] tiles from the west
/// border of the virtual texture and tile_y[i] + y[i] from its north border. All arrays have `count` entries.
struct SampleBatch {
  std::size_t count = 0;
  const std::int32_t* tile_x = nullptr; ///< null: all 0
  const std::int32_t* tile_y = nullptr; ///< null: all 0
  const float* x = nullptr;             ///< any float, as in TileCoordinate::fraction
  const float* y = nullptr;
  const float* level = nullptr; ///< null: all 0
};

/// How exactly bilinear and level weights are kept.
enum class Weights {
  exact,    ///< floats
  fixed_8_8 ///< positions rounded to 1/256 texel and level weights to 1/256, as graphics hardware does
};

/// How the texels are kept for fast lookup; which one follows from the map.
enum class TexelStorage {
  u8,  ///< linear 8-bit maps: as they are
  u16, ///< linear 16-bit maps as they are; sRGB 8-bit maps decoded to linear light, off by 7.7e-6 at most
  f16, ///< linear half maps: as they are
  f32  ///< everything else: decoded floats; color with alpha is premultiplied
};

} // namespace tilepack
