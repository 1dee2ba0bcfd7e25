#include "tilepack/exemplar/flatten.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace tilepack {
namespace {

constexpr int flattened_channels = 4;
constexpr double most_gain = 4.0;
constexpr double least_weight = 1e-6; // of a mean: less is what rounding left
constexpr double largest_half = 65504.0;
constexpr int course_bands =
    4; // parts across a course whose tones are taken out apart: paint peels in the middle of a board
constexpr int course_reach = 6; // of a tile's side: knots and gaps stay, and patches as long as a tile don't

using Means = std::array<double, flattened_channels>;

// How the values of a map are read as what is averaged.
class Reading {
public:
  explicit Reading(const SampleMap& map) : channels(map.image.channels()) {
    if (map.role == Role::height) return;
    weighted = has_alpha(map.role, channels);
    channels = color_channels(channels);
    decode = map.encoding == Encoding::srgb;
    if (decode && map.depth == Depth::u8) top = 255;
    if (decode && map.depth == Depth::u16) top = 65535;
    for (int code = 0; top > 0 && code <= top; ++code)
      decoded.push_back(srgb_to_linear(static_cast<double>(code) / top));
  }

  double plain(float stored) const {
    if (top > 0) return decoded[static_cast<std::size_t>(code_of(stored, top))];
    const double v = static_cast<double>(stored);
    return decode ? srgb_to_linear(v) : v;
  }

  int channels;          // that are flattened
  bool weighted = false; // by the channel after them
  bool decode = false;   // from sRGB

private:
  int top = 0;
  std::vector<double> decoded; // of each code of an integer depth: a look-up costs a tenth of a root
};

// What is summed up: plain values times their weight, and the weight itself in place of alpha.
Image weighted_values(const Image& image, const Reading& reading) {
  Image result = Image::unset(image.size(), image.channels());
  tbb::parallel_for(0, image.height(), [&](int y) {
    for (int x = 0; x < image.width(); ++x) {
      const auto from = image.texel(x, y);
      const auto to = result.texel(x, y);
      const double weight = reading.weighted ? std::clamp(static_cast<double>(from.back()), 0.0, 1.0) : 1.0;
      if (reading.weighted) to.back() = static_cast<float>(weight);
      for (std::size_t c = 0; c < static_cast<std::size_t>(reading.channels); ++c)
        to[c] = static_cast<float>(weight * reading.plain(from[c]));
    }
  });
  return result;
}

// Sums of what `add(x, y, sums)` adds for each texel: row by row and then over rows, always in one order.
template <typename Add>
Means summed(Size size, Add&& add) {
  std::vector<Means> rows(static_cast<std::size_t>(size.height));
  tbb::parallel_for(0, size.height, [&](int y) {
    Means sums{};
    for (int x = 0; x < size.width; ++x) add(x, y, sums);
    rows[static_cast<std::size_t>(y)] = sums;
  });
  Means total{};
  for (const Means& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) total[c] += row[c];
  return total;
}

// The whole means of weighted_values, 0 where nothing has weight, and in place of alpha the sum of weights.
Means whole_means(const Image& values, const Reading& reading) {
  Means means = summed(values.size(), [&](int x, int y, Means& sums) {
    const auto texel = values.texel(x, y);
    for (std::size_t c = 0; c < texel.size(); ++c) sums[c] += static_cast<double>(texel[c]);
  });
  const auto channels = static_cast<std::size_t>(reading.channels);
  const double weight =
      reading.weighted ? means[channels] : static_cast<double>(values.width()) * values.height();
  for (std::size_t c = 0; c < channels; ++c) means[c] = weight > 0 ? means[c] / weight : 0.0;
  return means;
}

// Means over 2 · reach + 1 neighbours along a line of `count` points, at most reach past its ends, where it
// is continued by its mirror image. A point is `lanes` numbers.
//
// Running sums: what a texel leaves behind in rounding is 2^-53 of the largest value for each step, and a
// mean below a quarter of the whole one is treated as if it were a quarter, so that a sun in the sample harms
// none.
//
// Past the border nothing is known. On a plane of slope g the mirror raises the mean at its lower border by g
// times the mean distance from the border, 0.8 standard deviations or a fifth of a tile; windows cut off at
// the border and divided by what is left of them err by a tenth more, since each of the three passes is
// lopsided. Of a plane from 0.25 to 0.75 over four tiles the mirror leaves 5.1 % of the
// deviation, cut windows 6.4 %. A line fitted in each cut window leaves nothing, but the few texels at its
// end carry it: against the means of the uncropped photos, those of crops of seven err by 0.069 of the value
// (RMS, averaged), those of the mirror by 0.040, those of cut windows by 0.039.
template <int lanes>
void box_means(const double* from, double* to, int count, int reach) {
  const auto point = [&](int i) {
    if (i < 0) i = -1 - i;
    if (i >= count) i = 2 * count - 1 - i;
    return from + static_cast<std::ptrdiff_t>(i) * lanes;
  };
  std::array<double, lanes> sums{};
  for (int i = -reach; i < reach; ++i)
    for (std::size_t k = 0; k < lanes; ++k) sums[k] += point(i)[k];
  const double share = 1.0 / (2 * reach + 1);
  for (int i = 0; i < count; ++i, to += lanes) {
    const double* enters = point(i + reach);
    const double* leaves = point(i - reach);
    for (std::size_t k = 0; k < lanes; ++k) {
      const double sum = sums[k] + enters[k];
      to[k] = sum * share;
      sums[k] = sum - leaves[k];
    }
  }
}

// A line of `count` points read into doubles, averaged three times.
template <int lanes>
struct Line {
  int count;
  std::vector<double> values;
  std::vector<double> averaged;

