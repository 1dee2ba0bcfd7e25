#pragma once

#include "tilepack/tileset/material_map.h"

#include <span>
#include <string>

namespace tilepack {

/// The dominant repeat of a sample along one axis.
struct Period {
  double length = 0;   ///< texels, 0 if none stands out
  double strength = 0; ///< 0..1: half the difference of agreement between whole periods and halves
  bool exact = false;  ///< texel by texel, in all maps; with length 0: the same all along the axis
  double waver = 1; ///< texels, root mean square, by which courses lie off even places; 1 where not measured
  double lines =
      0; ///< texels of the whole sample along the axis if it is nothing but lines across it, without a
         ///< repeat: whatever lies side by side must show the same ones. Else 0
};

/// Texels of Period::waver from which on courses count as uneven.
constexpr double least_waver = 0.75;

/// How often a side can be halved.
int halvings(int side);

/// Repeats along both axes: brick courses, planks, roof tiles, woven threads, lines of text.
struct Periodicity {
  Period x; ///< of columns: the sample moved east
  Period y; ///< of rows: the sample moved south
};

/// Finds the repeats of the first map (usually the color) by normalised autocorrelation along each axis,
/// scored by a comb: the mean agreement at lags p, 2p, 3p … less that at p/2, 3p/2 …, so that neither a
/// multiple nor a fraction of the true period wins. At least two periods must fit into half the sample. Looks
/// at brightness and hue, low frequencies taken out. Of a staggered lattice, such as bricks laid by half, the
/// periods are a brick and two courses, unless bricks differ so much that it is not told from a grid. Courses that
/// lie a little unevenly, as planks do, are found in a second look, at the sample blurred along the axis.
///
/// Where all maps repeat texel by texel (exemplar/exact_repeat.h), that is the period, however short.
///
/// Integer arithmetic up to the final ratios: the same on every machine. Samples under 32 texels a side have
/// no period.
Periodicity detect_periods(std::span<const SampleMap> samples);

/// How many whole periods a tile's side of `side` texels holds, to within 0.75 texels or 2 % of the period; 0
/// if the number is not whole, or there is no period.
int whole_periods(const Period& period, int side);

/// What tile size fits a sample, and why.
struct TileSizeAdvice {
  Size size;          ///< each side a whole number of periods where there is one, rounded to whole texels
  Size periods;       ///< how many periods a side holds; 0 along an axis without one
  std::string reason; ///< one sentence for a report
};

/// The tile size near `wanted` whose sides hold whole periods, for `--tile-size auto`: structures then meet
/// across tile borders without a step. Sides stay within half to twice the wanted ones and within half the
/// sample, and along an axis without a period the wanted side is kept (at most half the sample). Among
/// multiples of the period, the one that is nearest to a whole number of texels and to `wanted`, and that
/// halves most often, wins.
TileSizeAdvice fitting_tile_size(const Periodicity& periodicity, Size wanted, Size sample);

} // namespace tilepack
