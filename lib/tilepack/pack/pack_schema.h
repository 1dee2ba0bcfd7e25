#pragma once

#include <string_view>

namespace tilepack {

/// The text of pack.schema.json, the JSON Schema of pack.json.
std::string_view pack_schema();

} // namespace tilepack
