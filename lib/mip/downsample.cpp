#include "tilepack/mip/downsample.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace tilepack {
namespace {

// With the number of channels known to the compiler the loop runs in vector registers.
template <std::size_t channels>
void halve_rows(const float* north, const float* south, float* to, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x, north += 2 * channels, south += 2 * channels, to += channels)
    for (std::size_t c = 0; c < channels; ++c)
      to[c] = ((north[c] + north[c + channels]) + (south[c] + south[c + channels])) * 0.25f;
}

void halve_rows_by_alpha(const float* north, const float* south, float* to, std::size_t width,
                         std::size_t channels) {
  const std::size_t alpha = channels - 1;
  for (std::size_t x = 0; x < width; ++x, north += 2 * channels, south += 2 * channels, to += channels) {
    const float nw = north[alpha];
    const float ne = north[alpha + channels];
    const float sw = south[alpha];
    const float se = south[alpha + channels];
    const float sum = (nw + ne) + (sw + se);
    for (std::size_t c = 0; c < alpha; ++c) {
      const float weighted =
          (nw * north[c] + ne * north[c + channels]) + (sw * south[c] + se * south[c + channels]);
      const float plain = (north[c] + north[c + channels]) + (south[c] + south[c + channels]);
      to[c] = sum > 0.0f ? weighted / sum : plain * 0.25f;
    }
    to[alpha] = sum * 0.25f;
  }
}

} // namespace

Image halved(const Image& image, Weighting weighting) {
  Image result(image.width() / 2, image.height() / 2, image.channels());
  const std::size_t width = static_cast<std::size_t>(result.width());
  // Large images alone are worth a task for each so many rows.
  constexpr std::size_t values_a_task = std::size_t{1} << 16;
  const std::size_t rows =
      std::max<std::size_t>(1, values_a_task / std::max<std::size_t>(1, image.row(0).size()));
  const auto halve_row = [&](int y) {
    const float* north = image.row(2 * y).data();
    const float* south = image.row(2 * y + 1).data();
    float* to = result.row(y).data();
    if (weighting == Weighting::by_alpha)
      halve_rows_by_alpha(north, south, to, width, static_cast<std::size_t>(image.channels()));
    else if (image.channels() == 1)
      halve_rows<1>(north, south, to, width);
    else if (image.channels() == 2)
      halve_rows<2>(north, south, to, width);
    else if (image.channels() == 3)
      halve_rows<3>(north, south, to, width);
    else
      halve_rows<4>(north, south, to, width);
  };
  using Range = tbb::blocked_range<int>;
  tbb::parallel_for(Range(0, result.height(), rows), [&](const Range& some) {
    for (int y = some.begin(); y < some.end(); ++y) halve_row(y);
  });
  return result;
}

} // namespace tilepack
