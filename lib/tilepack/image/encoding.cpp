#include "tilepack/image/encoding.h"

#include "tilepack/numeric/exact_math.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Imath/half.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace tilepack {
namespace {

constexpr double linear_segment_end = 0.0031308; // in linear light
constexpr double encoded_segment_end = 0.04045;

// x^2.4 = x^3 / x^(3/5)
double decode_positive(double v) {
  const double x = (v + 0.055) / 1.055;
  const double y = exact_inverse_root<5>(x);
  return v <= encoded_segment_end ? v * (1.0 / 12.92) : x * x * x * (y * y * y);
}

// x^(5/12) = x / x^(7/12); the maximum keeps 0 away from the root, whose result is not used there.
double encode_positive(double v) {
  const double x = std::max(v, linear_segment_end);
  const double y = exact_inverse_root<12>(x), y3 = y * y * y;
  return v <= linear_segment_end ? v * 12.92 : 1.055 * (x * (y3 * y3 * y)) - 0.055;
}

template <typename F>
void for_each_block(Texels& values, std::size_t multiple, F&& f) {
  const std::size_t blocks = values.size() / multiple;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 1 << 14), [&](const auto& range) {
    f(std::span(values).subspan(range.begin() * multiple, range.size() * multiple));
  });
}

template <typename F>
Image mapped_colors(const Image& image, F&& f) {
  Image result = image;
  const auto channels = static_cast<std::size_t>(std::max(image.channels(), 1));
  const auto colors = static_cast<std::size_t>(color_channels(image.channels()));
  for_each_block(result.data(), channels, [&](std::span<float> block) {
    for (std::size_t i = 0; i < block.size(); i += channels)
      for (std::size_t c = 0; c < colors; ++c)
        block[i + c] = static_cast<float>(f(static_cast<double>(block[i + c])));
  });
  return result;
}

} // namespace

double srgb_to_linear(double encoded) {
  if (!std::isfinite(encoded)) return encoded;
  return encoded < 0 ? -decode_positive(-encoded) : decode_positive(encoded);
}

double linear_to_srgb(double linear) {
  if (!std::isfinite(linear)) return linear;
  return linear < 0 ? -encode_positive(-linear) : encode_positive(linear);
}

Image to_linear(const Image& image, Encoding encoding) {
  return encoding == Encoding::linear ? image
                                      : mapped_colors(image, [](double v) { return srgb_to_linear(v); });
}

Image from_linear(const Image& image, Encoding encoding) {
  return encoding == Encoding::linear ? image
                                      : mapped_colors(image, [](double v) { return linear_to_srgb(v); });
}

float quantised(float value, Depth depth) {
  switch (depth) {
  case Depth::u8:
    return static_cast<float>(code_of(value, 255)) / 255.0f;
  case Depth::u16:
    return static_cast<float>(code_of(value, 65535)) / 65535.0f;
  case Depth::f16:
    return static_cast<float>(half(value));
  case Depth::f32:
    break;
  }
  return value;
}

Image quantised(Image image, Depth depth) {
  if (depth != Depth::f32)
    for_each_block(image.data(), 1, [&](std::span<float> block) {
      for (float& v : block) v = quantised(v, depth);
    });
  return image;
}

} // namespace tilepack
