#pragma once

#include "tilepack/scanline/camera.h"
#include "tilepack/scanline/span.h"

#include <array>
#include <optional>

namespace tilepack {

/// An unbounded plane: the place with texture coordinates (u, v), in tiles, is origin + u * u_axis +
/// v * v_axis. Seen from both sides.
struct TexturedPlane {
  Vec3 origin;
  Vec3 u_axis{1, 0, 0};
  Vec3 v_axis{0, 0, 1}; ///< the default is the ground y = 0, a tile a world unit, v to the viewer's south
};

/// Seen from both sides. Texture coordinates in tiles, v growing downwards in the texture.
struct TexturedTriangle {
  std::array<Vec3, 3> corners;
  std::array<double, 3> u{}, v{};
};

/// A x + B y + C of screen place (x, y).
struct ScreenLinear {
  double x = 0, y = 0, one = 0;
  double at(double px, double py) const { return x * px + y * py + one; }
};

/// Texture coordinates of a flat surface over the screen: u = u_origin + u(x,y)/w(x,y), v alike, where
/// w(x,y) > 0; w is the reciprocal of the distance along the view. The fractional-linear map of [Cou, Eq.
/// 1.3].
struct ScreenMap {
  ScreenLinear u, v, w;
  TileCoordinate u_origin, v_origin;
};

/// The map of a plane. Nothing for a plane seen edge-on (the eye lies in it), axes that are parallel or zero,
/// and numbers that are not finite.
std::optional<ScreenMap> screen_map(const TexturedPlane& plane, const Projection& projection);

/// The map of the plane of a triangle. Nothing for a triangle without area, one seen edge-on, and numbers
/// that are not finite. Corners may lie behind the eye.
std::optional<ScreenMap> screen_map(const TexturedTriangle& triangle, const Projection& projection);

/// The run of pixels first..first+count-1 of a row, as spans want it.
SpanCoefficients coefficients(const ScreenMap& map, int row, int first, int count);

} // namespace tilepack
