#pragma once

#include "tilepack/pack/pack_json.h"

#include <cstdint>

namespace tilepack {

/// Uncompressed bytes of all levels of all maps, corner pack counted; the index map isn't.
std::uint64_t bytes_in_memory(const Pack& pack, const PackDescription& description);

/// Uncompressed bytes of a texture of the virtual size with the same maps and levels. May exceed 2^64: a
/// double.
double bytes_stored_whole(const Pack& pack);

} // namespace tilepack
