#pragma once

#include "tilepack/pack/pack.h"

#include <filesystem>

namespace tilepack {

/// Reads a pack from its folder or its pack.json, and checks it against the format: every field known, typed
/// and in range, every file inside the folder and of the size announced. Throws Error: cannot_read for
/// missing or broken files, invalid_content (naming the JSON path, the value and the range) for the rest.
Pack read_pack(const std::filesystem::path& folder_or_json);

} // namespace tilepack
