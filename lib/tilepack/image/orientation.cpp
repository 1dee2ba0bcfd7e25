#include "tilepack/image/orientation.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace tilepack {

Image upright(Image image, int orientation) {
  if (orientation < 2 || orientation > 8) return image;
  const Size size = swaps_sides(orientation) ? Size{image.height(), image.width()} : image.size();
  Image turned = Image::unset(size, image.channels());
  const int right = image.width() - 1, bottom = image.height() - 1;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      // Where the texel (x, y) of the picture lies in the file.
      int column = swaps_sides(orientation) ? y : x;
      int row = swaps_sides(orientation) ? x : y;
      if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8)
        column = right - column;
      if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7) row = bottom - row;
      const auto from = image.texel(column, row);
      std::copy(from.begin(), from.end(), turned.texel(x, y).begin());
    }
  return turned;
}

int orientation_of_exif(std::span<const std::byte> exif) {
  if (exif.size() >= 6 && std::memcmp(exif.data(), "Exif\0", 6) == 0) exif = exif.subspan(6);
  if (exif.size() < 8) return 1;
  const bool little = exif[0] == std::byte{'I'};
  const auto number = [&](std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
      value = value << 8 | std::to_integer<std::uint32_t>(exif[little ? at + count - 1 - i : at + i]);
    return value;
  };
  const std::size_t directory = number(4, 4);
  if (directory + 2 > exif.size()) return 1;
  const std::size_t entries = number(directory, 2);
  for (std::size_t i = 0; i < entries && directory + 2 + (i + 1) * 12 <= exif.size(); ++i) {
    const std::size_t entry = directory + 2 + i * 12;
    if (number(entry, 2) != 274) continue;
    const std::uint32_t value = number(entry + 8, 2);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

} // namespace tilepack
