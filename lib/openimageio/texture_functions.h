#pragma once

#include "tilepack/bench/openimageio_textures.h"

namespace tilepack {

/// What TextureSystem points to.
TextureMaker texture_maker(Size size, int channels, Depth depth,
                           const std::function<Image(int top, int rows)>& band);
double maketx(const std::filesystem::path& image, const std::filesystem::path& texture);
TextureLookup open_texture(const std::filesystem::path& file, int channels, Size side);

} // namespace tilepack
