#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/tileset/source_map.h"

#include <vector>

namespace tilepack {

/// What a tile shows at a place, and how much it stands out there.
struct TilePlace {
  int tile = 0;
  Rect area;           ///< of the tile; may reach over its borders
  double strength = 0; ///< in the unit of what was looked for
};

/// Where a tone ends in a line. A cut along which texels differ little can part what is light from what is dark all the same,
/// and where it runs straight, the eye sees a board of two colors or a patch laid on wood. Single texels, of which
/// SetFigures::cut_mean speaks, don't tell.
///
/// A line of 20 texels, north-south or east-west, that has a cut within 2 texels of it nearly all along is a break if
/// the mean colors of what lies 12 texels deep on its two sides differ more than 19 of 20 such lines of the sample do,
/// and a quarter beyond, and by a fifth of the sample's standard deviation or more. Borders of tiles are looked at with a
/// tile beyond them that may lie there. Texels are those of tiles halved until they have less than 256 (halvings_to_usual).
struct ToneBreaks {
  bool looked = false; ///< tiles are large enough for such lines, 30 texels or more a side
  double share = 0;    ///< length of all breaks over that of all borders of tiles
  std::vector<TilePlace>
      worst; ///< strongest first, apart from each other, at most 16; strength: times the limit
};
ToneBreaks tone_breaks(const FeatureImage& image, const SourceMap& sources);

/// Where cuts are seen most: squares of 24 texels by the mean square of what is seen across their cuts, the worst first, at
/// most `count` and none two at one place. strength: RMS, over all texels of the square, 0..255.
std::vector<TilePlace> dearest_places(const FeatureImage& image, const SourceMap& sources, int count);

} // namespace tilepack
