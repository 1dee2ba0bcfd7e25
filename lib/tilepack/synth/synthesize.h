#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/exemplar/sample_analysis.h"
#include "tilepack/synth/synth_options.h"
#include "tilepack/tileset/source_map.h"

#include <span>

namespace tilepack {

/// Chooses patches of the sample and cuts between them, and returns where each texel of each tile of the
/// complete set comes from.
///
/// `samples` are one or more registered maps of one size; all of them count in every comparison. Throws Error
/// (usage) when an option is out of range and (invalid_content) when the sample is too small for the tile,
/// naming the largest tile that would fit. Deterministic: the result depends on samples and options alone.
SourceMap synthesize(std::span<const SampleMap> samples, const SynthOptions& options,
                     const Progress& progress = {});

/// The same for maps of one size that were analysed before.
SourceMap synthesize(const SampleAnalysis& sample, const SynthOptions& options,
                     const Progress& progress = {});

} // namespace tilepack
