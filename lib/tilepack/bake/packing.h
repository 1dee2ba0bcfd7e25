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

/// Of a rotated layout alone.
struct RotatedOptions {
  std::optional<RotatedScheme> scheme; ///< this one; unset: what the search finds best
  std::optional<int> gutter;           ///< texels round each tile; unset: 0 where neighbours match, else 2
  bool power_of_two = false;           ///< sides of the texture
  ResampleFilter turn_filter = ResampleFilter::lanczos; ///< how turned tiles are resampled
};

/// Of an array layout alone.
struct ArrayOptions {
  int border = 0; ///< texels round each layer's tile; 0 or a power of two, at most half a tile
};

/// How a finished tile set becomes a pack, whether synthesized or drawn by hand.
struct PackingOptions {
  LayoutKind layout = LayoutKind::tile_index; ///< tile_index: edge coloring; de_bruijn: corner coloring
  RotatedOptions rotated;
  ArrayOptions array;
  bool corner_pack = false; ///< edge coloring and a complete set only
  MipOptions mips;
  bool full_mips = false;             ///< past the levels of tiles on down to one texel (mip/far_levels.h)
  std::optional<MappingKind> mapping; ///< unset: even for corner sets of 2 to 4 colors, else mix
  VirtualSize virtual_size{256, 256};
  std::optional<PackFormat> format; ///< of all maps; unset: what the depth asks for
  std::optional<Depth> depth; ///< of all maps; unset: each map keeps its own, or the nearest of `format`
};

/// What is settled about a pack before any tile exists.
struct PackingPlan {
  PackingOptions options; ///< as given
  Layout layout;          ///< where each tile will lie
  Size texture;           ///< texels of level 0 of every map; of an array layout: of one layer
  MappingKind mapping = MappingKind::mix;
};

/// Finds the place of every tile, which for a rotated layout may search for seconds, and refuses what can't be
/// packed: options that contradict each other, the coloring or the set, and textures beyond
/// most_texels_a_level. Error (usage) names the field and the way out. A set that misses or repeats a tile of a
/// layout for complete sets is Error (invalid_content). Deterministic.
PackingPlan planned_packing(const PackingOptions& options, const TileColors& tiles, Size tile_size);

/// Mips → mapping → pack, in memory, with its tiles where `plan` says, which was made for the colors and size
/// of this set. `generator` is left to the caller. Throws as the stages do. Deterministic. A color map that
/// changes between integer and float changes its encoding too: PNG is sRGB, EXR linear.
Pack packed(TileSet set, const PackingPlan& plan, std::uint64_t seed, const Progress& progress = {});

/// The same with a plan made for it.
Pack packed(TileSet set, const PackingOptions& options, std::uint64_t seed, const Progress& progress = {});

} // namespace tilepack
