#include "tilepack/mip/downsample.h"

#include <cstddef>

namespace tilepack {
namespace {

// With the number of channels known to the compiler the loop runs in vector registers.
template <std::size_t channels>
void halve_plainly(const float* north, const float* south, float* to, std::size_t width) {
  for (std::size_t x = 0; x < width; ++x, north += 2 * channels, south += 2 * channels, to += channels)
    for (std::size_t c = 0; c < channels; ++c)
      to[c] = ((north[c] + north[c + channels]) + (south[c] + south[c + channels])) * 0.25f;
}

void halve_by_alpha(const float* north, const float* south, float* to, std::size_t width,
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

void halve_rows(std::span<const float> north, std::span<const float> south, int channels, Weighting weighting,
                std::span<float> to) {
  const std::size_t width = to.size() / static_cast<std::size_t>(channels);
  if (weighting == Weighting::by_alpha)
    halve_by_alpha(north.data(), south.data(), to.data(), width, static_cast<std::size_t>(channels));
  else if (channels == 1)
    halve_plainly<1>(north.data(), south.data(), to.data(), width);
  else if (channels == 2)
    halve_plainly<2>(north.data(), south.data(), to.data(), width);
  else if (channels == 3)
    halve_plainly<3>(north.data(), south.data(), to.data(), width);
  else
    halve_plainly<4>(north.data(), south.data(), to.data(), width);
}

Image halved(const Image& image, Weighting weighting) {
  Image result = Image::unset({image.width() / 2, image.height() / 2}, image.channels());
  for (int y = 0; y < result.height(); ++y)
    halve_rows(image.row(2 * y), image.row(2 * y + 1), image.channels(), weighting, result.row(y));
  return result;
}

} // namespace tilepack
