#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/pack/pack.h"
#include "tilepack/synth/synthesize.h"

#include <optional>
#include <span>

namespace tilepack {

/// Everything that decides a pack besides its sample. Field by field the options of `tilepack bake` and the
/// keys of a preset: see pack/bake_fields.h, which holds their names, ranges and help.
struct BakeOptions {
  SynthOptions synth;
  LayoutKind layout = LayoutKind::tile_index;
  bool corner_pack = false;
  MipOptions mips;
  MappingKind mapping = MappingKind::permutation;
  VirtualSize virtual_size{256, 256};
  std::optional<Depth> depth; ///< of all maps; unset: each map keeps its own
};

/// Sample maps → synthesis → layout → mips → mapping → pack, in memory. `samples[0]` is the main map.
/// Errors are those of the stages; deterministic as they are.
Pack bake(std::span<const SampleMap> samples, const BakeOptions& options, const Progress& progress = {});

} // namespace tilepack
