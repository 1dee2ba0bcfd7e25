#pragma once

#include "tilepack/image/texel_memory.h"
#include "tilepack/numeric/rect.h"

#include <cstddef>
#include <span>

namespace tilepack {

/// An image as every stage passes it: floats, interleaved channels, row 0 on top, x east, y south; the centre
/// of texel (x, y) is at (x + 0.5, y + 0.5).
///
/// The values are those of the file: 8-bit and 16-bit integers as v / 255 and v / 65535, half and float as
/// they are. Integers of up to 16 bits survive the trip through float exactly. What a value means
/// (sRGB-encoded color, plain number, normal) is said beside the image, by an Encoding or a Role.
class Image {
public:
  Image() = default;
  Image(int width, int height, int channels, float fill = 0.0f)
      : size_in_texels{width, height}, channel_count(channels),
        values(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                   static_cast<std::size_t>(channels),
               fill) {}

  /// Takes over row-major, interleaved values, width * height * channels of them (std::invalid_argument
  /// otherwise).
  Image(Size size, int channels, Texels texels);

  /// Values unset, for whoever writes all of them.
  static Image unset(Size size, int channels);

  int width() const { return size_in_texels.width; }
  int height() const { return size_in_texels.height; }
  int channels() const { return channel_count; }
  Size size() const { return size_in_texels; }
  bool empty() const { return values.empty(); }

  /// All channels of texel (x, y); 0 <= x < width, 0 <= y < height, unchecked.
  std::span<float> texel(int x, int y) { return {values.data() + offset(x, y), channels_as_size()}; }
  std::span<const float> texel(int x, int y) const {
    return {values.data() + offset(x, y), channels_as_size()};
  }

  /// One row, width * channels values.
  std::span<float> row(int y) { return {values.data() + offset(0, y), row_length()}; }
  std::span<const float> row(int y) const { return {values.data() + offset(0, y), row_length()}; }

  Texels& data() { return values; }
  const Texels& data() const { return values; }

  bool operator==(const Image&) const = default;

private:
  std::size_t channels_as_size() const { return static_cast<std::size_t>(channel_count); }
  std::size_t row_length() const {
    return static_cast<std::size_t>(size_in_texels.width) * channels_as_size();
  }
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(size_in_texels.width) +
            static_cast<std::size_t>(x)) *
           channels_as_size();
  }

  Size size_in_texels;
  int channel_count = 0;
  Texels values;
};

/// The part of `image` inside `rect`, which must lie within it (std::out_of_range otherwise).
Image crop(const Image& image, Rect rect);

/// Copies `patch` into `image` with its north-west texel at (x, y). Same channels, and it must fit
/// (std::out_of_range otherwise).
void paste(Image& image, const Image& patch, int x, int y);

} // namespace tilepack
