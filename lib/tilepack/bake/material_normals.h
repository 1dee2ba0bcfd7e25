#pragma once

#include "tilepack/tileset/material_map.h"

#include <optional>
#include <string>
#include <vector>

namespace tilepack {

/// Brings a normal map into the one form that is averaged, three components n as n * 0.5 + 0.5, perhaps with a
/// fourth channel beside them, rounded to its depth:
///
///   two channels                         x and y; z = √(1 - x² - y²) is added
///   three, blue constant though red and green aren't     blue holds no z, which is put there
///   four, red and blue constant          x in alpha and y in green, as DXT5nm has them: put in their places
///   components of -1 to 1 (floats)       brought to 0..1
///
/// Returns a sentence about what was done, one each; none if nothing was. Throws Error (invalid_content): one
/// channel, or components beyond -1 to 1. `map.file` is how messages name the file.
std::vector<std::string> complete_normals(SampleMap& map);

/// How the vectors of a normal map lie, as mean over the map.
struct NormalFigures {
  double tilt = 0; ///< of the mean vector from straight up, degrees
  double east = 0; ///< the mean vector's first two components
  double green = 0;
  double length = 1; ///< mean length
  double off = 0;    ///< mean difference of lengths from 1
};
NormalFigures normal_figures(const Image& normals);

/// A sentence each: the mean leans by more than 3°, lengths are off by more than .1 in the mean.
std::vector<std::string> doubts_about_normals(const Image& normals);

/// What tells which way green points.
struct GreenEvidence {
  NormalY y;
  bool from_heights = false; ///< else from the normals alone
};

/// Which way green points in a normal map, from the slopes it stands for.
///
///   with heights   of the same size: the slopes must be the heights' own. Whether those to the east agree or are
///                  all opposite tells first whether high is white or black
///   without        or where heights tell nothing: slopes of a surface h are its derivatives, so ∂/∂y of the x
///                  slope is ∂/∂x of the y slope (the field has no curl); with green taken the wrong way one is
///                  minus the other
///
/// None where neither is clear, as in a flat map. `heights` may be null. Rows of large maps are sampled.
std::optional<GreenEvidence> green_evidence(const Image& normals, const Image* heights);

/// Turns green the other way, and `normal_y` with it, if it is known.
void flip_green(SampleMap& map);

} // namespace tilepack
