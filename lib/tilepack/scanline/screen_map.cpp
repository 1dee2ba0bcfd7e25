#include "tilepack/scanline/screen_map.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

// Below this share of the product of its rows' lengths a determinant counts as 0: a few thousand roundings.
constexpr double flat = 1e-13;

bool finite(const ScreenMap& map) {
  for (const ScreenLinear& f : {map.u, map.v, map.w}) {
    if (!std::isfinite(f.x) || !std::isfinite(f.y) || !std::isfinite(f.one)) return false;
  }
  return true;
}

double length(Vec3 v) {
  return std::sqrt(dot(v, v));
}

// How `direction` of the view ray depends on the screen place.
ScreenLinear along(Vec3 direction, const Projection& p) {
  return {dot(direction, p.across), dot(direction, p.down), dot(direction, p.corner)};
}

TileCoordinate whole_and_rest(double tiles) {
  return normalised({0, tiles});
}

} // namespace

std::optional<ScreenMap> screen_map(const TexturedPlane& plane, const Projection& projection) {
  // A ray eye + t r meets the plane at t = -height / (normal r), and there u = dual_u (eye - origin + t r):
  // with w = 1/t that is u_of_eye + (dual_u r)/w.
  const Vec3 normal = cross(plane.u_axis, plane.v_axis);
  const double area = length(normal);
  if (!(area > flat * length(plane.u_axis) * length(plane.v_axis))) return {};
  const double square = dot(normal, normal);
  const Vec3 dual_u = (1 / square) * cross(plane.v_axis, normal);
  const Vec3 dual_v = (1 / square) * cross(normal, plane.u_axis);
  const Vec3 from_origin = projection.eye - plane.origin;
  const double height = dot(normal, from_origin);
  if (!(std::abs(height) > flat * area * std::max(length(projection.eye), length(plane.origin)))) return {};

  ScreenMap map;
  map.u = along(dual_u, projection);
  map.v = along(dual_v, projection);
  map.w = along((-1 / height) * normal, projection);
  map.u_origin = whole_and_rest(dot(dual_u, from_origin));
  map.v_origin = whole_and_rest(dot(dual_v, from_origin));
  if (!finite(map)) return {};
  return map;
}

std::optional<ScreenMap> screen_map(const TexturedTriangle& triangle, const Projection& projection) {
  // A coordinate f that is linear on the triangle is F (x, y, w) in homogeneous screen coordinates, F found
  // from the three corners: the inverse of the matrix of the corners, times their values. Divided by w that
  // is f/w = F (x/w, y/w, 1), linear on the screen; f = 1 gives 1/w itself. No corner need be in front.
  std::array<Vec3, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenPoint p = projection.at(triangle.corners[i]);
    rows[i] = {p.x, p.y, p.w};
  }
  const Vec3 a = cross(rows[1], rows[2]), b = cross(rows[2], rows[0]), c = cross(rows[0], rows[1]);
  const double determinant = dot(rows[0], a);
  if (!(std::abs(determinant) > flat * length(rows[0]) * length(rows[1]) * length(rows[2]))) return {};

  // Whole tiles common to the corners are kept apart: the texture is periodic, precision is not.
  const double u0 = std::floor(*std::min_element(triangle.u.begin(), triangle.u.end()));
  const double v0 = std::floor(*std::min_element(triangle.v.begin(), triangle.v.end()));
  const auto solved = [&](double f0, double f1, double f2) {
    const Vec3 f = (1 / determinant) * (f0 * a + f1 * b + f2 * c);
    return ScreenLinear{f.x, f.y, f.z};
  };
  ScreenMap map;
  map.u = solved(triangle.u[0] - u0, triangle.u[1] - u0, triangle.u[2] - u0);
  map.v = solved(triangle.v[0] - v0, triangle.v[1] - v0, triangle.v[2] - v0);
  map.w = solved(1, 1, 1);
  map.u_origin = whole_and_rest(u0);
  map.v_origin = whole_and_rest(v0);
  if (!finite(map)) return {};
  return map;
}

SpanCoefficients coefficients(const ScreenMap& map, int row, int first, int count) {
  const double x = first + 0.5, y = row + 0.5;
  return {map.u.x,        map.u.at(x, y), map.v.x,      map.v.at(x, y), map.w.x,
          map.w.at(x, y), count,          map.u_origin, map.v_origin};
}

} // namespace tilepack
