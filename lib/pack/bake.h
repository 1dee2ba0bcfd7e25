#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/pack/pack.h"
#include "tilepack/synth/synthesize.h"

#include <optional>
#include <span>

namespace tilepack {

/// The image files a pack may be made of: PNG holds u8 and u16, EXR f16 and f32.
enum class PackFormat { png, exr };

/// Everything that decides a pack besides its sample. Field by field the options of `tilepack bake` and the
/// keys of a preset: see pack/bake_fields.h, which holds their names, ranges and help.
struct BakeOptions {
  SynthOptions synth;
  bool fit_tile_size = false; ///< tile sides become whole periods of the sample, near synth.tile_size
  LayoutKind layout = LayoutKind::tile_index; ///< tile_index: edge coloring; de_bruijn: corner coloring
  bool corner_pack = false;                   ///< edge coloring only
  MipOptions mips;
  MappingKind mapping = MappingKind::permutation;
  VirtualSize virtual_size{256, 256};
  std::optional<PackFormat> format; ///< of all maps; unset: what the depth asks for
  std::optional<Depth> depth; ///< of all maps; unset: each map keeps its own, or the nearest of `format`
};

/// Sample maps → synthesis → layout → mips → mapping → pack, in memory. `samples[0]` is the main map.
///
/// A color map that changes between integer and float changes its encoding too: PNG is sRGB, EXR linear. All
/// else is kept as in the sample. Throws Error: usage for options that are out of range, contradict each
/// other or would make a texture over most_texels_a_level; invalid_content for samples of unequal sizes or
/// too small; and what the stages throw. Deterministic as they are.
Pack bake(std::span<const SampleMap> samples, const BakeOptions& options, const Progress& progress = {});

} // namespace tilepack
