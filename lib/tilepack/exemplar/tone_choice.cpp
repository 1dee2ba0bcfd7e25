#include "tilepack/exemplar/tone_choice.h"

#include "tilepack/exemplar/courses.h"
#include "tilepack/exemplar/feature_image.h"
#include "tilepack/exemplar/sample_traits.h"

namespace tilepack {
namespace {

constexpr double lines_of_courses = 0.5; // shares of the variance of brightness
constexpr double lines_of_grain = 0.25;
constexpr double slow_shading = 0.018;
constexpr double ink_on_paper = 0.78; // SampleTraits::two_tone

std::optional<EvenCourses> courses_along(const SampleMap& map, CourseAxis axis, const Period& period,
                                         int tile_side) {
  if (period.exact || whole_periods(period, tile_side) == 0) return {};
  if (share_of_lines(map.image, axis) < lines_of_courses) return {};
  const Courses found = followed_courses(map.image, axis, period.length);
  if (found.period <= 0) return {};
  return EvenCourses{axis, found.period, found.first};
}

} // namespace

ToneChoice tone_choice(std::span<const SampleMap> samples, const Periodicity& periods, Size tile) {
  const SampleMap& main = samples[0];
  const bool in_x = periods.x.length > 0, in_y = periods.y.length > 0;
  if (main.role != Role::color || (in_x && in_y) || periods.x.exact || periods.y.exact) return {};
  if (periods.x.lines > 0 || periods.y.lines > 0) return {};
  ToneChoice choice;
  if (in_x || in_y) {
    choice.courses = in_y ? courses_along(main, CourseAxis::y, periods.y, tile.height)
                          : courses_along(main, CourseAxis::x, periods.x, tile.width);
    if (!choice.courses) return {};
  } else if (share_of_lines(main.image, CourseAxis::x) < lines_of_grain &&
             share_of_lines(main.image, CourseAxis::y) < lines_of_grain) {
    return {};
  }
  const SampleTraits traits = sample_traits(feature_image(samples.first(1)), periods, tile);
  if (traits.two_tone > ink_on_paper || (!choice.courses && traits.shading < slow_shading)) return {};
  choice.flatten = 100;
  return choice;
}

} // namespace tilepack
