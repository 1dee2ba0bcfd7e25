#include "tilepack/pack/map_meaning.h"

#include "tilepack/pack/json_enum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

namespace tilepack {
namespace {

constexpr double largest_height = 1e30; // of values that are baked

void check_role(const JsonCursor& field, const MapFormat& map, Role role) {
  if (map.role != role)
    field.fail(fmt::format("is for maps of role {}, and this one is {}", name_of(role), name_of(map.role)));
}

} // namespace

void add_meaning(const MapFormat& map, JsonValue& json) {
  if (!map.contents.empty()) {
    JsonValue contents = JsonValue::array();
    for (const ChannelContent content : map.contents) contents.push_back(name_of(content));
    json["contents"] = std::move(contents);
  }
  if (map.normal_y) json["normal_y"] = name_of(*map.normal_y);
  if (map.range) json["range"] = JsonValue::array({map.range->low, map.range->high});
}

std::string meaning_text(const MapFormat& map) {
  if (map.normal_y) return fmt::format("green {}", name_of(*map.normal_y));
  if (map.range) return fmt::format("0 to 1 stand for {:.6g} to {:.6g}", map.range->low, map.range->high);
  if (map.contents.size() == 1) return std::string(name_of(map.contents.front()));
  std::string text;
  constexpr std::string_view letters = "RGBA";
  for (std::size_t c = 0; c < std::min(map.contents.size(), letters.size()); ++c)
    text += fmt::format("{}{} {}", c == 0 ? "" : ", ", letters[c], name_of(map.contents[c]));
  return text;
}

void read_meaning(const JsonCursor& json, MapFormat& map, int channels) {
  if (const auto contents = json.find("contents")) {
    check_role(*contents, map, Role::data);
    const auto count = static_cast<std::size_t>(channels);
    contents->array(count, count);
    for (std::size_t c = 0; c < count; ++c) map.contents.push_back(named<ChannelContent>(contents->item(c)));
  }
  if (const auto y = json.find("normal_y")) {
    check_role(*y, map, Role::normal);
    map.normal_y = named<NormalY>(*y);
  }
  if (const auto range = json.find("range")) {
    check_role(*range, map, Role::height);
    range->array(2, 2);
    map.range = ValueRange{range->item(0).number(-largest_height, largest_height),
                           range->item(1).number(-largest_height, largest_height)};
    if (!(map.range->low < map.range->high))
      range->fail(fmt::format("{} is no range; the first number is less than the second", range->shown()));
  }
}

} // namespace tilepack