  explicit Line(int points)
      : count(points), values(static_cast<std::size_t>(points) * lanes), averaged(values.size()) {}

  void smooth(int reach) {
    for (int pass = 0; pass < 3; ++pass) {
      box_means<lanes>(values.data(), averaged.data(), count, reach);
      values.swap(averaged);
    }
  }
};

template <int lanes>
void smooth_rows(Image& values, int reach) {
  tbb::parallel_for(tbb::blocked_range<int>(0, values.height()), [&](const auto& range) {
    Line<lanes> line(values.width());
    for (int y = range.begin(); y < range.end(); ++y) {
      const auto row = values.row(y);
      std::copy(row.begin(), row.end(), line.values.begin());
      line.smooth(reach);
      std::transform(line.values.begin(), line.values.end(), row.begin(),
                     [](double v) { return static_cast<float>(v); });
    }
  });
}

// Sixteen numbers of a row at a time: whole cache lines, and sums side by side. The last strip is filled up
// with zeros.
void smooth_columns(Image& values, int reach) {
  constexpr std::size_t strip = 16;
  const std::size_t numbers = values.row(0).size();
  tbb::parallel_for(std::size_t{0}, (numbers + strip - 1) / strip, [&](std::size_t s) {
    const std::size_t first = s * strip;
    const std::size_t used = std::min(strip, numbers - first);
    Line<strip> line(values.height());
    double* point = line.values.data();
    for (int y = 0; y < values.height(); ++y, point += strip)
      std::copy_n(values.row(y).begin() + static_cast<std::ptrdiff_t>(first), used, point);
    line.smooth(reach);
    point = line.values.data();
    for (int y = 0; y < values.height(); ++y, point += strip)
      std::transform(point, point + used, values.row(y).begin() + static_cast<std::ptrdiff_t>(first),
                     [](double v) { return static_cast<float>(v); });
  });
}

// Along one axis; a box is the product of one along rows and one along columns.
void smooth(Image& values, CourseAxis axis, int reach) {
  if (axis == CourseAxis::y) return smooth_columns(values, reach);
  switch (values.channels()) {
  case 1:
    return smooth_rows<1>(values, reach);
  case 2:
    return smooth_rows<2>(values, reach);
  case 3:
    return smooth_rows<3>(values, reach);
  default:
    return smooth_rows<4>(values, reach);
  }
}

// What is known of a channel: its mean, and what takes that place so that the mean stays.
struct Levels {
  Means whole{};
  Means level{};
};

// The mean of weighted values round a texel. Far from anything visible there is none, and no shading.
double local_mean(std::span<const float> means, const Reading& reading, std::size_t c, double whole) {
  if (!reading.weighted) return static_cast<double>(means[c]);
  const double weight = static_cast<double>(means.back());
  return weight > least_weight ? static_cast<double>(means[c]) / weight : whole;
}

// What light is divided by.
double divisor(double local, double whole) {
  return std::max(local, whole / most_gain);
}

// Values over their local means have a mean that is near 1, not 1 (0.997 in wood, 0.88 in clouds with gaps of
// clear sky), and the mirror moves the mean of local means; the level makes up for either.
Levels levels_of(const SampleMap& map, const Reading& reading, const Image& means, const Means& whole) {
  const bool height = map.role == Role::height;
  const auto channels = static_cast<std::size_t>(reading.channels);
  const Means sums = summed(map.image.size(), [&](int x, int y, Means& sum) {
    const auto value = map.image.texel(x, y);
    const double weight = reading.weighted ? std::clamp(static_cast<double>(value.back()), 0.0, 1.0) : 1.0;
    for (std::size_t c = 0; c < channels; ++c) {
      const double local = local_mean(means.texel(x, y), reading, c, whole[c]);
      if (height)
        sum[c] += local;
      else if (whole[c] > 0)
        sum[c] += weight * (reading.plain(value[c]) / divisor(local, whole[c]));
    }
  });
  const double count =
      reading.weighted ? whole[channels] : static_cast<double>(map.image.width()) * map.image.height();
  Levels levels{whole, whole};
  for (std::size_t c = 0; c < channels; ++c)
    if (height)
      levels.level[c] = sums[c] / count;
    else if (whole[c] > 0 && sums[c] > 0)
      levels.level[c] = whole[c] * (count / sums[c]);
  return levels;
}

// By what light is multiplied; 1 in a channel without light, such as the blue of a pure yellow.
double gain(double local, double whole, double level, double share) {
  return whole > 0 ? 1.0 + share * (level / divisor(local, whole) - 1.0) : 1.0;
}

float stored(double value, Depth depth) {
  if (depth == Depth::f16) value = std::clamp(value, -largest_half, largest_half);
  return quantised(static_cast<float>(value), depth);
}

// What is slow course by course: a mean over part of the way across it, over what all courses show on average there, so that
// a groove in one place of each is no tone.
class CourseMeans {
public:
  CourseMeans(const EvenCourses& even_courses, Size size)
      : courses(even_courses), along_y(even_courses.axis == CourseAxis::y),
        length(along_y ? size.height : size.width), side(along_y ? size.width : size.height) {
    for (int i = 0; i < length; ++i) {
      const double place = (i + 0.5 - courses.joint) / courses.period;
      course_of.push_back(static_cast<int>(std::floor(place)));
      phase_of.push_back(static_cast<int>((place - std::floor(place)) * phases()));
    }
  }

