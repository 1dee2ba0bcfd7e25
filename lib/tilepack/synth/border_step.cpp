#include "tilepack/synth/border_step.h"

#include <cstdint>
#include <cstdlib>

namespace tilepack {
namespace {

int step(const std::uint8_t* a, const std::uint8_t* b, int channels) {
  int sum = 0;
  for (int c = 0; c < channels; ++c) sum += std::abs(a[c] - b[c]);
  return sum;
}

int step_at(const FeatureImage& image, const StripAxes& axes, SourceTexel place, int along) {
  const SourceTexel before = sum(place, axes.at(along, axes.reach - 1));
  const SourceTexel after = sum(place, axes.at(along, axes.reach));
  return step(image.clamped_texel(before.x, before.y), image.clamped_texel(after.x, after.y),
              image.channels - image.guides);
}

} // namespace

double mean_step(const FeatureImage& image, Direction direction) {
  const int dx = direction == Direction::vertical ? 1 : 0;
  const int dy = 1 - dx;
  std::int64_t total = 0;
  for (int y = dy; y < image.height; ++y)
    for (int x = dx; x < image.width; ++x)
      total += step(image.texel(x - dx, y - dy), image.texel(x, y), image.channels - image.guides);
  return static_cast<double>(total) / (static_cast<double>(image.width - dx) * (image.height - dy));
}

double step_across(const FeatureImage& image, const StripAxes& axes, SourceTexel place) {
  std::int64_t total = 0;
  for (int along = 0; along < axes.length; ++along) total += step_at(image, axes, place, along);
  return static_cast<double>(total) / axes.length;
}

double step_across(const FeatureImage& image, const StripAxes& axes, SourceTexel place, SourceTexel first,
                   SourceTexel second) {
  const int half = axes.corner_reach / 2;
  std::int64_t total = 0;
  for (int along = 0; along < axes.length; ++along) {
    SourceTexel origin = place;
    if (along < half) origin = corner_origin(axes, first, End::first);
    if (along >= axes.length - half) origin = corner_origin(axes, second, End::second);
    total += step_at(image, axes, origin, along);
  }
  return static_cast<double>(total) / axes.length;
}

} // namespace tilepack
