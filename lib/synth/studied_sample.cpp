#include "tilepack/synth/studied_sample.h"

#include <tbb/parallel_invoke.h>

#include <utility>

namespace tilepack {

StudiedSample studied(FeatureImage features, const Periodicity& periods) {
  StudiedSample sample{std::move(features), {}, {}, periods};
  tbb::parallel_invoke([&] { sample.statistics = SampleStatistics(sample.features); },
                       [&] { sample.deviations = cell_deviations(sample.features); });
  return sample;
}

StudiedSample studied(std::span<const SampleMap> samples, const std::optional<Periodicity>& periods) {
  StudiedSample sample;
  Periodicity found;
  tbb::parallel_invoke([&] { sample = studied(feature_image(samples), {}); },
                       [&] { found = periods ? *periods : detect_periods(samples); });
  sample.periods = found;
  return sample;
}

} // namespace tilepack
