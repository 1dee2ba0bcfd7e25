#pragma once

#include "tilepack/image/image.h"
#include "tilepack/numeric/grid.h"

namespace tilepack {

/// Along which axis courses follow one another: rows of a wall along y.
enum class CourseAxis { x, y };

/// Where the courses of a sample really lie, against places that are exactly a period apart. The sample is cut into
/// `blocks` across the courses (columns of a wall), and in each of them every course has its own displacement, so
/// courses may be uneven, slope and waver.
struct Courses {
  CourseAxis axis = CourseAxis::y;
  double period =
      0;            ///< texels: the mean distance of courses, 0 if there are too few to follow (fewer than 3)
  double first = 0; ///< texels: where the middle of course 0 would lie
  double side = 0;  ///< texels of the sample across the courses
  Grid<double> off; ///< block, course: texels from first + course * period to where it lies
  double likeness = 0; ///< -1..1: the correlation of a course with the mean of the others, on the mean of all
  double waver() const; ///< root of the mean square of all displacements, texels

  /// The displacement at a place: `along` texels along the axis, where courses lie evenly, `across` texels
  /// across it. A smooth curve through the courses' displacements (Catmull and Rom), which ends level.
  double at(double along, double across) const;
};

/// The share of the variance of brightness that lies between whole rows (axis y) or columns (x): 1 where every row has
/// one tone, as in brushed metal; of photos of planks 0.7, of wood 0.3.
double share_of_lines(const Image& image, CourseAxis axis);

/// Follows courses that are about `around` texels apart: each is moved to where it is most like the mean of all,
/// near to where its neighbours lie and by a tenth of a period at most, the mean is taken anew, and so on a few
/// times. From course to course the displacement changes by at most 4 % of the period. Looks at brightness and hue;
/// alpha is left out. `image`: values as in a SampleMap. Deterministic.
Courses followed_courses(const Image& image, CourseAxis axis, double around);

} // namespace tilepack
