#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/synth/source_map.h"
#include "tilepack/synth/studied_sample.h"

#include <cstdint>
#include <span>

namespace tilepack {

/// How the inside of a tile is made.
enum class Interior {
  quilt, ///< the plain construction of [Cohen03]: four diamonds, one an edge color, cut along the tile's
         ///< diagonals
  patch, ///< strips along the edges are shared; each tile's inside is its own window of the sample
};

struct SynthOptions {
  Size tile_size{128, 128}; ///< texels, each side 4..4096 and at most the sample's
  Coloring coloring = Coloring::edge;
  ColorCounts colors{2, 2, 0}; ///< edge: horizontal, vertical 1..8; corner: corner 1..4
  Interior interior = Interior::patch;
  int guard = 0;  ///< texels either side of an edge identical in all tiles of its color, 0..tile/8
  int effort = 5; ///< 0..9: time for quality
  std::uint64_t seed = 0;
};

/// Chooses patches of the sample and cuts between them, and returns where each texel of each tile of the
/// complete set comes from.
///
/// `samples` are one or more registered maps of one size; all of them count in every comparison. Throws Error
/// (usage) when an option is out of range and (invalid_content) when the sample is too small for the tile,
/// naming the largest tile that would fit. Deterministic: the result depends on samples and options alone.
SourceMap synthesize(std::span<const SampleMap> samples, const SynthOptions& options,
                     const Progress& progress = {});

/// The same for maps of one size that were studied before.
SourceMap synthesize(const StudiedSample& sample, const SynthOptions& options, const Progress& progress = {});

} // namespace tilepack
