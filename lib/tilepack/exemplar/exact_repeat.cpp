#include "tilepack/exemplar/exact_repeat.h"

#include <algorithm>

namespace tilepack {
namespace {

bool repeats_along_x(const Image& image, int distance) {
  const auto skipped = static_cast<std::ptrdiff_t>(distance) * image.channels();
  for (int y = 0; y < image.height(); ++y) {
    const auto row = image.row(y);
    if (!std::equal(row.begin() + skipped, row.end(), row.begin())) return false;
  }
  return true;
}

bool repeats_along_y(const Image& image, int distance) {
  for (int y = distance; y < image.height(); ++y) {
    const auto row = image.row(y);
    if (!std::equal(row.begin(), row.end(), image.row(y - distance).begin())) return false;
  }
  return true;
}

template <typename Repeats>
int shortest(std::span<const SampleMap> samples, int side, Repeats repeats) {
  for (int distance = 1; distance <= side / 4; ++distance)
    if (std::all_of(samples.begin(), samples.end(),
                    [&](const SampleMap& map) { return repeats(map.image, distance); }))
      return distance;
  return 0;
}

} // namespace

ExactRepeat exact_repeat(std::span<const SampleMap> samples) {
  if (samples.empty()) return {};
  const Size size = samples[0].image.size();
  return {shortest(samples, size.width, repeats_along_x), shortest(samples, size.height, repeats_along_y)};
}

} // namespace tilepack
