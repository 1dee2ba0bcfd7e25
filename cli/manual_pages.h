#pragma once

#include "verb.h"

#include <string>

namespace tilepack::cli {

/// Manual pages in the man macros of troff, from what verbs declare of themselves: `tilepack-bake.1`, and
/// `tilepack.1` with the list of all. The same text for the same program.
std::string manual_of(const Verb& verb);
std::string manual_of_all();

/// What a verb's command line takes, --help and --quiet too.
std::vector<OptionText> options_of(const Verb& verb);

} // namespace tilepack::cli
