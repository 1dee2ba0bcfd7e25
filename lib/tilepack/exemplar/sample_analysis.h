#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/exemplar/period.h"
#include "tilepack/exemplar/saliency.h"
#include "tilepack/exemplar/statistics.h"

#include <optional>
#include <span>

namespace tilepack {

/// What synthesis and the reports on it need to know of a sample, found once.
struct SampleAnalysis {
  FeatureImage features;
  SampleStatistics statistics; ///< of the features
  Saliency saliency;           ///< likewise
  Periodicity periods;
};

/// `halvings`: see saliency_of().
SampleAnalysis analysed(FeatureImage features, const Periodicity& periods, int halvings = 0);

/// `samples`: one or more maps of one size. `periods`: theirs, where they are known already.
SampleAnalysis analysed(std::span<const SampleMap> samples, const std::optional<Periodicity>& periods = {},
                        int halvings = 0);

} // namespace tilepack
