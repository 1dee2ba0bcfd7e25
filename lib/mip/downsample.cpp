#include "tilepack/mip/downsample.h"

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
  for (int y = 0; y < result.height(); ++y) {
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
  }
  return result;
}

} // namespace tilepack
