#include "tilepack/exemplar/sample_analysis.h"

#include "tilepack/numeric/side_by_side.h"

#include <utility>

namespace tilepack {

SampleAnalysis analysed(FeatureImage features, const Periodicity& periods, int halvings) {
  SampleAnalysis sample{std::move(features), {}, {}, periods};
  both_side_by_side([&] { sample.statistics = SampleStatistics(sample.features); },
                    [&] { sample.saliency = saliency_of(sample.features, halvings); });
  return sample;
}

SampleAnalysis analysed(std::span<const SampleMap> samples, const std::optional<Periodicity>& periods,
                        int halvings) {
  SampleAnalysis sample;
  Periodicity found;
  both_side_by_side([&] { sample = analysed(feature_image(samples), {}, halvings); },
                    [&] { found = periods ? *periods : detect_periods(samples); });
  sample.periods = found;
  return sample;
}

} // namespace tilepack
