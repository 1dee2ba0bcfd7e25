#pragma once

#include "tilepack/image/image.h"

#include <string>

namespace tilepack {

struct Vec3 {
  double x = 0, y = 0, z = 0;

  friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  bool operator==(const Vec3&) const = default;
};

double dot(Vec3 a, Vec3 b);
Vec3 cross(Vec3 a, Vec3 b);

/// A pinhole camera in a right-handed world. Lengths in world units.
struct Camera {
  Vec3 eye;            ///< each number within ±1e9
  Vec3 target;         ///< the place in the middle of the picture; not the eye
  Vec3 up{0, 1, 0};    ///< what points up in the picture; not along the view
  double fov = 60;     ///< vertical field of view in degrees, 1e-3..179.999
  double near = 0.001; ///< nearer than this along the view, triangles are cut off
};

/// "eye,target,up,fov": ten numbers with commas. Throws Error (usage) for anything else, and as Projection.
Camera camera_of(const std::string& text);

/// A place on the screen in homogeneous coordinates: pixel coordinates x/w, y/w (row 0 on top, centre of
/// pixel (i, j) at (i + 0.5, j + 0.5)) and w the distance along the view. Behind the eye w < 0.
struct ScreenPoint {
  double x = 0, y = 0, w = 0;
};

/// A camera and a picture size, worked out: where a place lands, and what a pixel looks along.
class Projection {
public:
  /// Throws Error (usage): a number that is NaN, infinite or out of its range, eye and target in one place,
  /// up along the view, a side of the picture outside 1..65536.
  Projection(const Camera& camera, Size picture);

  ScreenPoint at(Vec3 place) const;

  /// The view ray of screen place (x, y) is corner + x * across + y * down; its length along the view is 1.
  Vec3 eye, corner, across, down;
  Size size;
  double near = 0;

private:
  Vec3 right, up, forward;
  double pixels = 0; // a world unit at distance 1
};

} // namespace tilepack
