#pragma once

#include "tilepack/pack/pack.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tilepack {

/// What a page that shows a pack's endless texture is told beside the pack.
struct ViewPageSettings {
  std::string title;            ///< plain text
  std::string made_by;          ///< the command, for the head of the page
  std::uint64_t content = 0;    ///< pack_content_hash()
  std::optional<double> metres; ///< width of a tile, for a scale
};

/// One page that stands alone and shows the virtual texture by WebGL 2, by the lookup that shader_text() writes: to
/// pan and zoom, to fly over, lit by the pack's normal map if it has one, with tints for tiles, borders, levels and
/// repeats, and other mappings of the same tiles to choose from. Every texel is in it, in 8 bits; the same pack gives
/// the same bytes.
///
/// Error (invalid_content) for packs that a browser can't show: see shader_text(), and more than 192 MiB of texels.
std::string view_page(const Pack& pack, const ViewPageSettings& settings);

/// The page with its places open: {{TITLE}}, {{HEAD}}, {{DATA}}.
std::string_view view_page_template();

} // namespace tilepack
