#pragma once

#include "tilepack/image/image.h"

#include <cmath>

namespace tilepack {

/// How texture coordinates change from pixel to pixel, tiles a pixel: what shaders call derivatives, and give
/// explicitly where tiles are looked up, since those of the place in the pack jump from tile to tile.
struct Footprint {
  double u_across = 0, v_across = 0; ///< to the right
  double u_down = 0, v_down = 0;     ///< to the next row
};

/// The ratio of the half axes up to which an ellipse keeps its shape. Longer ones are made wider, which blurs
/// but never flickers.
inline constexpr int max_anisotropy = 64;

/// No half axis is longer than this many texels of the level read: what an ellipse of the largest ratio needs
/// between two levels, and where the coarsest level must do for everything larger.
inline constexpr double longest_half_axis = 2.0 * max_anisotropy;

/// What a pixel covers: the ellipse that a footprint makes of a circle of radius 1 pixel. [Heckbert89]
struct FootprintEllipse {
  double major = 0; ///< longer half axis, texels of level 0
  double minor = 0; ///< shorter one, at least major / max_anisotropy
  double x = 1;     ///< direction of the longer one, of length 1
  double y = 0;
};

/// Half axes are the singular values of the footprint in texels of level 0 (`tile` texels a tile). Defined
/// for every input: derivatives that are NaN count as 0, larger ones than 2^40 tiles as 2^40.
FootprintEllipse ellipse_of(const Footprint& footprint, Size tile);

/// The level whose texels are as large as the shorter half axis; 0 where it is below a texel.
double level_of(const FootprintEllipse& ellipse);

/// The texels of one level round a place, weighed by (1 - r²)² with r the distance from the place, 1 on the
/// ellipse: a bell that ends smoothly. Both half axes are brought to 1..longest_half_axis texels of the
/// level, so there is always a texel within: a footprint of 0 is a circle of radius 1 texel, which gives a
/// texel itself at its centre.
class EllipseTexels {
public:
  EllipseTexels(const FootprintEllipse& ellipse, int level);

  /// f(i, j, weight) for each texel with weight above 0, row by row. (x, y): the place, in texels; texel
  /// (i, j) has its centre at (i + 0.5, j + 0.5). Weights don't add up to 1.
  template <typename F>
  void each(double x, double y, F&& f) const {
    const auto first = [](double centre, double reach) {
      return static_cast<int>(std::ceil(centre - reach - 0.5));
    };
    const auto last = [](double centre, double reach) {
      return static_cast<int>(std::floor(centre + reach - 0.5));
    };
    for (int j = first(y, reach_y); j <= last(y, reach_y); ++j)
      for (int i = first(x, reach_x); i <= last(x, reach_x); ++i) {
        const double dx = i + 0.5 - x;
        const double dy = j + 0.5 - y;
        const double along = (dx * major_x + dy * major_y);
        const double across = (dy * minor_x - dx * minor_y);
        const double rest = 1.0 - (along * along + across * across);
        if (rest > 0.0) f(i, j, rest * rest);
      }
  }

private:
  double major_x, major_y; // the direction of the longer half axis over its length
  double minor_x, minor_y; // the same direction over the length of the shorter one
  double reach_x, reach_y; // half sides of the box round the ellipse
};

} // namespace tilepack
