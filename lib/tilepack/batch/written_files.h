#pragma once

#include "tilepack/bake/output_check.h"
#include "tilepack/batch/manifest.h"

#include <cstddef>
#include <span>
#include <vector>

namespace tilepack {

/// Throws Error (usage) if one of `outputs`, which a batch writes beside those of its entries (a stamp, rules), would
/// replace the manifest, a preset, or what any entry reads or writes, lies in a pack of one, or ends as images do;
/// also by another spelling of the same path or through links.
void check_beside_entries(const Manifest& manifest, std::span<const OutputFile> outputs);

/// Throws Error (invalid_content), with the line of the manifest, if one of the entries `made`, by number, would
/// replace the manifest, a preset, what it reads itself or what another entry writes, or a file that another entry
/// reads and that no batch has made, or a file of a pack. Looks at what is on disk, so that links and other spellings count, and reads
/// nothing of it where outputs have been made by a batch or are not there yet.
void check_written_files(const Manifest& manifest, std::span<const std::size_t> made);

} // namespace tilepack
