#pragma once

#include "tilepack/batch/manifest.h"
#include "tilepack/error/progress.h"

namespace tilepack::cli {

/// Makes the output of one entry of a manifest, all or nothing: a bake as data, with its page if one is asked for,
/// any other verb as the command line would, what it prints going to the output if that is its output. Throws
/// Error, and what `progress` throws.
void make_entry(const Manifest& manifest, const BatchEntry& entry, const Progress& progress);

} // namespace tilepack::cli
