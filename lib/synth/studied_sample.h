#pragma once

#include "tilepack/synth/feature_image.h"
#include "tilepack/synth/landmark.h"
#include "tilepack/synth/period.h"
#include "tilepack/synth/statistics.h"

#include <optional>
#include <span>

namespace tilepack {

/// What synthesis and the reports on it need to know of a sample, found once.
struct StudiedSample {
  FeatureImage features;
  SampleStatistics statistics; ///< of the features
  CellDeviations deviations;   ///< likewise
  Periodicity periods;
};

StudiedSample studied(FeatureImage features, const Periodicity& periods);

/// `samples`: one or more maps of one size. `periods`: theirs, where they are known already.
StudiedSample studied(std::span<const SampleMap> samples, const std::optional<Periodicity>& periods = {});

} // namespace tilepack
