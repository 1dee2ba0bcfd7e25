#pragma once

#include "tilepack/pack/pack.h"

#include <filesystem>

namespace tilepack {

/// Writes pack.json and the images into `folder`, which is made if missing.
///
/// All or nothing: everything is first written under temporary names, and put in place only when complete. A
/// folder that already holds a tile pack has that pack replaced (files that are not the pack's stay as they
/// are); a folder that holds anything else is refused. Throws Error (cannot_write). The same pack gives the
/// same bytes.
void write_pack(const Pack& pack, const std::filesystem::path& folder);

} // namespace tilepack
