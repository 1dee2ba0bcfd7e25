#pragma once

#include "tilepack/exemplar/period.h"
#include "tilepack/tileset/material_map.h"

#include <span>
#include <vector>

namespace tilepack {

/// What straightening did to a sample, and the sample as it is after it.
struct Straightened {
  std::vector<SampleMap> maps; ///< none: nothing was to be straightened
  Periodicity periods;         ///< of the maps: those of the axes that were straightened are exact
  double moved = 0;            ///< texels, the furthest that any course was moved
  double stretch_x = 1; ///< how much longer the sample has become along each axis, so that whole periods
  double stretch_y = 1; ///< make a side that tiles may have; 0.975..1.025

  bool done() const { return !maps.empty(); }
};

/// How large tiles may be, which decides to what length periods are brought.
struct TileSides {
  Size least;
  Size wanted;
  Size most;
};

/// Straightens a sample whose courses (planks, rows of tiles, lines of text) repeat unevenly: a smooth warp by which
/// courses come to lie exactly a period apart, as followed_courses() finds them. What changes is the distance between
/// courses, by 4 % at most, and the length of the whole, by 2.5 % at most, so that a tile's side of a whole number of
/// texels, which halves well, holds whole periods.
///
/// An axis is left alone where nothing repeats along it (`periods`); where courses lie even already, to within three
/// quarters of a texel in the mean, and a tile's side holds whole periods as they are, to 0.3 texels; or where the warped
/// sample does not repeat more clearly than before (as clearly, if only the length was to fit). All maps
/// are warped alike, by a bicubic filter, and rounded to their depth; normals are turned as the warped surface is, with
/// green taken to point north, as in OpenGL. What would show nothing of the sample, a few texels along its borders, is
/// cut off.
///
/// Deterministic for any number of threads.
Straightened straightened(std::span<const SampleMap> samples, const Periodicity& periods,
                          const TileSides& sides);

} // namespace tilepack
