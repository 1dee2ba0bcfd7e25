#pragma once

#include "tilepack/mapping/mapping.h"

#include <string>

namespace tilepack {

/// An index map as JSON for engines that don't load it as an image:
///
///   { "virtual_size": [width, height], "tiles": [[id, …], …] }     one row of cells a line, from the north
///
/// Error (usage) for other mappings, and for maps of more than 2^20 cells.
std::string index_map_json(const Mapping& mapping);

} // namespace tilepack
