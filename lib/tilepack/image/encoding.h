#pragma once

#include "tilepack/image/image.h"
#include "tilepack/numeric/enum_names.h"

#include <span>
#include <string_view>

namespace tilepack {

/// How stored values relate to light.
enum class Encoding {
  srgb,   ///< IEC 61966-2-1 transfer curve; the alpha channel, if any, is linear
  linear, ///< values are proportional to what they mean (light, height, roughness, vector components)
};

/// The width of a stored channel. Integers are normalised to 0..1.
enum class Depth { u8, u16, f16, f32 };

/// The linear value of an sRGB-encoded one, and back. Defined for all finite values: odd-symmetric below 0,
/// the power branch continued above 1. Within 1e-14 of the exact value, relative. Computed from + - * / only,
/// so the bits are the same on every machine.
double srgb_to_linear(double encoded);
double linear_to_srgb(double linear);

/// How many of 1 to 4 channels carry light, or whatever it is: all but alpha, the last of 2 or 4.
constexpr int color_channels(int channels) {
  return channels - (channels % 2 == 0 ? 1 : 0);
}

/// The image decoded to linear light: all channels of an sRGB image but alpha, nothing for `linear`.
/// The alpha channel is the last of 2 or 4.
Image to_linear(const Image& image, Encoding encoding);

/// Inverse of to_linear; the values are not yet rounded to a depth.
Image from_linear(const Image& image, Encoding encoding);

/// Each value as it would come back from a file of this depth: integers clamped to 0..1 and rounded to the
/// nearest code (half up), half rounded to nearest even, float as it is. NaN becomes 0 for integers.
Image quantised(Image image, Depth depth);
float quantised(float value, Depth depth);

/// The integer code that stands for `value` where `top` stands for 1: clamped to 0..top, rounded half up, 0
/// for NaN. `top` is 255 or 65535.
inline int code_of(float value, int top) {
  if (!(value > 0.0f)) return 0;
  if (value >= 1.0f) return top;
  return static_cast<int>(static_cast<double>(value) * top + 0.5);
}

/// Names as they stand in pack.json and options.
template <>
inline constexpr auto enum_names<Encoding> =
    std::array{EnumName{Encoding::srgb, "srgb"}, EnumName{Encoding::linear, "linear"}};
template <>
inline constexpr auto enum_names<Depth> =
    std::array{EnumName{Depth::u8, "u8"}, EnumName{Depth::u16, "u16"}, EnumName{Depth::f16, "f16"},
               EnumName{Depth::f32, "f32"}};

} // namespace tilepack
