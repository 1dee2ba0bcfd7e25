#pragma once

#include "tilepack/image/image.h"

#include <vector>

namespace tilepack {

/// How often each part of the sample is shown, so that a choice can favour parts not seen yet. Counted in
/// squares of a few texels.
class UseCounts {
public:
  UseCounts(int image_width, int image_height, int square_side = 1);

  /// From now on what is added to `area` counts `price` times: seeing it again is so much worse. To be called
  /// before anything is added.
  void set_reuse_weight(Rect area, int price);

  /// Counts `area` `weight` times more, which may be negative. Areas are rounded to whole squares of the
  /// image, the nearest one at least; the rest of what lies outside of it is left out, here and in mean().
  void add(Rect area, double weight);

  /// To be called between add() and the functions below, which tell the state of then.
  void prepare();

  /// The mean count over `area`, and over the whole image.
  double mean(Rect area) const;
  double mean() const;

private:
  struct Bounds {
    std::size_t first_x, first_y, last_x, last_y; // last: one past
  };
  Bounds bounds(Rect area) const;

  int square;
  int columns;
  int rows;
  std::vector<int> prices;   // none: 1 each
  std::vector<double> count; // with whole weights exact in any order
  std::vector<double> sums;  // summed areas
};

} // namespace tilepack
