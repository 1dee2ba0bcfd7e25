#pragma once

#include "tilepack/image/image.h"

#include <cstddef>
#include <span>

namespace tilepack {

/// The tag 274 of TIFF and Exif: how the rows and columns of a file lie in the picture. 1 upright, 2 mirrored
/// left to right, 3 turned by 180 degrees, 4 mirrored top to bottom, 5 to 8 the same with rows and columns
/// exchanged (6: turn it clockwise, 8: counterclockwise). Other values count as 1.

/// Whether width and height change places.
constexpr bool swaps_sides(int orientation) {
  return orientation >= 5 && orientation <= 8;
}

/// The picture upright.
Image upright(Image image, int orientation);

/// The orientation in a block of Exif (a TIFF directory, with or without "Exif\0\0" before it); 1 if it has none.
int orientation_of_exif(std::span<const std::byte> exif);

} // namespace tilepack
