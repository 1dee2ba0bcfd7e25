#pragma once

#include "tilepack/batch/batch_run.h"
#include "tilepack/error/progress.h"

namespace tilepack::cli {

/// Throws Error (invalid_content), with its place in the manifest, where the command line would refuse the options of
/// an entry as they are written. Of bakes, state_of() does.
void check_entry_words(const Manifest& manifest, const BatchEntry& entry);

/// Makes the output of one entry of a manifest, all or nothing: a bake as data, with its page if one is asked for,
/// any other verb as the command line would, what it prints going to the output if that is its output; tells what
/// it noted, and the verdict on a bake. Throws Error, and what `progress` throws.
EntryStory make_entry(const Manifest& manifest, const BatchEntry& entry, const Progress& progress);

} // namespace tilepack::cli
