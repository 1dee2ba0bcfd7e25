#include "tilepack/report/view_page.h"

#include "tilepack/error/error.h"
#include "tilepack/error/field.h"
#include "tilepack/json/json_value.h"
#include "tilepack/layout/layout.h"
#include "tilepack/report/html_page.h"
#include "tilepack/shader/shader_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <variant>
#include <vector>
#include <zlib.h>

namespace tilepack {
namespace {

void fill_in(std::string& page, std::string_view place, std::string_view text) {
  for (std::size_t at = page.find(place); at != std::string::npos; at = page.find(place, at + text.size()))
    page.replace(at, place.size(), text);
}

std::string base64(const std::vector<unsigned char>& bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) -> std::uint32_t {
      return i + k < bytes.size() ? bytes[i + k] : 0u;
    };
    const std::uint32_t word = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::uint32_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string levels_json(const PackedMap& map) {
  std::string text;
  for (std::size_t l = 0; l < map.levels.size() + map.far_levels.size(); ++l) {
    const Image& level = l < map.levels.size() ? map.levels[l] : map.far_levels[l - map.levels.size()];
    const Image shown =
        is_light(map) && map.encoding == Encoding::linear ? from_linear(level, Encoding::srgb) : level;
    std::vector<unsigned char> bytes;
    for (int y = 0; y < shown.height(); ++y)
      for (const float value : shown.row(y)) bytes.push_back(static_cast<unsigned char>(code_of(value, 255)));
    text += (text.empty() ? "" : ",\n") + view_page_level(shown.size(), bytes);
  }
  return text;
}

// The mean of the coarsest level: what is seen from afar.
std::array<double, 3> mean_of(const PackedMap& map) {
  const Image level = to_linear(map.levels.back(), map.encoding);
  std::array<double, 3> sum{};
  for (int y = 0; y < level.height(); ++y)
    for (int x = 0; x < level.width(); ++x)
      for (std::size_t c = 0; c < 3; ++c)
        sum[c] += static_cast<double>(level.texel(x, y)[map.channels < 3 ? 0 : c]);
  for (double& value : sum) value /= static_cast<double>(level.width()) * level.height();
  return sum;
}

std::string map_script(const PackedMap& map) {
  const std::array<double, 3> mean = mean_of(map);
  return fmt::format(
      "{{\"name\": {}, \"role\": {}, \"channels\": {}, \"srgb\": {}, \"mean\": [{:.6f}, {:.6f}, {:.6f}], "
      "\"levels\": [\n{}]}}",
      json_text(map.name), json_text(std::string(name_of(map.role))), map.channels,
      is_light(map) && map.channels >= 3, mean[0], mean[1], mean[2], levels_json(map));
}

std::string maps_json(const std::vector<PackedMap>& maps) {
  std::string text;
  for (const PackedMap& map : maps) text += (text.empty() ? "" : ",\n") + map_script(map);
  return "[" + text + "]";
}

// The pack without its texels, for its lookup.
Pack bare(const Pack& pack) {
  Pack result;
  result.tile_size = pack.tile_size;
  result.colors = pack.colors;
  result.tiles = pack.tiles;
  result.layout = pack.layout;
  result.mapping = pack.mapping;
  result.tile_levels = pack.tile_levels;
  result.full_chain = pack.full_chain;
  for (const PackedMap& map : pack.maps)
    result.maps.emplace_back(map.name, map.role, map.encoding, map.depth, map.channels, std::vector<Image>{});
  if (pack.corner_pack)
    result.corner_pack =
        CornerPack{pack.corner_pack->columns, pack.corner_pack->rows, pack.corner_pack->width, {}};
  return result;
}

bool is_complete(const Pack& pack) {
  if (const auto* corners = std::get_if<std::vector<CornerTile>>(&pack.tiles))
    return pack.colors.corner > 0 && *corners == complete_corner_set(pack.colors.corner);
  return std::get<std::vector<EdgeTile>>(pack.tiles) ==
         complete_edge_set(pack.colors.horizontal, pack.colors.vertical);
}

// The pack's own mapping first, then others of the same tiles.
std::string mappings_json(const Pack& pack, const ViewPageSettings& settings) {
  std::vector<Mapping> mappings{pack.mapping};
  const auto add = [&](MappingKind kind, auto&& made) {
    if (pack.mapping.kind != kind) mappings.push_back(made());
  };
  const VirtualSize size = pack.mapping.size;
  const std::uint64_t seed = pack.generator.seed;
  if (is_complete(pack)) {
    if (has_even_pattern(pack.colors.corner))
      add(MappingKind::even, [&] { return even_mapping(size, pack.colors.corner, seed); });
    add(MappingKind::mix, [&] { return mix_mapping(size, seed); });
    if (std::max(size.width, size.height) <= 1024)
      add(MappingKind::permutation, [&] { return permutation_mapping(size, pack.colors, seed); });
  }
  Pack with = bare(pack);
  std::string text;
  for (const Mapping& mapping : mappings) {
    with.mapping = mapping;
    text += fmt::format("{}{{\"name\": \"{}\", \"ids\": {}, \"text\": {}}}", text.empty() ? "" : ",\n",
                        name_of(mapping.kind), mapping.kind == MappingKind::index,
                        json_text(shader_text(with, {}, settings.made_by, settings.content)));
  }
  return "[" + text + "]";
}

void check_size(const Pack& pack) {
  std::size_t bytes = pack.mapping.ids.size() * 2;
  const auto count = [&](const std::vector<PackedMap>& maps) {
    for (const PackedMap& map : maps)
      for (const Image& level : map.levels)
        bytes += static_cast<std::size_t>(level.width()) * static_cast<std::size_t>(level.height()) *
                 static_cast<std::size_t>(map.channels);
  };
  count(pack.maps);
  if (pack.corner_pack) count(pack.corner_pack->maps);
  if (bytes > most_page_bytes)
    throw Error(ErrorKind::invalid_content, "view",
                fmt::format("{} MiB of texels; a page holds {} at most: bake with a smaller {} or fewer {}",
                            bytes >> 20, most_page_bytes >> 20, field("tile-size"), field("colors")));
}

} // namespace

std::string view_page_bytes(const std::vector<unsigned char>& bytes) {
  uLongf length = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<unsigned char> packed(length);
  if (compress2(packed.data(), &length, bytes.data(), static_cast<uLong>(bytes.size()), 9) != Z_OK)
    throw Error(ErrorKind::internal, "view", "zlib fails");
  packed.resize(length);
  return base64(packed);
}

std::string view_page_level(Size size, const std::vector<unsigned char>& bytes) {
  return fmt::format("{{\"width\": {}, \"height\": {}, \"data\": \"{}\"}}", size.width, size.height,
                     view_page_bytes(bytes));
}

std::string view_page_ids(const Mapping& mapping) {
  std::vector<unsigned char> bytes;
  for (const int id : mapping.ids) {
    bytes.push_back(static_cast<unsigned char>(id & 255));
    bytes.push_back(static_cast<unsigned char>(id >> 8));
  }
  return view_page_bytes(bytes);
}

std::string page_with(const ViewPageSettings& settings, std::string_view kind, std::string data,
                      std::string_view script) {
  fill_in(data, "</", "<\\/"); // it would end the script that the data stand in
  std::string page(view_page_template());
  fill_in(page, "{{SCENE}}", script.empty() ? "" : fmt::format("<script>\n{}</script>\n", script));
  fill_in(page, "{{TITLE}}", escaped(settings.title));
  fill_in(page, "{{HEAD}}",
          escaped(fmt::format("{} · content of the {} {:016x}", settings.made_by, kind, settings.content)));
  fill_in(page, "{{DATA}}", data);
  return page;
}

std::string view_page(const Pack& pack, const ViewPageSettings& settings) {
  check_size(pack);
  std::string data =
      fmt::format("{{\"tile\": [{}, {}], \"levels\": {}, \"layers\": {}, \"virtual\": [{}, {}], \"metres\": "
                  "{}, \"exact\": {},\n",
                  pack.tile_size.width, pack.tile_size.height, pack.tile_levels,
                  pack.layout.kind == LayoutKind::array ? pack.layout.rows : 0, pack.mapping.size.width,
                  pack.mapping.size.height, settings.metres ? fmt::format("{}", *settings.metres) : "null",
                  pack.layout.kind != LayoutKind::rotated);
  data += "\"mappings\": " + mappings_json(pack, settings) + ",\n\"maps\": " + maps_json(pack.maps);
  data += ",\n\"corners\": " + (pack.corner_pack ? maps_json(pack.corner_pack->maps) : "null");
  data += ",\n\"ids\": " +
          (pack.mapping.kind == MappingKind::index ? fmt::format("\"{}\"", view_page_ids(pack.mapping))
                                                   : "null") +
          "}";
  return page_with(settings, "pack", data, {});
}

} // namespace tilepack
