#pragma once

#include "tilepack/check/issues.h"
#include "tilepack/pack/pack.h"

#include <vector>

namespace tilepack {

/// The checks on a pack in memory, each listing all it finds. They hold for any pack, however broken: a level
/// that is absent or has the wrong size, a tile id or a color out of range is reported once, by the check it
/// belongs to, and left out by the others.

/// Colors within their counts, each combination once where a hash chooses the tile.
std::vector<Issue> check_tiles(const Pack& pack);

/// Every tile in the grid once, and neighbours of the wrapping texture agreeing in the color between them.
std::vector<Issue> check_layout(const Pack& pack);

/// Hash table, index map and virtual size.
std::vector<Issue> check_mapping(const Pack& pack);

/// As many levels as announced, each the size of the grid times the tile's.
std::vector<Issue> check_levels(const Pack& pack);

/// Values finite and storable; the texels that tiles must share, shared:
///   level 0        the guard band of each edge, `guard` texels deep (outermost row: TP403; deeper: TP404);
///   without a
///                  guard the outermost row but for its corners: an error (TP403) if coarser levels are
///                  sanitized, since that takes level 0 for legal, else a warning (TP407)
///   coarser        floor(guard / 2^level) texels of it, since a box of equal texels is equal
///   past the guard what the mip mode promises (mip/shared_border.h): TP405, TP406
/// With colored edges the squares where two bands cross are free; with colored corners they are shared too.
std::vector<Issue> check_texels(const Pack& pack);

/// Texture arrays: round each layer's tile the texels that place_tiles puts there.
std::vector<Issue> check_layer_borders(const Pack& pack);

/// Coarser levels made from finer ones: a warning where a tile's inside is not the boxes of the level above
/// it, as when one level was painted over and the others were not built again. Maps of 1 or 3 channels that
/// are averaged as they are: color, height, data. Turned tiles are read back first, which blurs them, so only
/// differences beyond the steps between a tile's own texels count.
std::vector<Issue> check_chain(const Pack& pack);

/// Mips fitted by least squares (mip/least_squares.h), which promise no equal texels: the outermost ring of each
/// level against what the same fit of level 0 gives (TP409). Maps of plain boxes (check/level_view.h). Layouts that turn no tile; packs that hold the weight of the fit and
/// have no fault of tiles or layout.
std::vector<Issue> check_fitted_borders(const Pack& pack);

/// All of these, in this order.
std::vector<Issue> check_structure(const Pack& pack);

} // namespace tilepack
