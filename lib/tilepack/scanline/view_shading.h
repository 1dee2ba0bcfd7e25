#pragma once

#include "tilepack/sampler/render_target.h"
#include "tilepack/sampler/texture.h"
#include "tilepack/scanline/view_spans.h"

#include <span>

namespace tilepack {

/// What the pixels of a band show of a texture, one row a row of `pixels`, encoded and rounded as the target
/// says. Pixels that show nothing have `background`, texture.channels() values as they are to be stored.
Image shade(const Texture& texture, const ViewPixels& pixels, const RenderTarget& target,
            std::span<const float> background);

} // namespace tilepack
