#pragma once

#include "tilepack/numeric/enum_names.h"

#include <string_view>

namespace tilepack {

/// What is done to the border texels of coarser levels, where tiles of one edge color no longer agree.
/// [Gems2, 12.5]
enum class MipMode {
  none,    ///< level 0 only
  box,     ///< nothing
  edges,   ///< border texels averaged over all tiles that share the edge color, corner texels left alone
  corners, ///< the four corner texels too: over all tiles for edge coloring, per color for corner coloring
  least_squares, ///< border texels that minimise the expected error over random neighbours, traded against
                 ///< the jump at borders; see mip/least_squares.h
};

template <>
inline constexpr auto enum_names<MipMode> =
    std::array{EnumName{MipMode::none, "none"}, EnumName{MipMode::box, "box"},
               EnumName{MipMode::edges, "edges"}, EnumName{MipMode::corners, "corners"},
               EnumName{MipMode::least_squares, "least-squares"}};

struct MipOptions {
  MipMode mode = MipMode::least_squares; ///< the least error and jump together, by ERRORS.md
  int jump_weight = 4; ///< least_squares: cost of a jump across a border against that of an error, 0..1000
  bool roughness_from_normals = true; ///< roughness takes up the spread of normals that a level averages
  int alpha_coverage = 0; ///< keep the share of texels whose alpha reaches this many percent; 0: don't
};

} // namespace tilepack
