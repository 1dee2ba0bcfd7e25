#pragma once

#include "tilepack/sampler/render_target.h"
#include "tilepack/sampler/virtual_texture.h"
#include "tilepack/tileset/material_map.h"

#include <string>

namespace tilepack::cli {

/// What `render` and `compose` ask of pictures alike.

/// --rect: X,Y,W,H, whole numbers, as far as a window can reach. Throws Error (usage).
VirtualRect parsed_rect(const std::string& text);

/// The file format is asked for by the extension of --output; the depth of the map is kept if the format has it.
/// `encoding`: srgb, linear or empty. Throws Error (usage).
RenderTarget target_for(const std::string& file, const MapFormat& map, const std::string& encoding);

} // namespace tilepack::cli
