#pragma once

#include "tilepack/bake/bake_fields.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A named set of bake options for a purpose, from a JSON file:
///
///   { "purpose": "what it is for", "cost": "what it takes",  "tile-size": 256, "colors": "2x3", … }
///
/// Every other key is the name of a bake field; its value is written as BakeFieldType says. Purpose and cost
/// may be left out: a file of someone's own needs only what it sets.
struct Preset {
  std::string name;
  std::string purpose;
  std::string cost;
  std::vector<BakeSetting> settings; ///< checked against the fields' ranges
};

/// Reads a preset from its text. Throws Error (invalid_content) naming the key, the value and the range, and
/// for an unknown key the nearest one. `file` is how messages name the text.
Preset parsed_preset(std::string_view text, const std::string& name, const std::string& file);

/// The presets of the source tree's presets/, compiled in, in alphabetical order.
std::vector<Preset> built_in_presets();

/// A built-in preset by its name, else the one in the file of that name. Throws Error: usage for the field
/// "preset" if there is none, cannot_read for a path that leads nowhere, and as parsed_preset does.
Preset preset_called(const std::string& name);

/// Whether preset_called reads a file, and not a built-in one.
bool is_preset_file(const std::string& name);

/// One of them as its file was: what built_in_presets() parses.
struct PresetText {
  std::string_view name;
  std::string_view json;
};
std::span<const PresetText> built_in_preset_texts();

} // namespace tilepack
