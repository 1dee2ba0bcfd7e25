#include "tilepack/synth/studied_sample.h"

#include <tbb/parallel_invoke.h>

namespace tilepack {

StudiedSample studied(std::span<const SampleMap> samples, const std::optional<Periodicity>& periods) {
  StudiedSample sample;
  tbb::parallel_invoke(
      [&] {
        sample.features = feature_image(samples);
        sample.statistics = SampleStatistics(sample.features);
      },
      [&] { sample.periods = periods ? *periods : detect_periods(samples); });
  return sample;
}

} // namespace tilepack
