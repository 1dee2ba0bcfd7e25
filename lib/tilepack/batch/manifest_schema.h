#pragma once

#include <string_view>

namespace tilepack {

/// The text of manifest.schema.json, the JSON Schema of manifests.
std::string_view manifest_schema();

} // namespace tilepack
