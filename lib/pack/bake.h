#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/pack/packing.h"
#include "tilepack/synth/set_report.h"
#include "tilepack/synth/synthesize.h"

#include <optional>
#include <span>
#include <vector>

namespace tilepack {

/// Which tiles of the colors asked for are made.
enum class TileChoice {
  complete,   ///< every combination: (Kh · Kv)² edge-colored tiles, or K⁴ corner-colored ones
  sequential, ///< 2 · Kh · Kv edge-colored tiles for an index map filled row by row
              ///< (tileset/sequential_set.h)
};

/// Everything that decides a pack besides its sample. Field by field the options of `tilepack bake` and the
/// keys of a preset: see pack/bake_fields.h, which holds their names, ranges and help.
/// The defaults are those of `tilepack bake`: 2 corner colors in a de Bruijn layout. Edge colors take three
/// fields together, synth.coloring, synth.colors and layout (tile_index for a complete set).
struct BakeOptions : PackingOptions {
  BakeOptions() {
    layout = LayoutKind::de_bruijn;
    synth.coloring = Coloring::corner;
    synth.colors = {0, 0, 2};
  }

  SynthOptions synth;
  bool fit_tile_size = false; ///< tile sides become whole periods of the sample, near synth.tile_size
  TileChoice set = TileChoice::complete;
  int flatten = 0; ///< percent of slow shading taken out of the sample, 0..100 (synth/flatten.h)
};

/// Sample maps → flattening → synthesis → layout → mips → mapping → pack, in memory. `samples[0]` is the main
/// map.
///
/// Throws Error: usage for options that are out of range, contradict each
/// other or would make a texture over most_texels_a_level; invalid_content for samples of unequal sizes or
/// too small; and what the stages throw. Deterministic as they are.
Pack bake(std::span<const SampleMap> samples, const BakeOptions& options, const Progress& progress = {});

/// A pack and how it came about, for reports.
struct BakedPack {
  Pack pack;
  StudiedSample sample; ///< as used: after flattening
  SourceMap sources;    ///< where the pack's tiles come from, by the pack's ids
  SetReport report;     ///< of these sources
  SynthOptions synth;   ///< as used: tile_size is the fitted one
  int flatten = 0;      ///< as in the options

  /// The sample maps after flattening, which all above is about; none if flatten is 0.
  std::vector<SampleMap> flattened;

  /// The sample maps that the tiles are copied from. `given`: those that baked() got.
  std::span<const SampleMap> samples_used(std::span<const SampleMap> given) const {
    return flattened.empty() ? given : std::span<const SampleMap>(flattened);
  }
};

/// As bake, which returns the pack alone.
BakedPack baked(std::span<const SampleMap> samples, const BakeOptions& options,
                const Progress& progress = {});

} // namespace tilepack
