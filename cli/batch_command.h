#pragma once

#include "options.h"

#include "tilepack/batch/manifest.h"
#include "tilepack/error/error.h"

#include <string>
#include <vector>

namespace tilepack::cli {

/// The words of the command line that an entry stands for, the verb first, in one order for all. How many threads
/// it takes is left out.
std::vector<std::string> command_of(const BatchEntry& entry);

/// Throws Error (invalid_content), with line and name, for an option of an entry that its verb, which declared
/// `known`, doesn't have, or that is a flag where a value is needed, or the other way round.
void check_option_names(const Manifest& manifest, const BatchEntry& entry, const Options& known);

/// What the verb of an entry said of its words, as the manifest has them: the line of the option that is to blame, or
/// of the entry, and options by their names in quotes.
Error in_manifest(const Manifest& manifest, const BatchEntry& entry, const Options& known,
                  const Error& error);

} // namespace tilepack::cli
