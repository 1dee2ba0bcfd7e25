#pragma once

#include "tilepack/image/stored_format.h"
#include "tilepack/tileset/material_map.h"

#include <optional>

namespace tilepack {

/// What is asked of how a map is stored; what is unset follows from the map.
struct StorageRequest {
  std::optional<ImageContainer> container;
  std::optional<Depth> depth;
};

/// Who will read the file.
enum class StoredFor {
  pack, ///< a reader of pack.json, which states the encoding; half precision is enough for what was integers
  picture ///< anybody, who takes the file at its word (EXR is linear); no code of an integer map is lost
};

/// How a map of `role` that has `encoding` and `depth` is stored, as near to what it is as the request lets it.
///
///   asked for        map has   stored depth
///   a depth          any       that depth, in the container asked for or the usual one
///   PNG              u8, u16   as it is
///   PNG              floats    u16
///   EXR              floats    as it is
///   EXR, pack        u8, u16   f16
///   EXR, picture     u8        f16
///   EXR, picture     u16       f32
///
/// The encoding stays, but for color that changes between integers and floats: it becomes linear in floats,
/// sRGB in integers. In an EXR picture everything is linear, and alpha
/// associated.
StoredFormat stored_format_for(Role role, Encoding encoding, Depth depth, const StorageRequest& request,
                               StoredFor reader);

} // namespace tilepack
