#pragma once

#include "tilepack/numeric/enum_names.h"

namespace tilepack {

/// How a pattern that is moved, turned and scaled in its cell keeps from being cut at the cell's border.
///   [LN03, figure 4]
enum class TransformFit {
  none,     ///< it fills the cell and isn't moved: for tiles that continue each other
  shrink,   ///< it stays inside: moved only as far as its size allows
  overflow, ///< it reaches into the neighbours, which look for it there
};

template <>
inline constexpr auto enum_names<TransformFit> =
    std::array{EnumName{TransformFit::none, "none"}, EnumName{TransformFit::shrink, "shrink"},
               EnumName{TransformFit::overflow, "overflow"}};

/// The place of a pattern in its cell. Unit: the cell; x east, y south.
struct TileTransform {
  double x = 0,
         y = 0;     ///< d: where between the ends, 0..1 (shrink); the centre's place in the cell (overflow)
  double scale = 1; ///< s, of a cell: the pattern's sides; above 0
  double cosine = 1, sine = 0; ///< of the angle it is turned by, clockwise on the screen

  /// A place of the cell (u, v), which may lie beyond it, as a place of the pattern: 0..1 inside it.
  struct Inside {
    double u = 0, v = 0;
    bool shown() const { return u >= 0 && v >= 0 && u < 1 && v < 1; } ///< else the fragment is discarded
  };

  /// [LN03]: u' = (u + (1 - s) d) / s with the sign of d turned (d = 1 is the east end here), turned about the centre.
  /// A turned square needs more room than an upright one: the box round it stays inside.
  Inside shrunk(double u, double v) const {
    return from_centre(u - (0.5 + (x - 0.5) * room()), v - (0.5 + (y - 0.5) * room()));
  }

  /// The centre lies at (x, y) of the cell, so the pattern may reach beyond the cell by up to half_box().
  Inside overflowed(double u, double v) const { return from_centre(u - x, v - y); }

  /// Turns it to `turns`, clockwise.
  void turn(double turns);

  /// Makes it no larger than fits into a cell, turned as it is.
  void shrink_to_fit() {
    const double largest = 1 / (absolute(cosine) + absolute(sine));
    if (scale > largest) scale = largest;
  }

  /// The same place as overflowed() understands it: of the centre.
  TileTransform centred_when_shrunk() const {
    TileTransform to = *this;
    to.x = 0.5 + (x - 0.5) * room();
    to.y = 0.5 + (y - 0.5) * room();
    return to;
  }
  /// Half the side of the upright box round it.
  double half_box() const { return 0.5 * scale * (absolute(cosine) + absolute(sine)); }

private:
  double room() const { return half_box() < 0.5 ? 1 - 2 * half_box() : 0; }
  static constexpr double absolute(double a) { return a < 0 ? -a : a; }
  Inside from_centre(double dx, double dy) const {
    return {(dx * cosine + dy * sine) / scale + 0.5, (dy * cosine - dx * sine) / scale + 0.5};
  }
};

} // namespace tilepack
