#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/tileset/source_map.h"

#include <cstdint>

namespace tilepack::quality {

struct Coherence {
  double p50 = 0;
  double p95 = 0;
};

/// How much random 8 x 8 patches inside the tiles look like patches of the sample: the RMS distance, in 8-bit
/// units, to the nearest patch of all, exactly. 0: copied whole.
Coherence patch_coherence(const FeatureImage& sample, const SourceMap& sources, int patches,
                          std::uint64_t seed);

} // namespace tilepack::quality
