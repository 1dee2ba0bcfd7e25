#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/image/encoding.h"
#include "tilepack/image/image.h"
#include "tilepack/numeric/random.h"

#include <cstdint>
#include <string_view>

namespace tilepack::test {

/// Noise: every value its own, 0 to 1, rounded to what `depth` holds. Another seed or purpose is another noise.
inline Image noise(int width, int height, int channels, std::uint64_t seed, Depth depth = Depth::u8,
                   std::string_view purpose = "test noise") {
  const std::uint32_t steps = depth == Depth::u8 ? 255 : depth == Depth::u16 ? 65535 : 1u << 20;
  Image image(width, height, channels);
  std::uint64_t index = 0;
  for (float& value : image.data())
    value = quantised(static_cast<float>(random_below(seed, purpose, index++, steps + 1)) /
                          static_cast<float>(steps),
                      depth);
  return image;
}

/// The same for what looks at features: every byte its own.
inline FeatureImage noise_features(int width, int height, int channels, std::uint64_t seed) {
  FeatureImage image{width, height, channels, {}};
  const auto count = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height * channels);
  for (std::uint64_t i = 0; i < count; ++i)
    image.values.push_back(static_cast<std::uint8_t>(random_below(seed, "noise", i, 256)));
  return image;
}

} // namespace tilepack::test
