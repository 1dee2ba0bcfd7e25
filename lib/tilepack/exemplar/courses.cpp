#include "tilepack/exemplar/courses.h"

#include "tilepack/image/encoding.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace tilepack {
namespace {

constexpr int most_blocks = 8;
constexpr int narrowest_block = 32;    // texels
constexpr int rounds = 4;              // of matching and taking the mean
constexpr double farthest = 0.1;       // of a period, from the even place
constexpr double steepest = 0.04;      // of a period, from one course to the next
constexpr double finest_step = 0.25;   // texels between displacements tried
constexpr int most_steps = 40;         // to either side
constexpr double telling_slope = 0.1;  // texels from course to course
constexpr int most_points = 256;       // of a course that are compared
constexpr double along_weight = 0.15;  // of keeping with the course before and after, against likeness
constexpr double across_weight = 0.15; // with the same course in the blocks beside
constexpr double level_weight = 0.01;  // with the even place

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

using CourseLine = std::vector<double>; // along the axis

// Less the mean of a period to either side: a tone that drifts is no course.
void take_out_drift(CourseLine& line, int reach) {
  std::vector<double> sums{0.0};
  for (const double v : line) sums.push_back(sums.back() + v);
  const int count = static_cast<int>(line.size());
  for (int i = 0; i < count; ++i) {
    const int low = std::max(0, i - reach), high = std::min(count, i + reach + 1);
    line[index(i)] -= (sums[index(high)] - sums[index(low)]) / (high - low);
  }
}

// What a block shows along the axis: brightness and two opponent colors, means across the block.
using Profile = std::vector<CourseLine>;

std::vector<Profile> profiles_of(const Image& image, CourseAxis axis, int blocks, double period) {
  const int channels = color_channels(image.channels());
  const int length = axis == CourseAxis::y ? image.height() : image.width();
  const int side = axis == CourseAxis::y ? image.width() : image.height();
  const int kinds = channels >= 3 ? 3 : 1;
  std::vector<Profile> profiles(index(blocks), Profile(index(kinds), CourseLine(index(length), 0.0)));
  tbb::parallel_for(0, blocks, [&](int b) {
    const int from = b * side / blocks, to = (b + 1) * side / blocks;
    std::array<double, 3> sum{};
    for (int i = 0; i < length; ++i) {
      sum = {};
      for (int j = from; j < to; ++j) {
        const auto texel = axis == CourseAxis::y ? image.texel(j, i) : image.texel(i, j);
        for (int c = 0; c < kinds; ++c) sum[index(c)] += static_cast<double>(texel[index(c)]);
      }
      Profile& p = profiles[index(b)];
      if (kinds == 1) {
        p[0][index(i)] = sum[0] / (to - from);
      } else {
        p[0][index(i)] = (sum[0] + sum[1] + sum[2]) / 3 / (to - from);
        p[1][index(i)] = (sum[0] - sum[1]) / (to - from);
        p[2][index(i)] = (sum[2] - (sum[0] + sum[1]) / 2) / (to - from);
      }
    }
    for (CourseLine& line : profiles[index(b)]) take_out_drift(line, static_cast<int>(period));
  });
  return profiles;
}

// Between texel centres; nothing beyond the ends.
double value_at(const CourseLine& line, double place) {
  const double centre = place - 0.5;
  const double low = std::floor(centre);
  const auto i = static_cast<std::ptrdiff_t>(low);
  if (i < 0 || i + 1 >= static_cast<std::ptrdiff_t>(line.size())) return 0.0;
  const double t = centre - low;
  return line[static_cast<std::size_t>(i)] * (1 - t) + line[static_cast<std::size_t>(i) + 1] * t;
}

class Follower {
public:
  Follower(std::vector<Profile> of_blocks, int length_along, double around)
      : profiles(std::move(of_blocks)), length(length_along), period(around),
        points(std::clamp(static_cast<int>(std::lround(around)), 3, most_points)),
        steps(std::clamp(static_cast<int>(std::ceil(farthest * around / finest_step)), 1, most_steps)),
        step(farthest * around / steps) {
    begin = 0;
    lay_out();
    // What courses have most of, such as a groove, comes to their middle: cut in two it could not be followed.
    const std::vector<CourseLine> mean = mean_course();
    double most = -1, middle = 0;
    for (int i = 0; i < points; ++i) {
      double change = 0;
      for (const CourseLine& line : mean)
        for (int k = -points / 16; k <= points / 16; ++k) {
          const int at = (i + k + points) % points;
          const double d = line[index((at + 1) % points)] - line[index(at)];
          change += d * d;
        }
      if (change > most) {
        most = change;
        middle = (i + 1) * period / points;
      }
    }
    begin = middle - period / 2;
    if (begin > 0) begin -= period;
    if (begin + period / 2 < 0) begin += period;
    lay_out();
  }

