#pragma once

#include "tilepack/layout/layout_search.h"
#include "tilepack/layout/place_tiles.h"
#include "tilepack/pack/pack.h"

#include <vector>

namespace tilepack {

/// What storing `finest`, the tiles of level 0 of a map, turned as `layout` says costs: one entry a filter,
/// in the order of ResampleFilter. Each texture is rounded to the map's depth and read back by
/// tiles_at_level. A layout that copies its tiles loses nothing.
std::vector<RoundTrip> round_trips(const TileMap& finest, const TileColors& tiles, const Layout& layout,
                                   Size tile_size, Outside outside = Outside::neighbours);

/// The same for tiles that don't exist yet: windows of `sample` spread over it, as many as the plan has
/// tiles, nothing read beyond a window. Throws Error (invalid_content) if the sample is smaller than a tile.
std::vector<RoundTrip> round_trips(const SampleMap& sample, const LayoutCandidate& plan, int tile_side);

} // namespace tilepack
