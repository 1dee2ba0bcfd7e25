#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/pack/pack.h"
#include "tilepack/pack/staged_outputs.h"

#include <filesystem>
#include <string>

namespace tilepack {

/// Writes pack.json and the images into `folder`, which is made if missing.
///
/// All or nothing, even if the process is killed: every file is first written to a staging folder, which
/// takes the place of `folder` in one step where possible (StagedFolder says where not). A folder that
/// already holds a tile pack has that pack replaced: its files that no longer belong go, files that are not
/// the pack's stay as they are. A folder that holds something else, or a pack.json that can't be read as a
/// tile pack, is refused. If anything fails, or `progress` throws, the folder is as it was. Throws Error
/// (cannot_write). The same pack gives the same bytes.
void write_pack(const Pack& pack, const std::filesystem::path& folder, const Progress& progress = {});

/// The same without the last step: the pack waits in `outputs`, to be put in place with what else a command
/// writes.
void stage_pack(StagedOutputs& outputs, const Pack& pack, const std::filesystem::path& folder,
                const Progress& progress = {});

/// Throws what write_pack would throw about the folder itself, before any work is done for it: other files
/// in it, a lock, a lack of permission. Leaves no trace.
void check_pack_folder(const std::filesystem::path& folder);

/// A sentence for the user if the pack in `folder` can't be replaced in one step; empty if it can, or if there is
/// none.
std::string replacing_note(const std::filesystem::path& folder);

/// The folder of the pack in which `folder` would lie, however deep; empty if in none. A pack in a pack would
/// be files of another there.
std::filesystem::path pack_around(const std::filesystem::path& folder);

} // namespace tilepack
