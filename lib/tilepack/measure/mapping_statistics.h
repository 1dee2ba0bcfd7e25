#pragma once

#include "tilepack/image/image.h"
#include "tilepack/mapping/mapping.h"

#include <string>
#include <vector>

namespace tilepack {

/// Two places of equal content in a row or column, and how long they stay equal.
struct RepeatedRun {
  int length = 0;         ///< cells
  double by_chance = 0;   ///< about what independent fair colors give
  std::int64_t x[2] = {}; ///< where the two runs begin (south along a column, east along a row)
  std::int64_t y[2] = {};
};

/// How often cells some lags apart in one direction are equal, over all lags looked at.
struct PairCorrelation {
  int lag = 0;         ///< cells: where the share of equal pairs is furthest from expected
  double equal = 0;    ///< share of equal pairs there
  double expected = 0; ///< 1 / number of values
  double sigmas = 0;   ///< the difference in standard deviations of independent pairs; with some hundred lags
                       ///< looked at, 3 to 4 is chance
};

/// One family of values over a window of cells: the tiles, their variants, or the colors of the horizontal edges,
/// the vertical edges or the corners they are made of.
struct FamilyStatistics {
  std::string name;                  ///< "tiles", "variants", "horizontal edges", "vertical edges", "corners"
  std::vector<std::int64_t> counts;  ///< of each value
  double chi_square = 0;             ///< of the counts against equal ones
  int degrees = 0;                   ///< of freedom: the values less one
  double chi_square_sigmas = 0;      ///< as a deviation of the normal distribution (Wilson and Hilferty)
  PairCorrelation along_rows;        ///< cells (x, y) and (x + lag, y)
  PairCorrelation along_columns;     ///< (x, y) and (x, y + lag)
  PairCorrelation along_diagonals;   ///< (x, y) and (x + lag, y + lag)
  PairCorrelation against_diagonals; ///< (x, y) and (x + lag, y - lag)
  RepeatedRun longest_in_rows;       ///< the longest run along a row that occurs at two places
  RepeatedRun longest_in_columns;    ///< the same along columns: P[P[x] + y] makes columns shifted copies
  int row_period = 0;                ///< the least lag under which all rows repeat; 0: none within the window
  int column_period = 0;             ///< the same for columns: a table of even length n repeats V at n / 2
};

/// Statistics of a mapping over the window of cells (0, 0) to `window`.
struct MappingStatistics {
  VirtualSize window;
  std::vector<FamilyStatistics> families; ///< tiles first; of an index mapping nothing else

  /// Sentences that name each fault found: repeats, runs twice as long as chance makes them, counts or pairs
  /// over 6 standard deviations off. Of the mapping "even" only what goes beyond its purpose: pairs of
  /// tiles equal half again as often as by chance, and runs longer than a block. Empty: the mapping shows no
  /// pattern here.
  std::vector<std::string> faults;
};

/// Looks at the virtual texture's north-west corner, up to `largest_window` cells a side (8..1024), and at
/// lags up to half of it. Texel-exact: no randomness.
MappingStatistics mapping_statistics(const Mapping& mapping, const ColorCounts& colors,
                                     int largest_window = 256);

/// A picture of the window's north-west corner as [Wei04, Fig. 3]: one texel a cell, each tile its own color,
/// side × side texels (fewer if the virtual texture is smaller), linear-light values not meant: encoded as
/// is.
Image mapping_picture(const Mapping& mapping, const ColorCounts& colors, int side);

/// The mapping of the paper with a shuffled table of `length` entries, whatever the size asks for: for
/// comparing table sizes. length 1..limits::longest_table.
Mapping permutation_mapping_of_length(VirtualSize size, int length, std::uint64_t seed);

} // namespace tilepack