  int courses() const { return count; }

  void run() {
    for (int round = 0; round < rounds; ++round) {
      const std::vector<CourseLine> mean = mean_course();
      double energy = 0;
      for (const CourseLine& line : mean)
        for (const double v : line) energy += v * v;
      const Grid<double> before = off;
      for (int b = 0; b < off.width; ++b) follow(b, mean, energy, before, round > 0);
    }
  }

  // The mean correlation of a course, all its blocks together, with the mean of the others.
  double likeness() const {
    const std::vector<CourseLine> mean = mean_course();
    double sum = 0;
    for (int k = 0; k < count; ++k) {
      double cross = 0, own = 0, others = 0;
      for (std::size_t c = 0; c < mean.size(); ++c)
        for (int i = 0; i < points; ++i) {
          double here = 0, squares = 0;
          for (int b = 0; b < off.width; ++b) {
            const double v = value_at(profiles[index(b)][c], place(k, i, off.at(b, k)));
            here += v;
            squares += v * v;
          }
          const double rest = (count * mean[c][index(i)] - here / off.width) / (count - 1);
          cross += here * rest;
          own += squares;
          others += off.width * rest * rest;
        }
      if (own > 0 && others > 0) sum += cross / (std::sqrt(own) * std::sqrt(others));
    }
    return sum / count;
  }

  double begin = 0; // of course 0
  Grid<double> off; // block, course

private:
  void lay_out() {
    count = std::max(0, static_cast<int>((length - begin - period / 2) / period + 1));
    off = Grid<double>(static_cast<int>(profiles.size()), count, 0.0);
  }

  double place(int course, int point, double moved) const {
    return begin + (course + (point + 0.5) / points) * period + moved;
  }

  std::vector<CourseLine> mean_course() const {
    std::vector<CourseLine> mean(profiles.front().size(), CourseLine(index(points), 0.0));
    for (std::size_t c = 0; c < mean.size(); ++c)
      for (int i = 0; i < points; ++i) {
        double sum = 0;
        for (int b = 0; b < off.width; ++b)
          for (int k = 0; k < count; ++k) sum += value_at(profiles[index(b)][c], place(k, i, off.at(b, k)));
        mean[c][index(i)] = count > 0 ? sum / (off.width * count) : 0.0;
      }
    return mean;
  }

  // The cheapest displacements of all courses of a block, by dynamic programming from course to course.
  void follow(int block, const std::vector<CourseLine>& mean, double energy, const Grid<double>& before,
              bool beside) {
    const int tried = 2 * steps + 1;
    const double half = farthest * period / 2;
    const auto square = [&](double d) { return energy * (d / half) * (d / half); };
    std::vector<double> costs(index(count * tried));
    tbb::parallel_for(0, count, [&](int k) {
      for (int s = 0; s < tried; ++s) {
        const double moved = (s - steps) * step;
        double likeness = 0;
        for (std::size_t c = 0; c < mean.size(); ++c)
          for (int i = 0; i < points; ++i)
            likeness += mean[c][index(i)] * value_at(profiles[index(block)][c], place(k, i, moved));
        double cost = level_weight * square(moved) - likeness;
        for (const int other : {block - 1, block + 1})
          if (beside && other >= 0 && other < before.width)
            cost += across_weight * square(moved - before.at(other, k));
        costs[index(k * tried + s)] = cost;
      }
    });
    const int reach = std::max(1, static_cast<int>(steepest * period / step));
    std::vector<int> came_from(costs.size(), 0);
    for (int k = 1; k < count; ++k)
      for (int s = 0; s < tried; ++s) {
        double least = 0;
        int best = -1;
        for (int t = std::max(0, s - reach); t <= std::min(tried - 1, s + reach); ++t) {
          const double cost = costs[index((k - 1) * tried + t)] + along_weight * square((s - t) * step);
          if (best >= 0 && cost >= least) continue;
          least = cost;
          best = t;
        }
        costs[index(k * tried + s)] += least;
        came_from[index(k * tried + s)] = best;
      }
    const auto last = costs.end() - tried;
    int s = static_cast<int>(std::min_element(last, costs.end()) - last);
    for (int k = count - 1; k >= 0; --k) {
      off.at(block, k) = (s - steps) * step;
      s = came_from[index(k * tried + s)];
    }
  }

