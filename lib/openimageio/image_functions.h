#pragma once

#include "tilepack/image/openimageio_module.h"

#include <string_view>

namespace tilepack {

/// What ImageIo points to. Errors are std::runtime_error, with OpenImageIO's words.
RasterReader open_image(const std::filesystem::path& file, ImageFormat format);
RasterWriter create_exr(ByteSink sink, Size size, int channels, Depth depth);

/// Writes a small EXR to nowhere, so that all threads of it start.
void warm_up();

/// The name by which OpenImageIO knows the format: "png", "jpeg", "tiff", "openexr".
std::string_view openimageio_name(ImageFormat format);

} // namespace tilepack
