#include "tilepack/bake/preset.h"

#include "tilepack/json/json_cursor.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {
namespace {

std::string text_value(const JsonCursor& value, BakeFieldType type) {
  const auto integer = [&] { return fmt::format("{}", value.integer(INT64_MIN, INT64_MAX)); };
  switch (type) {
  case BakeFieldType::integer:
    return integer();
  case BakeFieldType::extent:
    return value.is_text() ? value.text() : integer();
  case BakeFieldType::choice:
    return value.text();
  case BakeFieldType::flag:
    break;
  }
  return value.boolean() ? "true" : "false";
}

} // namespace

Preset parsed_preset(std::string_view text, const std::string& name, const std::string& file) {
  const JsonCursor root = JsonCursor::parse(text, file);
  std::vector<std::string> known = bake_field_names();
  known.insert(known.end(), {"purpose", "cost"});
  root.only(known);
  Preset preset{name, root.member("purpose").text(1000), root.member("cost").text(1000), {}};
  for (const BakeField& field : bake_fields())
    if (const auto value = root.find(field.name))
      preset.settings.push_back(
          {field.name, text_value(*value, field.type), file + ": " + field.name, ErrorKind::invalid_content});
  bake_options(preset.settings); // throws if a value is out of range
  return preset;
}

std::vector<Preset> built_in_presets() {
  std::vector<Preset> presets;
  for (const PresetText& text : built_in_preset_texts())
    presets.push_back(parsed_preset(text.json, std::string(text.name), fmt::format("preset {}", text.name)));
  return presets;
}

} // namespace tilepack
