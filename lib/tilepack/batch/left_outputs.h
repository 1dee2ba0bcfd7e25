#pragma once

#include "tilepack/batch/manifest.h"

#include <string>
#include <vector>

namespace tilepack {

/// Outputs of earlier runs that lie beside those of the manifest and that none of its entries makes any more, as when a
/// sample that a pattern matched was deleted: packs and files with a side file (build_record.h), in the folders that
/// outputs of entries lie in. Sorted. What another manifest makes in these folders is among them, for nothing tells whose
/// a side file is. Folders that can't be read count as empty.
std::vector<std::string> left_outputs(const Manifest& manifest);

} // namespace tilepack
