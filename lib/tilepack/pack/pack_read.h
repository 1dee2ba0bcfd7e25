#pragma once

#include "tilepack/pack/pack_json.h"

#include <filesystem>

namespace tilepack {

/// Reads a pack from its folder or its pack.json, and checks it against the format: every field known, typed
/// and in range, every file inside the folder and of the size, channels and depth announced. Throws Error:
/// cannot_read for missing or broken files, invalid_content (naming the JSON path, the value and the range)
/// for the rest. What a header announces is checked before memory is taken for texels.
Pack read_pack(const std::filesystem::path& folder_or_json);

/// The same without looking at any image.
PackDescription read_pack_description(const std::filesystem::path& folder_or_json);

/// `folder_or_json` itself, or the pack.json in it if it is a folder.
std::filesystem::path pack_json_of(const std::filesystem::path& folder_or_json);

} // namespace tilepack
