#pragma once

#include "tilepack/bake/bake_options.h"
#include "tilepack/error/progress.h"
#include "tilepack/exemplar/sample_wrap.h"
#include "tilepack/synth/set_report.h"
#include "tilepack/synth/synthesize.h"

#include <span>
#include <vector>

namespace tilepack {

/// Sample maps → straightening → flattening → synthesis → layout → mips → mapping → pack, in memory. `samples[0]` is
/// the main map; all are as prepare_maps() leaves them.
///
/// Throws Error: usage for options that are out of range, contradict each
/// other or would make a texture over most_texels_a_level; invalid_content for samples of unequal sizes or
/// too small, or with values that the depth asked for can't hold;
/// and what the stages throw. Deterministic as they are.
Pack bake(std::span<const SampleMap> samples, const BakeOptions& options, const Progress& progress = {});

/// A pack and how it came about, for reports.
struct BakedPack {
  Pack pack;
  SampleAnalysis sample;    ///< as used: after straightening and flattening
  SourceMap sources;        ///< where the pack's tiles come from, by the pack's ids
  SetReport report;         ///< of these sources
  SynthOptions synth;       ///< as used: tile_size is the fitted one
  int flatten = 0;          ///< as in the options
  bool size_chosen = false; ///< synth.tile_size was found to suit the sample

  SampleWrap wrap; ///< along which axes the sample was continued by itself

  /// Texels, the furthest that a course was moved; 0: the sample was not straightened.
  double straightened = 0;

  /// The sample maps after straightening and flattening and, where they wrap, continued by a tile to the east and
  /// south, which all above is about; none if they are used as given.
  std::vector<SampleMap> prepared;

  /// The sample maps that the tiles are copied from. `given`: those that baked() got.
  std::span<const SampleMap> samples_used(std::span<const SampleMap> given) const {
    return prepared.empty() ? given : std::span<const SampleMap>(prepared);
  }
};

/// As bake, which returns the pack alone.
BakedPack baked(std::span<const SampleMap> samples, const BakeOptions& options,
                const Progress& progress = {});

} // namespace tilepack