  std::vector<Profile> profiles; // by block
  int length;
  double period;
  int points; // of a course that are compared
  int steps;  // of displacement to either side
  double step;
  int count = 0; // of courses
};

double curve(double before, double from, double to, double after, double t) {
  return from + 0.5 * t *
                    (to - before +
                     t * (2 * before - 5 * from + 4 * to - after + t * (3 * (from - to) + after - before)));
}

} // namespace

double Courses::waver() const {
  double sum = 0;
  for (const double d : off.values) sum += d * d;
  return off.values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(off.values.size()));
}

double Courses::at(double along, double across) const {
  if (off.values.empty()) return 0.0;
  const auto split = [](double place, int count) {
    const double held = std::clamp(place, 0.0, static_cast<double>(count - 1));
    const int low = std::min(static_cast<int>(held), std::max(0, count - 2));
    return std::pair{low, held - low};
  };
  const auto [course, t] = split((along - first) / period, off.height);
  const auto [block, u] = split(across / side * off.width - 0.5, off.width);
  const auto node = [&](int b, int k) {
    return off.at(std::clamp(b, 0, off.width - 1), std::clamp(k, 0, off.height - 1));
  };
  std::array<double, 4> in_block{};
  for (int i = 0; i < 4; ++i) {
    const int b = block + i - 1;
    in_block[index(i)] =
        curve(node(b, course - 1), node(b, course), node(b, course + 1), node(b, course + 2), t);
  }
  return curve(in_block[0], in_block[1], in_block[2], in_block[3], u);
}

namespace {

// What a straight line through all displacements says: where courses begin and how far apart they are on the mean.
struct Trend {
  double mean = 0;
  double slope = 0; // from one course to the next
};

Trend trend_of(const Grid<double>& off) {
  Trend trend;
  double squares = 0;
  const double middle = (off.height - 1) / 2.0;
  for (int k = 0; k < off.height; ++k)
    for (int b = 0; b < off.width; ++b) {
      trend.mean += off.at(b, k);
      trend.slope += (k - middle) * off.at(b, k);
      squares += (k - middle) * (k - middle);
    }
  trend.mean /= static_cast<double>(off.values.size());
  trend.slope /= squares;
  return trend;
}

} // namespace

double share_of_lines(const Image& image, CourseAxis axis) {
  const int length = axis == CourseAxis::y ? image.height() : image.width();
  const int side = axis == CourseAxis::y ? image.width() : image.height();
  const int channels = color_channels(image.channels());
  double sum = 0, squares = 0, of_lines = 0;
  for (int i = 0; i < length; ++i) {
    double line = 0;
    for (int j = 0; j < side; ++j) {
      const auto texel = axis == CourseAxis::y ? image.texel(j, i) : image.texel(i, j);
      double v = 0;
      for (int c = 0; c < channels; ++c) v += static_cast<double>(texel[index(c)]);
      line += v;
      squares += v * v;
    }
    sum += line;
    of_lines += line * (line / side);
  }
  const double mean_square = sum * (sum / (static_cast<double>(length) * side));
  return squares > mean_square ? (of_lines - mean_square) / (squares - mean_square) : 0.0;
}

Courses followed_courses(const Image& image, CourseAxis axis, double around) {
  Courses result;
  result.axis = axis;
  const int length = axis == CourseAxis::y ? image.height() : image.width();
  const int side = axis == CourseAxis::y ? image.width() : image.height();
  result.side = side;
  const int blocks = std::clamp(side / narrowest_block, 1, most_blocks);
  double period = around;
  // Once more with the distance found: one that is off takes up what courses may be displaced.
  for (int turn = 0; turn < 2; ++turn) {
    if (period < 3 || length / period < 3) return result;
    Follower follower(profiles_of(image, axis, blocks, period), length, period);
    if (follower.courses() < 3) return result;
    follower.run();
    const Trend trend = trend_of(follower.off);
    const double middle = (follower.courses() - 1) / 2.0;
    if (turn == 0 && std::abs(trend.slope) > telling_slope) {
      period += trend.slope;
      continue;
    }
    result.period = period + trend.slope;
    result.first = follower.begin + period / 2 + trend.mean - middle * trend.slope;
    result.likeness = follower.likeness();
    result.off = std::move(follower.off);
    for (int k = 0; k < result.off.height; ++k)
      for (int b = 0; b < blocks; ++b) result.off.at(b, k) -= trend.mean + (k - middle) * trend.slope;
    break;
  }
  return result;
}

} // namespace tilepack