  // Of each texel what lies round it across its course, not beyond the joints.
  void take(Image& values, const Means& whole, bool plus, int channels) const {
    const std::vector<Means> usual = usual_of_phases(values);
    const int reach = std::max(1, phases() / course_bands / 2);
    tbb::parallel_for(0, side, [&](int j) {
      std::vector<Means> line; // as it was
      for (int i = 0; i < length; ++i) {
        const auto texel = values.texel(along_y ? j : i, along_y ? i : j);
        Means& to = line.emplace_back();
        for (std::size_t c = 0; c < texel.size(); ++c) to[c] = static_cast<double>(texel[c]);
      }
      for (int i = 0; i < length; ++i) {
        Means sums{}, expected{};
        double count = 0;
        for (int k = std::max(0, i - reach); k <= std::min(length - 1, i + reach); ++k) {
          if (course_of[index(k)] != course_of[index(i)]) continue;
          count += 1;
          for (std::size_t c = 0; c < sums.size(); ++c) {
            sums[c] += line[index(k)][c];
            expected[c] += usual[index(phase_of[index(k)])][c];
          }
        }
        const auto texel = values.texel(along_y ? j : i, along_y ? i : j);
        const std::size_t alpha = index(channels);
        for (std::size_t c = 0; c < texel.size(); ++c)
          if (c == alpha)
            texel[c] = static_cast<float>(sums[c] / count);
          else if (plus)
            texel[c] = static_cast<float>(whole[c] + (sums[c] - expected[c]) / count);
          else // times the weight by which local_mean() divides
            texel[c] = static_cast<float>(whole[c] * (expected[c] > 0 ? sums[c] / expected[c] : 1.0) *
                                          (texel.size() > alpha ? expected[alpha] / count : 1.0));
      }
    });
  }

private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  int phases() const { return std::max(1, static_cast<int>(std::lround(courses.period))); }

