#pragma once

#include "tilepack/batch/manifest.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tilepack {

/// The entries of a manifest, by number, that are asked for: those whose name is one of `only` or matches one as a
/// pattern (all if there is none), of the part `shard` ("2/5": the second of five; empty: all of them).
///
/// Which part an entry is in hangs on the name of its output as written alone, or, of what is made from another
/// entry, on that of the first it is made from; so adding entries moves none. Throws Error (usage) for a name that
/// matches nothing and a part that can't be.
std::vector<std::size_t> chosen_entries(const Manifest& manifest, std::span<const std::string> only,
                                        const std::string& shard);

/// The file that stands for an output in rules of build systems: the file itself, or the pack.json of a pack.
std::string target_of(const BatchEntry& entry);

} // namespace tilepack
