#pragma once

#include "tilepack/bake/bake_options.h"
#include "tilepack/image/image.h"

#include <cstdint>
#include <span>

namespace tilepack {

/// What a header says about a map: all that an estimate needs of it.
struct MapShape {
  Size size;        ///< texels; the same for all maps of a material
  int channels = 0; ///< 1..4
  Depth depth = Depth::u8;
};

/// Bytes that a bake of these maps holds at its peak, the whole process counted. `maps`: one or more;
/// `threads`: those that stages may use, 1 or more.
///
///   program, libraries and a stack and buffers a thread
///   + a sample's texel   4 C + 4/3 F + 7.5      C channels of all maps as floats, F features and their pyramid,
///                                               what is known of the texel (saliency, statistics); 4 C more if
///                                               the maps are flattened
///   + a tile's texel     4 C + 16/3 C + 24      tiles, levels of the pack; source, coarser levels of the map at
///                                               hand, encoder; 32 C more where floats are stored (EXR)
///   + a cell             9                       of an index mapping
///
/// C and F count over all maps; a tile's texel counts as often as the texture is larger than its tiles. The
/// coefficients of C and F follow from the types held; the constants are fitted to bakes with one to four maps,
/// 512² to 2048² texels, 16 to 256 tiles. tests/bake/memory_estimate_test.cpp holds the estimate against
/// measured peaks: those of README.md (4 threads) are met within 17 %, others within 20 %.
std::int64_t memory_estimate(std::span<const MapShape> maps, const BakeOptions& options, int threads);

} // namespace tilepack
