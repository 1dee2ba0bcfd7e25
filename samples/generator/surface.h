#pragma once

#include "tilepack/image/image.h"

#include <cstdint>
#include <functional>

namespace samples {

struct Rgb {
  double r = 0;
  double g = 0;
  double b = 0;
};

inline Rgb operator*(Rgb c, double s) {
  return {c.r * s, c.g * s, c.b * s};
}
inline Rgb operator+(Rgb a, Rgb b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
Rgb mix(Rgb a, Rgb b, double t);

/// A point of a surface seen from above.
struct Point {
  double height = 0;      ///< in texels
  Rgb albedo;             ///< linear, 0..1
  double roughness = 0.8; ///< 0..1
};

/// A surface as registered images: heights (1 channel), albedo (3, linear) and roughness (1).
struct Surface {
  tilepack::Image height;
  tilepack::Image albedo;
  tilepack::Image roughness;
};

/// Evaluates `at` at the centres of size × size texels of the plane, whose unit is the texel of the finished
/// sample; with `oversampling` texels to the unit.
Surface surface_of(int size, int oversampling, const std::function<Point(double x, double y)>& at);

/// The surface as a camera above sees it: low sun from the north-west with cast shadows, sky light dimmed in
/// hollows, a little sensor noise. Linear, 3 channels.
tilepack::Image photographed(const Surface& surface, std::uint64_t seed);

/// Takes out the plane that leans the normals of the height field to one side: on the whole they are upright then.
void make_upright(tilepack::Image& height);

/// Unit normals of the height field stored as n * 0.5 + 0.5, x east, y north (up), z towards the camera.
tilepack::Image normals_of(const tilepack::Image& height, double scale);

/// Means over factor × factor blocks.
tilepack::Image shrunken(const tilepack::Image& image, int factor);

} // namespace samples
