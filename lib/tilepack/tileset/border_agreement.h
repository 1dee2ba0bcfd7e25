#pragma once

#include "tilepack/tileset/tile_set.h"

#include <string>
#include <vector>

namespace tilepack {

/// A texel on the border of a tile that differs from the texel at the same place of the first tile whose
/// border has the same color.
struct BorderDifference {
  std::string map;
  int tile = 0;
  int reference = 0; ///< the first tile of that color
  std::string side;  ///< "north", "east", "south", "west"
  std::string color; ///< "color 1", or for corner coloring "corner colors 0, 1"
  int x = 0;         ///< the texel of both tiles that differs most
  int y = 0;
  int channel = 0;
  double difference = 0; ///< of stored values, 0..1 for integers
  int texels = 0;        ///< that differ along this border
};

/// Where drawings disagree: for every tile and side, its outermost row of texels against that of the first
/// tile of the same color on the same side. Texels that differ by more than `tolerance` in any channel count.
/// For edge coloring the corner texels are left out: two edges meet there, and a color says nothing about the
/// other one. The largest difference first.
std::vector<BorderDifference> border_differences(const TileSet& set, double tolerance = 0);

/// How many rows of texels along each border agree exactly, in all maps: the guard that the drawings keep. At
/// most an eighth of the shorter side; near their ends rows are compared up to where another border's begin.
int agreed_guard(const TileSet& set);

/// How far round lattice points a corner pack is to be blended in (sampler/corner_blend.h), in quarters of a
/// texel. Let tiles with the same two edge colors at a corner have the same texels, in all maps, for lookups
/// up to r texels from it. Then the width is r, at most half the shorter side, and the corner pack adds no
/// error. Where r is less than the 3.2 texels that mending a corner takes, it is up to 2 r, so that the
/// corner pack alone counts up to r: what is gained at the corner outweighs what is lost between r and 2 r.
///
/// 0 where a corner pack is of no use: all tiles have the same corner texels, so that any tile may lie
/// beyond; r is 0; or colors belong to corners.
double agreed_corner_width(const TileSet& set);

} // namespace tilepack
