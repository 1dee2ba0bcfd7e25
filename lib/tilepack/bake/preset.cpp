#include "tilepack/bake/preset.h"

#include "tilepack/bake/text_file.h"
#include "tilepack/error/nearest_name.h"
#include "tilepack/json/json_cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

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
  known.insert(known.end(), {"purpose", "cost", "format"}); // the last: an old name
  root.only(known);
  const auto told = [&](const char* key) {
    const auto words = root.find(key);
    return words ? words->text(1000) : std::string();
  };
  Preset preset{name, told("purpose"), told("cost"), {}};
  const auto take = [&](const std::string& key, const BakeField& field) {
    if (const auto value = root.find(key))
      preset.settings.push_back({field.name, text_value(*value, field.type),
                                 fmt::format("{}: \"{}\"", file, key), ErrorKind::invalid_content});
  };
  for (const BakeField& field : bake_fields()) take(field.name, field);
  for (const BakeField& field : bake_fields())
    if (field.name == field_name_now("format")) take("format", field);
  bake_options(preset.settings); // throws if a value is out of range
  return preset;
}

std::vector<Preset> built_in_presets() {
  std::vector<Preset> presets;
  for (const PresetText& text : built_in_preset_texts())
    presets.push_back(parsed_preset(text.json, std::string(text.name), fmt::format("preset {}", text.name)));
  return presets;
}

bool is_preset_file(const std::string& name) {
  const auto texts = built_in_preset_texts();
  const bool built_in =
      std::any_of(texts.begin(), texts.end(), [&](const PresetText& text) { return text.name == name; });
  return !built_in && std::filesystem::is_regular_file(name);
}

Preset preset_called(const std::string& name) {
  std::vector<std::string> known;
  for (Preset& preset : built_in_presets()) {
    if (preset.name == name) return std::move(preset);
    known.push_back(preset.name);
  }
  const std::filesystem::path file(name);
  if (is_preset_file(name))
    return parsed_preset(read_text_file(name, "the preset"), file.stem().string(), name);
  if (file.has_parent_path() || file.has_extension())
    throw Error(ErrorKind::cannot_read, name, "there is no such preset file");
  const std::string nearest = nearest_name(name, known);
  throw Error(ErrorKind::usage, field("preset"),
              fmt::format("there is no preset '{}'; {}{} shows them, and a FILE is taken too", name,
                          nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest),
                          field("list-presets")));
}

} // namespace tilepack
