#pragma once

#include "tilepack/pack/pack.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// The page around `data`, the JSON that it shows, of a "pack" or a "scene"; `script`: what stands before its own.
std::string page_with(const ViewPageSettings& settings, std::string_view kind, std::string data,
                      std::string_view script);

/// Bytes as the page unpacks them: deflated, in base 64. A level of a texture, as JSON; and an index map's words of 16 bits.
std::string view_page_bytes(const std::vector<unsigned char>& bytes);
std::string view_page_level(Size size, const std::vector<unsigned char>& bytes);
std::string view_page_ids(const Mapping& mapping);

/// Light is stored by the sRGB curve, on which 8 bits suffice; all else as it is.
inline bool is_light(const PackedMap& map) {
  return map.role == Role::color || map.encoding == Encoding::srgb;
}

/// The most bytes that a page holds unpacked.
inline constexpr std::size_t most_page_bytes = std::size_t{192} << 20;

/// The page with its places open: {{SCENE}}, {{TITLE}}, {{HEAD}}, {{DATA}}. And the script of scenes.
std::string_view view_page_template();
std::string_view view_scene_script();

} // namespace tilepack
