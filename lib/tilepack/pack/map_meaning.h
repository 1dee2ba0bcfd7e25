#pragma once

#include "tilepack/json/json_cursor.h"
#include "tilepack/json/json_value.h"
#include "tilepack/tileset/material_map.h"

#include <string>

namespace tilepack {

/// What the values of a map stand for, where its role doesn't say it all: the optional fields "contents",
/// "normal_y" and "range" of an entry of "maps" in pack.json.
///
/// Adds those that are known to `json`, an object.
void add_meaning(const MapFormat& map, JsonValue& json);

/// The same for people: "R ao, G roughness, B metallic", "green up", "0 to 1 stand for -3 to 9"; empty if nothing is
/// known.
std::string meaning_text(const MapFormat& map);

/// Reads them back into `map`, whose role is known. Throws Error (invalid_content) for a field that is for
/// another role, a list of contents that has not one entry for each of `channels`, and a range that is empty or
/// beyond 1e30.
void read_meaning(const JsonCursor& json, MapFormat& map, int channels);

} // namespace tilepack
