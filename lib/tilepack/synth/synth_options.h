#pragma once

#include "tilepack/image/image.h"
#include "tilepack/numeric/enum_names.h"
#include "tilepack/tileset/tile_colors.h"

#include <cstdint>

namespace tilepack {

/// How the inside of a tile is made.
enum class Construction {
  quilt,  ///< the plain construction of [Cohen03]: four diamonds, one an edge color, cut along the tile's
          ///< diagonals
  framed, ///< strips along the edges are shared; each tile's inside is its own window of the sample
};

/// As options have them.
template <>
inline constexpr auto enum_names<Construction> =
    std::array{EnumName{Construction::framed, "patch"}, EnumName{Construction::quilt, "quilt"}};

struct SynthOptions {
  Size tile_size{128, 128}; ///< texels, each side 4..4096 and at most the sample's
  Coloring coloring = Coloring::edge;
  ColorCounts colors{
      2, 2, 0}; ///< edge: horizontal, vertical 1..8; corner: corner 1..4; variants 1..8, of framed tiles
  Construction interior = Construction::framed;
  int guard = 0;  ///< texels either side of an edge identical in all tiles of its color, 0..tile/8
  int effort = 5; ///< 0..9: time for quality
  std::uint64_t seed = 0;
};

} // namespace tilepack
