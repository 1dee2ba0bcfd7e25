#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/image/stored_format.h"
#include "tilepack/layout/layout_search.h"
#include "tilepack/layout/place_tiles.h"
#include "tilepack/pack/pack.h"

#include <optional>
#include <string>
#include <vector>

namespace tilepack {

/// The image files a pack may be made of: PNG holds u8 and u16, EXR f16 and f32.
using PackFormat = ImageContainer;

/// How a finished tile set becomes a pack, whether synthesized or drawn by hand.
struct PackingOptions {
  LayoutKind layout = LayoutKind::tile_index; ///< tile_index: edge coloring; de_bruijn: corner coloring
  std::optional<RotatedScheme> scheme;        ///< rotated: this one; unset: what the planner finds best
  std::optional<int> gutter; ///< rotated: texels round each tile; unset: 0 where neighbours match, else 2
  bool power_of_two = false; ///< rotated: sides of the texture
  ResampleFilter turn_filter = ResampleFilter::lanczos; ///< rotated: how turned tiles are resampled
  int border = 0; ///< array: texels round each layer's tile; 0 or a power of two, at most half a tile
  bool corner_pack = false; ///< edge coloring and a complete set only
  MipOptions mips;
  std::optional<MappingKind> mapping; ///< unset: even for corner sets of 2 to 4 colors, else mix
  VirtualSize virtual_size{256, 256};
  std::optional<PackFormat> format; ///< of all maps; unset: what the depth asks for
  std::optional<Depth> depth; ///< of all maps; unset: each map keeps its own, or the nearest of `format`
};

/// Refuses what can't be packed before any long work: options that contradict each other, the coloring or the
/// set, and textures beyond most_texels_a_level. Error (usage); names the option and the way out. A set that
/// misses or repeats a tile of a layout for complete sets is Error (invalid_content).
void check_packing(const PackingOptions& options, const TileColors& tiles, Size tile_size);

/// Layout → mips → mapping → pack, in memory. `generator` is left to the caller. Throws as check_packing and
/// the stages do. Deterministic. A color map that changes between integer and float changes its encoding too:
/// PNG is sRGB, EXR linear.
Pack packed(TileSet set, const PackingOptions& options, std::uint64_t seed, const Progress& progress = {});

} // namespace tilepack
