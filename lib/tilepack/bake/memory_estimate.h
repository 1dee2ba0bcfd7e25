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
///   + a sample's texel   4 C + F + 4/3 (F + 1) + 5   C channels of all maps as floats, F features, the same with one of
///                                               structure and its pyramid, what is known of the texel; 4 C more
///                                               where maps may be flattened, straightened or continued, be it that
///                                               the sample decides
///   + a searched texel   105                    of the level that is searched, and 40 where it is searched in parts
///   + a tile's texel     16/3 C + 23            levels of the pack; source, encoder; 4 C more where tiles are not
///                                               given up as they are placed; 32 C more where floats are stored (EXR)
///   + a cell             9                      of an index mapping
///
/// C and F count over all maps; a tile's texel counts as often as the texture is larger than its tiles. Where the size of
/// tiles follows the sample, the largest it can be counts. A sample that may wrap counts with the tile by which it would be
/// continued along each axis. Not counted: the tiles of a normal map, which are kept until all maps are placed. The
/// coefficients of C and F follow from the types held; the constants are fitted to bakes with one to four maps, 512² to 8192²
/// texels, 16 to 256 tiles: tests/bake/memory_estimate_test.cpp holds the estimate against measured peaks, which it meets
/// within 20 % where no copy is made.
std::int64_t memory_estimate(std::span<const MapShape> maps, const BakeOptions& options, int threads);

} // namespace tilepack
