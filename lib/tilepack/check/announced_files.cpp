#include "tilepack/check/announced_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tilepack {
namespace {

using nlohmann::json;
using Kind = AnnouncedFile::Kind;

const json* member(const json& value, const char* name) {
  if (!value.is_object()) return nullptr;
  const auto found = value.find(name);
  return found == value.end() ? nullptr : &*found;
}

std::optional<int> whole(const json* value) {
  if (!value || !value->is_number_integer()) return std::nullopt;
  const double number = value->get<double>();
  if (number < 0 || number > 2147483647.0) return std::nullopt;
  return value->get<int>();
}

std::optional<Size> size_of(const json* value) {
  if (!value || !value->is_array() || value->size() != 2) return std::nullopt;
  const auto width = whole(&(*value)[0]);
  const auto height = whole(&(*value)[1]);
  if (!width || !height) return std::nullopt;
  return Size{*width, *height};
}

std::optional<Depth> depth_of(const json* value) {
  for (const Depth depth : {Depth::u8, Depth::u16, Depth::f16, Depth::f32})
    if (value && *value == std::string(name_of(depth))) return depth;
  return std::nullopt;
}

void add_maps(const json* maps, Kind kind, const std::string& path, std::vector<AnnouncedFile>& files) {
  if (!maps || !maps->is_array()) return;
  for (std::size_t m = 0; m < maps->size(); ++m) {
    const json& map = (*maps)[m];
    const json* levels = member(map, "levels");
    if (!levels || !levels->is_array()) continue;
    for (std::size_t l = 0; l < levels->size(); ++l) {
      const json* name = member((*levels)[l], "file");
      if (!name || !name->is_string()) continue;
      files.push_back({kind, static_cast<int>(m), static_cast<int>(l),
                       fmt::format("{}[{}].levels[{}].file", path, m, l), name->get<std::string>(),
                       size_of(member((*levels)[l], "size")), whole(member(map, "channels")),
                       depth_of(member(map, "depth"))});
    }
  }
}

} // namespace

std::vector<AnnouncedFile> announced_files(std::string_view pack_json) {
  const json root = json::parse(pack_json, nullptr, false);
  std::vector<AnnouncedFile> files;
  add_maps(member(root, "maps"), Kind::map, "maps", files);
  if (const json* corner = member(root, "corner_pack"))
    add_maps(member(*corner, "maps"), Kind::corner_map, "corner_pack.maps", files);
  if (const json* mapping = member(root, "mapping"))
    if (const json* name = member(*mapping, "file"); name && name->is_string())
      files.push_back({Kind::index_map, 0, 0, "mapping.file", name->get<std::string>(),
                       size_of(member(*mapping, "virtual_size")), 1, std::nullopt});
  return files;
}

} // namespace tilepack
