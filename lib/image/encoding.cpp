#include "tilepack/image/encoding.h"

#include <Imath/half.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tilepack {
namespace {

constexpr double linear_segment_end = 0.0031308; // in linear light
constexpr double encoded_segment_end = 0.04045;

// Fifth and third roots by Newton's iteration on y^n = x. std::pow would do, but the C library picks another
// variant on processors with fused multiply-add, and its last bit differs. The start value comes from the
// exponent alone, so at most 8 steps remain until the iteration stands still; it falls monotonically after
// the first step.
double root(double x, int n) {
  int exponent = 0;
  std::frexp(x, &exponent);
  double y = std::ldexp(1.0, exponent >= 0 ? (exponent + n - 1) / n : exponent / n);
  for (int step = 0; step < 64; ++step) {
    double power = 1.0;
    for (int i = 1; i < n; ++i) power *= y;
    const double next = y - (y - x / power) / n;
    if (!(next < y)) break;
    y = next;
  }
  return y;
}

double decode_positive(double v) {
  if (v <= encoded_segment_end) return v / 12.92;
  const double base = (v + 0.055) / 1.055;
  return base * base * root(base * base, 5); // x^2.4 = x^2 * (x^2)^(1/5)
}

double encode_positive(double v) {
  if (v <= linear_segment_end) return v * 12.92;
  const double twelfth = std::sqrt(std::sqrt(root(v, 3)));
  const double squared = twelfth * twelfth;
  return 1.055 * (squared * squared * twelfth) - 0.055; // x^(5/12)
}

// Images hold few distinct 8-bit values, so those are looked up; the table holds exactly what decode_positive
// returns.
const std::array<float, 256>& decode_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (int i = 0; i < 256; ++i)
      t[static_cast<std::size_t>(i)] =
          static_cast<float>(decode_positive(static_cast<double>(static_cast<float>(i) / 255.0f)));
    return t;
  }();
  return table;
}

float decode_float(float v) {
  const float code = v * 255.0f;
  const int i = static_cast<int>(std::clamp(code + 0.5f, 0.0f, 255.0f));
  if (static_cast<float>(i) / 255.0f == v) return decode_table()[static_cast<std::size_t>(i)];
  return static_cast<float>(srgb_to_linear(static_cast<double>(v)));
}

// Channels that carry light; alpha is the last of 2 or 4.
int color_channels(const Image& image) {
  return image.channels() - (image.channels() % 2 == 0 ? 1 : 0);
}

template <typename F>
Image mapped_colors(const Image& image, F&& f) {
  Image result = image;
  const int colors = color_channels(image);
  const std::size_t channels = static_cast<std::size_t>(image.channels());
  auto& values = result.data();
  for (std::size_t i = 0; i < values.size(); i += channels)
    for (std::size_t c = 0; c < static_cast<std::size_t>(colors); ++c) values[i + c] = f(values[i + c]);
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
  if (encoding == Encoding::linear) return image;
  return mapped_colors(image, decode_float);
}

Image from_linear(const Image& image, Encoding encoding) {
  if (encoding == Encoding::linear) return image;
  return mapped_colors(image,
                       [](float v) { return static_cast<float>(linear_to_srgb(static_cast<double>(v))); });
}

float quantised(float value, Depth depth) {
  switch (depth) {
  case Depth::u8:
  case Depth::u16: {
    const float top = depth == Depth::u8 ? 255.0f : 65535.0f;
    if (!(value > 0.0f)) return 0.0f;
    if (value >= 1.0f) return 1.0f;
    return static_cast<float>(std::floor(static_cast<double>(value) * static_cast<double>(top) + 0.5)) / top;
  }
  case Depth::f16:
    return static_cast<float>(half(value));
  case Depth::f32:
    break;
  }
  return value;
}

Image quantised(const Image& image, Depth depth) {
  Image result = image;
  if (depth != Depth::f32)
    for (float& v : result.data()) v = quantised(v, depth);
  return result;
}

std::string_view name_of(Encoding encoding) {
  return encoding == Encoding::srgb ? "srgb" : "linear";
}

std::string_view name_of(Depth depth) {
  switch (depth) {
  case Depth::u8:
    return "u8";
  case Depth::u16:
    return "u16";
  case Depth::f16:
    return "f16";
  case Depth::f32:
    break;
  }
  return "f32";
}

} // namespace tilepack
