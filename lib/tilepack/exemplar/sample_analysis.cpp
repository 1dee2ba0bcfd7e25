#include "tilepack/exemplar/sample_analysis.h"

#include <tbb/parallel_invoke.h>

#include <utility>

namespace tilepack {

SampleAnalysis analysed(FeatureImage features, const Periodicity& periods) {
  SampleAnalysis sample{std::move(features), {}, {}, periods};
  tbb::parallel_invoke([&] { sample.statistics = SampleStatistics(sample.features); },
                       [&] { sample.saliency = saliency_of(sample.features); });
  return sample;
}

SampleAnalysis analysed(std::span<const SampleMap> samples, const std::optional<Periodicity>& periods) {
  SampleAnalysis sample;
  Periodicity found;
  tbb::parallel_invoke([&] { sample = analysed(feature_image(samples), {}); },
                       [&] { found = periods ? *periods : detect_periods(samples); });
  sample.periods = found;
  return sample;
}

} // namespace tilepack
