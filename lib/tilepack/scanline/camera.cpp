#include "tilepack/scanline/camera.h"

#include "tilepack/error/error.h"
#include "tilepack/numeric/exact_math.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace tilepack {
namespace {

constexpr double farthest = 1e9;
constexpr int largest_side = 65536;

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorKind::usage, field("camera"), message);
}

void check(Vec3 place, const char* name) {
  for (double value : {place.x, place.y, place.z}) {
    if (!(std::abs(value) <= farthest)) {
      refuse(fmt::format("{} is at ({}, {}, {}); each number must lie within -1e9..1e9", name, place.x,
                         place.y, place.z));
    }
  }
}

// The unit vector along `v`; `v` is scaled first, so that squares neither overflow nor vanish.
Vec3 unit(Vec3 v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0)) return {};
  const Vec3 s = (1 / largest) * v;
  return (1 / std::sqrt(dot(s, s))) * s;
}

} // namespace

double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Camera camera_of(const std::string& text) {
  std::array<double, 10> n{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < n.size(); ++i) {
    const auto [after, fault] = std::from_chars(at, end, n[i]);
    const bool last = i + 1 == n.size();
    if (fault != std::errc() || (last ? after != end : after == end || *after != ',')) {
      refuse(fmt::format("'{}' is not ten numbers with commas: eye x,y,z, target x,y,z, up x,y,z and the "
                         "vertical field of view in degrees, such as 0,2,0,0,1,-10,0,1,0,60",
                         text));
    }
    at = after + 1;
  }
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, n[9]};
}

Projection::Projection(const Camera& camera, Size picture) {
  if (std::min(picture.width, picture.height) < 1 || std::max(picture.width, picture.height) > largest_side) {
    throw Error(
        ErrorKind::usage, field("size"),
        fmt::format("{} x {} pixels; each side may be 1..{}", picture.width, picture.height, largest_side));
  }
  check(camera.eye, "the eye");
  check(camera.target, "the target");
  check(camera.up, "up");
  if (!(camera.fov >= 1e-3 && camera.fov <= 179.999)) {
    refuse(fmt::format("a field of view of {} degrees; it may be 0.001..179.999", camera.fov));
  }
  if (!(camera.near > 0 && camera.near <= farthest)) {
    refuse(fmt::format("a near distance of {}; it may be above 0, up to 1e9", camera.near));
  }
  forward = unit(camera.target - camera.eye);
  if (forward == Vec3{}) refuse("eye and target are the same place; move one of them");
  const Vec3 aside = cross(forward, unit(camera.up));
  if (!(dot(aside, aside) > 1e-18)) {
    refuse("up is zero or points along the view; choose one that points aside of it, such as 0,1,0 or 0,0,1");
  }
  right = unit(aside);
  up = cross(right, forward);

  size = picture;
  eye = camera.eye;
  near = camera.near;
  pixels = size.height / (2 * exact_tangent_of_half(camera.fov));
  across = (1 / pixels) * right;
  down = (-1 / pixels) * up;
  corner = forward - (0.5 * size.width) * across - (0.5 * size.height) * down;
}

ScreenPoint Projection::at(Vec3 place) const {
  const Vec3 p = place - eye;
  const double w = dot(p, forward);
  return {dot(p, right) * pixels + 0.5 * size.width * w, 0.5 * size.height * w - dot(p, up) * pixels, w};
}

} // namespace tilepack
