#include "tilepack/sampler/footprint.h"

#include "tilepack/numeric/exact_math.h"

#include <algorithm>

namespace tilepack {
namespace {

double defined(double derivative) {
  constexpr double most = 0x1p40;
  return std::isnan(derivative) ? 0.0 : std::clamp(derivative, -most, most);
}

} // namespace

FootprintEllipse ellipse_of(const Footprint& footprint, Size tile) {
  // J = (ux uy; vx vy); J Jᵀ = (a b; b c) has the squares of the half axes as eigenvalues.
  const double ux = defined(footprint.u_across) * tile.width, uy = defined(footprint.u_down) * tile.width;
  const double vx = defined(footprint.v_across) * tile.height, vy = defined(footprint.v_down) * tile.height;
  const double a = ux * ux + uy * uy, b = ux * vx + uy * vy, c = vx * vx + vy * vy;
  const double half = 0.5 * (a - c);
  const double spread = std::sqrt(half * half + b * b);
  FootprintEllipse ellipse;
  ellipse.major = std::sqrt(0.5 * (a + c) + spread);
  if (!(ellipse.major > 0)) return ellipse;
  // The product of the eigenvalues is det², which keeps the small one's digits.
  ellipse.minor =
      std::clamp(std::fabs(ux * vy - uy * vx) / ellipse.major, ellipse.major / max_anisotropy, ellipse.major);
  // The eigenvector of the larger eigenvalue, from whichever row of the matrix is the longer.
  const double x = half >= 0 ? half + spread : b, y = half >= 0 ? b : spread - half;
  const double length = std::sqrt(x * x + y * y);
  if (length > 0) {
    ellipse.x = x / length;
    ellipse.y = y / length;
  }
  return ellipse;
}

double level_of(const FootprintEllipse& ellipse) {
  return ellipse.minor > 1 ? exact_log2(ellipse.minor) : 0.0;
}

EllipseTexels::EllipseTexels(const FootprintEllipse& ellipse, int level) {
  const auto in_level = [&](double half_axis) {
    return std::clamp(std::ldexp(half_axis, -level), 1.0, longest_half_axis);
  };
  const double major = in_level(ellipse.major);
  const double minor = in_level(ellipse.minor);
  major_x = ellipse.x / major;
  major_y = ellipse.y / major;
  minor_x = ellipse.x / minor;
  minor_y = ellipse.y / minor;
  const auto reach = [&](double along, double across) {
    return std::sqrt(along * along * major * major + across * across * minor * minor);
  };
  reach_x = reach(ellipse.x, ellipse.y);
  reach_y = reach(ellipse.y, ellipse.x);
}

} // namespace tilepack
