#pragma once

#include "tilepack/pack/pack_folder.h"
#include "tilepack/pack/pack_json.h"

#include <filesystem>

namespace tilepack {

/// Reads a pack from its folder or its pack.json, and checks it against the format: every field known, typed
/// and in range, every file inside the folder and of the size, channels and depth announced. A pack that is
/// replaced meanwhile is read as it was or as it is, never half and half (PackFolder). Throws Error:
/// cannot_read for missing or broken files, invalid_content (naming the JSON path, the value and the range)
/// for the rest. What a header announces is checked before memory is taken for texels.
Pack read_pack(const std::filesystem::path& folder_or_json);

/// The same of a folder that is held open; within reading_pack().
Pack read_pack(const PackFolder& folder);

/// A part of it: map `map` alone, its levels from `first_level` (0..tile_levels-1) on; a finer level of it is empty. Other
/// maps and the corner pack are left out, and files that hold none of these levels are not opened.
Pack read_pack_levels(const PackFolder& folder, int map, int first_level);

/// The same without looking at any image.
PackDescription read_pack_description(const std::filesystem::path& folder_or_json);

} // namespace tilepack
