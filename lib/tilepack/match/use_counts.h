#pragma once

#include "tilepack/image/image.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tilepack {

/// The squares in which uses of an image are counted; those cut off at its end count like whole ones.
struct UseSquares {
  int side = 1;    ///< texels
  int columns = 0; ///< squares in a row
  int rows = 0;

  struct Bounds {
    std::size_t first_x, first_y, last_x, last_y; ///< last: one past
  };
  /// Whole squares: those of which `area` holds half or more along both axes, one at least; what lies outside
  /// of the image is left out.
  Bounds bounds(Rect area) const;
};

class UseTable;

/// Counts how often each part of the sample is shown, so that a choice can favour parts not seen yet. To be
/// asked, they are prepared: see UseTable.
class UseCounts {
public:
  /// Counts in squares of `square_side` texels a side, all of them 0.
  UseCounts(int image_width, int image_height, int square_side = 1);

  /// From now on what is added to `area` counts `weight` times, 1 or more: showing it again is so many times
  /// as bad. A reuse weight only acts on what is added after it, so set all of them first.
  void set_reuse_weight(Rect area, int weight);

  /// Counts `area` `weight` times more, which may be negative; see UseSquares::bounds for the rounding.
  void add(Rect area, double weight);

  /// Counts the square that holds (x, y) once more, or the last one.
  void add_texel(int x, int y) {
    const auto i = static_cast<std::size_t>(std::min(x / squares.side, squares.columns - 1));
    const auto j = static_cast<std::size_t>(std::min(y / squares.side, squares.rows - 1));
    const std::size_t n = j * static_cast<std::size_t>(squares.columns) + i;
    counts[n] += reuse_weights.empty() ? 1 : reuse_weights[n];
  }

private:
  friend UseTable prepared(const UseCounts& counts);

  UseSquares squares;
  std::vector<int> reuse_weights; // none: 1 each
  std::vector<double> counts;     // with whole weights exact in any order
};

/// The state of UseCounts at one moment, as summed areas: the mean count over any rectangle in constant time.
class UseTable {
public:
  /// The mean count a texel over `area` (UseSquares::bounds), and over the whole image.
  double mean(Rect area) const;
  double mean() const;

private:
  friend UseTable prepared(const UseCounts& counts);
  explicit UseTable(const UseSquares& counted) : squares(counted) {}

  UseSquares squares;
  std::vector<double> sums; // (columns + 1) × (rows + 1)
};

UseTable prepared(const UseCounts& counts);

} // namespace tilepack
