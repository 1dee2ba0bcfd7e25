#pragma once

#include "tilepack/batch/batch_entry.h"

#include <string>
#include <vector>

namespace tilepack::cli {

/// The words of the command line that an entry stands for, the verb first, in one order for all. How many threads
/// it takes is left out.
std::vector<std::string> command_of(const BatchEntry& entry);

} // namespace tilepack::cli
