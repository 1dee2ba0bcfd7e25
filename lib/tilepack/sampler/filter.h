#pragma once

#include "tilepack/numeric/enum_names.h"

#include <optional>
#include <string_view>

namespace tilepack {

/// How texels around a place are weighed.
enum class Filter {
  nearest,   ///< the texel that holds the place
  bilinear,  ///< the four texels round it, in one level
  trilinear, ///< bilinear in the two levels next to the one asked for, blended
};

template <>
inline constexpr auto enum_names<Filter> =
    std::array{EnumName{Filter::nearest, "nearest"}, EnumName{Filter::bilinear, "bilinear"},
               EnumName{Filter::trilinear, "trilinear"}};

/// The levels a lookup reads: (1 - coarse_weight) of `fine` and coarse_weight of `coarse`.
struct LevelBlend {
  int fine = 0;
  int coarse = 0;
  double coarse_weight = 0; ///< 0 <= coarse_weight < 1; 0 when fine == coarse
  bool operator==(const LevelBlend&) const = default;
};

/// Level 0 is the finest of `levels` >= 1. Levels outside 0..levels-1 are clamped to it, NaN counts as 0.
/// Nearest and bilinear round to the nearest level, halves to the coarser; trilinear blends the two around.
LevelBlend level_blend(double level, int levels, Filter filter);

/// The two texels next to a place along one axis: `first` with weight 1 - weight, first + 1 with `weight`.
struct Taps {
  int first = 0; ///< -1..tile_side-1, from the border of the tile that holds the place
  double weight = 0;
};

/// Bilinear taps for a place `fraction` of a tile from its border (0 <= fraction < 1).
Taps bilinear_taps(double fraction, int tile_side);

/// The texel that holds the place, 0..tile_side-1.
int nearest_texel(double fraction, int tile_side);

} // namespace tilepack
