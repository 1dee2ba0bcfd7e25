#pragma once

#include "tilepack/tileset/material_map.h"

#include <optional>

namespace tilepack {

/// The map with its slow shading taken out: uneven light, or a tone that drifts across the sample, whose dark
/// places would show as dark tiles.
///
/// Slow is what a mean over the surroundings keeps: a box of half the smaller side of `tile` (an odd number
/// of texels), three times over, which is a bell curve with a standard deviation of a quarter of that side.
/// Of a wave half a tile long nothing is taken out, of one tile 24 %, of two 71 %, of four 91 %.
///
///   color    every channel, in linear light, times 1 + share · (level / local - 1): local is the mean round
///            the texel, weighted by alpha where there is one, and at least a quarter of the channel's mean,
///            so that what is nearly black stays dark; level is chosen so that the mean stays
///   height   plus share · (level - local)
///   others   as they are: a normal has no part that is light, and roughness or a mask holds for its texel
///            whatever lies round it
///
/// `share` is 0..1; 0 returns the map as it came. The result has the depth asked for, or the map's: integers
/// are clamped to 0..1 and rounded, f16 is clamped to ±65504, f32 has no bounds. Values must be finite.
///
/// Deterministic for any number of threads. Time grows with the number of texels alone, whatever the tile.
SampleMap flattened(SampleMap map, double share, Size tile, std::optional<Depth> depth = {});

} // namespace tilepack
