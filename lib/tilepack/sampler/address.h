#pragma once

#include "tilepack/numeric/enum_names.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace tilepack {

/// A coordinate along one axis of the virtual texture: a whole tile and the fraction within it. Kept apart so
/// that 2^31 tiles a side lose nothing: the fraction has all 52 bits wherever it lies.
struct TileCoordinate {
  std::int64_t tile = 0;
  double fraction = 0; ///< 0 <= fraction < 1 after normalised(); from the west or north border of the tile
  bool operator==(const TileCoordinate&) const = default;
};

/// The same place with 0 <= fraction < 1. Defined for every input: a fraction that is NaN, infinite or beyond
/// 2^62 tiles counts as 0; one so little below a whole number that 1 - fraction rounds to 1 moves up to it.
TileCoordinate normalised(TileCoordinate coordinate);

/// The place `texels` texels of a level (tile_side texels a tile) from the origin of the virtual texture.
TileCoordinate from_texels(double texels, int tile_side);

/// The place whole + rest texels from the origin: exact in `whole`, however large.
TileCoordinate from_texels(std::int64_t whole, double rest, int tile_side);

/// What lies beyond the border of the virtual texture.
enum class WrapMode {
  wrap,   ///< the texture again: 0 1 2 | 0 1 2
  clamp,  ///< its outermost texels: 0 1 2 | 2 2 2
  mirror, ///< the texture turned round: 0 1 2 | 2 1 0, and so on
};

template <>
inline constexpr auto enum_names<WrapMode> =
    std::array{EnumName{WrapMode::wrap, "wrap"}, EnumName{WrapMode::clamp, "clamp"},
               EnumName{WrapMode::mirror, "mirror"}};

/// Number `index`, any, of a row of `count` >= 1 texels or tiles that goes on as `border` says: 0..count-1.
std::int64_t within(std::int64_t index, std::int64_t count, WrapMode border);

/// The place of a texture of `tiles` tiles that shows at `coordinate`, any: normalised, 0 <= tile < tiles.
/// Clamped places lie on the border itself; the far one, where a tile more would begin, as near below it as a
/// double can be.
TileCoordinate within(TileCoordinate coordinate, std::int64_t tiles, WrapMode border);

} // namespace tilepack
