#include "tilepack/pattern/source_samples.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

int finest_level_read(double level, Filter filter) {
  if (!(level > 0)) return 0;
  const double read = filter == Filter::trilinear ? std::floor(level) : std::floor(level + 0.5);
  return static_cast<int>(std::min(read, 64.0));
}

} // namespace

void SourceLookup::sample_map(int of_map, SourceSamples& samples, double finest, bool alpha, int wanted,
                              const RunValues& out) const {
  const PatternSource::Levels& levels = source.levels(of_map, use, finest_level_read(finest, filter));
  const FastSampler& sampler = use == PatternSource::Use::wang ? *levels.wang : *levels.patterns;
  const auto first = static_cast<float>(levels.first_level);
  if (first > 0)
    for (std::size_t i = 0; i < samples.count; ++i) samples.level[i] -= first;
  const int own = sampler.channels() - (alpha ? 1 : 0);
  std::array<float*, 4> to{};
  alignas(64) float unwanted[longest_run];
  for (int c = 0; c < own; ++c)
    to[static_cast<std::size_t>(c)] = c < wanted ? out.value[static_cast<std::size_t>(c)] : unwanted;
  if (alpha) to[static_cast<std::size_t>(own)] = out.cover;
  sampler.sample({samples.count, samples.tile_x, samples.tile_y, samples.x, samples.y, samples.level}, filter,
                 Weights::exact, {to.data(), static_cast<std::size_t>(sampler.channels())});
  for (int c = own; c < wanted; ++c) // grey for color
    std::copy_n(out.value[0], samples.count, out.value[static_cast<std::size_t>(c)]);
  if (first > 0)
    for (std::size_t i = 0; i < samples.count; ++i) samples.level[i] += first;
}

void SourceLookup::sample(SourceSamples& samples, double finest, const RunValues& out) const {
  const int alpha_map = source.facts().alpha_map;
  if (source.has(map)) {
    sample_map(map, samples, finest, alpha_map == map, channels, out);
  } else {
    for (int c = 0; c < channels; ++c)
      std::fill_n(out.value[static_cast<std::size_t>(c)], samples.count,
                  !vectors ? 0.0f
                  : c < 2  ? 0.5f
                           : 1.0f);
  }
  if (alpha_map < 0)
    std::fill_n(out.cover, samples.count, 1.0f);
  else if (alpha_map != map)
    sample_map(alpha_map, samples, finest, true, 0, out);
}

} // namespace tilepack
