#pragma once

#include "tilepack/bake/bake.h"
#include "tilepack/report/vector_drawing.h"
#include "tilepack/synth/set_faults.h"

#include <vector>

namespace tilepack {

/// A place of a tile where the set can be told from its sample, and the place of the sample that it is most like.
struct WorstPlace {
  int tile = 0;
  Rect area;         ///< of the tile, within it
  SourceTexel like;  ///< where the window of this size lies in the sample as used
  bool tone = false; ///< a tone ends there in a straight line; else a cut is seen most
};

/// The worst of both kinds, the first half of them ends of tones if there are as many; at most `count`.
std::vector<WorstPlace> worst_places(const BakedPack& made, int count);

/// Each place enlarged, its number above it, beside what it is most like in the sample. `sample` as for bake_pictures.h.
VectorDrawing worst_places_picture(const Image& sample, const SourceMap& sources,
                                   const std::vector<WorstPlace>& places);

} // namespace tilepack