  // What all courses show on average at each place across them.
  std::vector<Means> usual_of_phases(const Image& values) const {
    std::vector<Means> lines(index(length));
    tbb::parallel_for(0, length, [&](int i) {
      for (int j = 0; j < side; ++j) {
        const auto texel = values.texel(along_y ? j : i, along_y ? i : j);
        for (std::size_t c = 0; c < texel.size(); ++c) lines[index(i)][c] += static_cast<double>(texel[c]);
      }
    });
    // Of whole courses: one that is cut off would lend its tone to some places and not to others.
    const auto is_whole = [&](int course) {
      return std::count(course_of.begin(), course_of.end(), course) >= phases() - 1;
    };
    std::vector<Means> usual(index(phases()));
    std::vector<int> count(usual.size());
    for (const bool whole : {true, false}) {
      const std::vector<int> before = count;
      for (int i = 0; i < length; ++i) {
        const std::size_t phase = index(phase_of[index(i)]);
        if (before[phase] > 0 || (whole && !is_whole(course_of[index(i)]))) continue;
        ++count[phase];
        for (std::size_t c = 0; c < usual[phase].size(); ++c) usual[phase][c] += lines[index(i)][c];
      }
    }
    for (std::size_t p = 0; p < usual.size(); ++p)
      for (double& sum : usual[p]) sum /= std::max(1.0, static_cast<double>(count[p]) * side);
    return usual;
  }

  const EvenCourses& courses;
  bool along_y;
  int length; // along the axis
  int side;   // across it
  std::vector<int> course_of;
  std::vector<int> phase_of;
};

} // namespace

SampleMap flattened(SampleMap map, double share, Size tile, std::optional<Depth> depth,
                    const std::optional<EvenCourses>& courses) {
  if (share <= 0 || (map.role != Role::color && map.role != Role::height)) return map;
  const Image& image = map.image;
  const Reading reading(map);
  Image means = weighted_values(image, reading);
  const Means whole = whole_means(means, reading);
  if (courses) {
    CourseMeans(*courses, image.size()).take(means, whole, map.role == Role::height, reading.channels);
    const bool along_y = courses->axis == CourseAxis::y;
    const int side = along_y ? std::min(tile.width, image.width()) : std::min(tile.height, image.height());
    smooth(means, along_y ? CourseAxis::x : CourseAxis::y, std::max(1, side / course_reach));
  } else {
    const int side = std::min({tile.width, tile.height, image.width(), image.height()});
    const int reach = std::max(1, side / 4);
    smooth(means, CourseAxis::x, reach);
    smooth(means, CourseAxis::y, reach);
  }
  const Levels levels = levels_of(map, reading, means, whole);
  const Depth kept = depth.value_or(map.depth);

  tbb::parallel_for(0, image.height(), [&](int y) {
    for (int x = 0; x < image.width(); ++x) {
      const auto given = image.texel(x, y);
      const auto result = means.texel(x, y); // takes the place of the means it is made from
      for (std::size_t c = 0; c < static_cast<std::size_t>(reading.channels); ++c) {
        const double value = reading.plain(given[c]);
        const double local = local_mean(result, reading, c, whole[c]);
        double flat = map.role == Role::height ? value + share * (levels.level[c] - local)
                                               : value * gain(local, whole[c], levels.level[c], share);
        if (reading.decode) flat = linear_to_srgb(flat);
        result[c] = stored(flat, kept);
      }
      if (reading.weighted) result.back() = given.back();
    }
  });
  map.image = std::move(means);
  map.depth = kept;
  return map;
}

} // namespace tilepack
