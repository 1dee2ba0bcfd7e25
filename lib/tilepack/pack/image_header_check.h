#pragma once

#include "tilepack/image/encoding.h"
#include "tilepack/image/image.h"

#include <filesystem>
#include <span>

namespace tilepack {

/// What pack.json announces of an image file, against its header, before its texels take any memory. Throws
/// Error: cannot_read if the file is truncated or no image, invalid_content if the size, the channels or the
/// depth (any of `depths` will do) are others.
void check_image_header(const std::filesystem::path& file, Size size, int channels,
                        std::span<const Depth> depths);

} // namespace tilepack
