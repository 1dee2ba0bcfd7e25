#include "surface.h"

#include "noise.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace samples {
namespace {

using tilepack::Image;

double height_at(const Image& height, int x, int y) {
  x = std::clamp(x, 0, height.width() - 1);
  y = std::clamp(y, 0, height.height() - 1);
  return static_cast<double>(height.texel(x, y)[0]);
}

struct Slope {
  double x = 0;
  double y = 0;
};

Slope slope_at(const Image& height, int x, int y) {
  return {(height_at(height, x + 1, y) - height_at(height, x - 1, y)) / 2,
          (height_at(height, x, y + 1) - height_at(height, x, y - 1)) / 2};
}

// The steepest rise seen from (x, y) towards (dx, dy), over distances up to `reach` texels.
double horizon(const Image& height, int x, int y, int dx, int dy, int reach) {
  const double own = height_at(height, x, y);
  const double unit = std::sqrt(static_cast<double>(dx * dx + dy * dy));
  double steepest = 0;
  for (int step = 1; step <= reach; step += 1 + step / 4)
    steepest = std::max(steepest, (height_at(height, x + step * dx, y + step * dy) - own) / (step * unit));
  return steepest;
}

// The share of the sky that is not hidden: the sine of the horizon's elevation, averaged over eight
// directions.
double sky(const Image& height, int x, int y, int reach) {
  double open = 0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0) continue;
      const double rise = horizon(height, x, y, dx, dy, reach);
      open += 1 - rise / std::sqrt(1 + rise * rise);
    }
  return open / 8;
}

} // namespace

Rgb mix(Rgb a, Rgb b, double t) {
  return a + (b + a * -1.0) * t;
}

Surface surface_of(int size, int oversampling, const std::function<Point(double x, double y)>& at) {
  const int side = size * oversampling;
  Surface result{Image(side, side, 1), Image(side, side, 3), Image(side, side, 1)};
  tbb::parallel_for(0, side, [&](int y) {
    for (int x = 0; x < side; ++x) {
      const Point point = at((x + 0.5) / oversampling, (y + 0.5) / oversampling);
      result.height.texel(x, y)[0] = static_cast<float>(point.height * oversampling);
      result.roughness.texel(x, y)[0] = static_cast<float>(std::clamp(point.roughness, 0.0, 1.0));
      const auto albedo = result.albedo.texel(x, y);
      albedo[0] = static_cast<float>(std::clamp(point.albedo.r, 0.0, 1.0));
      albedo[1] = static_cast<float>(std::clamp(point.albedo.g, 0.0, 1.0));
      albedo[2] = static_cast<float>(std::clamp(point.albedo.b, 0.0, 1.0));
    }
  });
  return result;
}

Image photographed(const Surface& surface, std::uint64_t seed) {
  // The sun stands in the north-west, 50 degrees high.
  const double sun_x = -0.4545, sun_y = -0.4545, sun_z = 0.766;
  const double sun_rise = 1.19; // tan 50°
  const Rgb sun_color{1.35, 1.26, 1.1}, sky_color{0.5, 0.55, 0.63};
  Image result(surface.height.width(), surface.height.height(), 3);
  tbb::parallel_for(0, result.height(), [&](int y) {
    for (int x = 0; x < result.width(); ++x) {
      const Slope slope = slope_at(surface.height, x, y);
      const double length = std::sqrt(slope.x * slope.x + slope.y * slope.y + 1);
      const double lambert = std::max(0.0, (-slope.x * sun_x - slope.y * sun_y + sun_z) / length);
      const double shadow =
          1 - smooth_step(sun_rise * 0.8, sun_rise * 1.25, horizon(surface.height, x, y, -1, -1, 40));
      const double open = sky(surface.height, x, y, 24);
      const double grain = 1 + 0.03 * (random_at(x, y, seed) - 0.5);
      const Rgb light = (sun_color * (lambert * shadow) + sky_color * (open * open)) * grain;
      const auto albedo = surface.albedo.texel(x, y);
      const auto texel = result.texel(x, y);
      texel[0] = static_cast<float>(static_cast<double>(albedo[0]) * light.r);
      texel[1] = static_cast<float>(static_cast<double>(albedo[1]) * light.g);
      texel[2] = static_cast<float>(static_cast<double>(albedo[2]) * light.b);
    }
  });
  return result;
}

Image normals_of(const Image& height, double scale) {
  Image result(height.width(), height.height(), 3);
  for (int y = 0; y < height.height(); ++y)
    for (int x = 0; x < height.width(); ++x) {
      const Slope slope = slope_at(height, x, y);
      const double nx = -slope.x * scale, ny = slope.y * scale; // y south in the image, north in the normal
      const double length = std::sqrt(nx * nx + ny * ny + 1);
      const auto texel = result.texel(x, y);
      texel[0] = static_cast<float>(nx / length * 0.5 + 0.5);
      texel[1] = static_cast<float>(ny / length * 0.5 + 0.5);
      texel[2] = static_cast<float>(1 / length * 0.5 + 0.5);
    }
  return result;
}

void make_upright(Image& height) {
  constexpr int steps = 16; // of Newton's method, which needs far fewer
  for (int step = 0; step < steps; ++step) {
    Slope mean, rate; // of the normals, and how fast they turn with the plane
    for (int y = 0; y < height.height(); ++y)
      for (int x = 0; x < height.width(); ++x) {
        const Slope slope = slope_at(height, x, y);
        const double square = slope.x * slope.x + slope.y * slope.y + 1;
        const double length = std::sqrt(square);
        mean.x += slope.x / length;
        mean.y += slope.y / length;
        rate.x += (1 + slope.y * slope.y) / (square * length);
        rate.y += (1 + slope.x * slope.x) / (square * length);
      }
    for (int y = 0; y < height.height(); ++y)
      for (int x = 0; x < height.width(); ++x)
        height.texel(x, y)[0] -= static_cast<float>(mean.x / rate.x * x + mean.y / rate.y * y);
  }
}

Image shrunken(const Image& image, int factor) {
  Image result(image.width() / factor, image.height() / factor, image.channels());
  for (int y = 0; y < result.height(); ++y)
    for (int x = 0; x < result.width(); ++x)
      for (int c = 0; c < image.channels(); ++c) {
        double sum = 0;
        for (int j = 0; j < factor; ++j)
          for (int i = 0; i < factor; ++i)
            sum +=
                static_cast<double>(image.texel(x * factor + i, y * factor + j)[static_cast<std::size_t>(c)]);
        result.texel(x, y)[static_cast<std::size_t>(c)] = static_cast<float>(sum / (factor * factor));
      }
  return result;
}

} // namespace samples
