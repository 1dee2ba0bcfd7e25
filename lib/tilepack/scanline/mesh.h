#pragma once

#include "tilepack/scanline/screen_map.h"

#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// Triangles from the text of a Wavefront OBJ file: `v`, `vt` and `f` lines; polygons are cut into fans, and
/// negative indices count from the end. Other lines (normals, groups, materials) are passed over. The file's
/// (0, 0) is the south-west corner of its texture, ours the north-west: v is negated, which is the same up to
/// whole tiles.
///
/// `tiles_a_unit`: tiles a unit of texture coordinate covers. `name` stands in messages. Throws Error
/// (invalid_content, "NAME:LINE") for numbers that are missing, malformed, not finite or beyond ±1e9, faces
/// with fewer than three corners or corners without a texture coordinate, indices out of range, and a text
/// without a face.
std::vector<TexturedTriangle> parse_obj(std::string_view text, const std::string& name, double tiles_a_unit);

} // namespace tilepack
