#pragma once

#include "tilepack/layout/layout.h"
#include "tilepack/tileset/tile_set.h"

#include <string_view>
#include <vector>

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

std::string_view name_of(MipMode mode); ///< "none", "box", "edges", "corners", "least-squares"

struct MipOptions {
  MipMode mode = MipMode::edges;
  int jump_weight = 4; ///< least_squares: cost of a jump across a border against that of an error, 0..1000
  bool roughness_from_normals = true; ///< roughness takes up the spread of normals that a level averages
  int alpha_coverage = 0; ///< keep the share of texels whose alpha reaches this many percent; 0: don't
};

/// Number of levels of a tile, level 0 counted: halved as long as both sides are even; a 128² tile has 8
/// (down to one texel), a 96 × 64 tile 6 (down to 3 × 2).
int level_count(Size tile_size);

/// The size of a tile at `level`: each side divided by 2^level.
Size level_size(Size tile_size, int level);

/// Whether `level` needs no sanitizing under a guard band of `guard` texels: level 0, and those with
/// 2^level <= guard. There the border texels of width guard >> level are boxes of guarded texels alone, hence
/// equal in all tiles of a color by themselves, and what bilinear filtering reads across a border is exact.
bool exact_through_guard(int guard, int level);

/// The levels of map number `map` of `set`, level 0 (as it is) first, each a TileMap of smaller tiles.
///
/// Each level is a 2 × 2 box of the finer one *before* sanitizing and within one tile: of linear light
/// weighted by alpha for Role::color, of vectors for normals (3 or 4 channels: the first three are the
/// vector, renormalised), of the values as they are for the rest. Roughness then takes up what the set's
/// first normal map loses (mip/normal_variance.h). Levels past the guard band are then
/// sanitized as `options` says (mip/shared_border.h tells what becomes equal). The values returned are
/// encoded as level 0 is, and not yet rounded; texels made equal are equal in every bit. The result does not
/// depend on the number of threads.
std::vector<TileMap> mip_chain(const TileSet& set, int map, const MipOptions& options,
                               const Layout* layout = nullptr);

/// The same without level 0, which saves copying it.
std::vector<TileMap> coarser_levels(const TileSet& set, int map, const MipOptions& options,
                                    const Layout* layout = nullptr);

} // namespace tilepack
