#pragma once

#include "tilepack/image/image.h"

#include <cstddef>
#include <vector>

namespace tilepack {

/// `image` as an 8-bit sRGB PNG in memory, for embedding in other documents. 1 to 4 channels; the same image
/// gives the same bytes.
std::vector<std::byte> png_bytes(const Image& image);

} // namespace tilepack
