#pragma once

#include "tilepack/exemplar/courses.h"
#include "tilepack/tileset/material_map.h"

#include <optional>

namespace tilepack {

/// Courses that lie evenly: planks, rows of a wall.
struct EvenCourses {
  CourseAxis axis = CourseAxis::y; ///< along which they follow one another
  double period = 0;               ///< texels
  double joint = 0;                ///< texels: where one of them ends and the next begins
};

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
/// With `courses` each of them is evened out by itself: what is slow is then the mean of a quarter of the way across a course,
/// over what all courses show on average at these places, and along it of a box of a third of the tile's side (three
/// times over).
/// The change from one course to the next lies in the joint. Boards of many tones become boards of one, so that any
/// of them can go on in any other; knots, grain and joints stay.
///
/// `share` is 0..1; 0 returns the map as it came. The result has the depth asked for, or the map's: integers
/// are clamped to 0..1 and rounded, f16 is clamped to ±65504, f32 has no bounds. Values must be finite.
///
/// Deterministic for any number of threads. Time grows with the number of texels alone, whatever the tile.
SampleMap flattened(SampleMap map, double share, Size tile, std::optional<Depth> depth = {},
                    const std::optional<EvenCourses>& courses = {});

} // namespace tilepack
