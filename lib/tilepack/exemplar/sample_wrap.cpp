#include "tilepack/exemplar/sample_wrap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tilepack {
namespace {

constexpr int smallest_side = 16;
constexpr int inside_places = 256; // at which the step inside is measured, evenly spread

constexpr int far_pairs = 256; // and the step between places that have nothing to do with each other

// How far above the step inside the one across the border may lie.
struct SquareLimit {
  int side;      // of squares, texels
  double share;  // of the way from the step inside to that between strangers
  double excess; // of the step inside; whichever allows more
};
constexpr std::array limits_of_squares{SquareLimit{1, 0.2, 0.05}, SquareLimit{2, 0.45, 0.05},
                                       SquareLimit{4, 0.65, 0.45}};

constexpr double related = 0.9; // of the step between texels that have nothing to do with each other

// A texel of the image or, so that one function does for both axes, of the image turned.
struct Turned {
  const FeatureImage& image;
  bool along_y;

  int length() const { return along_y ? image.height : image.width; }
  int across() const { return along_y ? image.width : image.height; }
  const std::uint8_t* texel(int along, int other) const {
    return along_y ? image.texel(other, along) : image.texel(along, other);
  }
};

// What the means of squares at two places differ by, over all squares across, in units that are the same at all
// places. Where things that stand sharp against their ground meet a border, a few squares differ by much, and the
// rest says whether the ground goes on: hence the second mean, in which large differences count for less.
struct Step {
  double squared = 0; // root of the mean square
  double rooted = 0;  // mean of the roots

  Step& operator+=(const Step& other) {
    squared += other.squared;
    rooted += other.rooted;
    return *this;
  }
  Step operator/(double count) const { return {squared / count, rooted / count}; }
};

// Between the squares that begin at `one` and at `other`.
Step step_between(const Turned& image, int one, int other, int side) {
  const int channels = image.image.channels - image.image.guides;
  std::int64_t sum = 0;
  double roots = 0;
  int squares = 0;
  for (int j = 0; j + side <= image.across(); j += side, ++squares) {
    std::int64_t apart = 0;
    for (int c = 0; c < channels; ++c) {
      int difference = 0;
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
          difference += image.texel(other + x, j + y)[c] - image.texel(one + x, j + y)[c];
      apart += static_cast<std::int64_t>(difference) * difference;
    }
    sum += apart;
    roots += std::sqrt(std::sqrt(static_cast<double>(apart)));
  }
  return {std::sqrt(static_cast<double>(sum) / squares), roots / squares};
}

// What step_between() of texels would be on average if no texel had anything to do with its neighbour.
double unrelated_step(const Turned& image) {
  const int channels = image.image.channels - image.image.guides;
  double variance = 0;
  for (int c = 0; c < channels; ++c) {
    std::int64_t sum = 0, squares = 0;
    for (int y = 0; y < image.image.height; ++y)
      for (int x = 0; x < image.image.width; ++x) {
        const int v = image.image.texel(x, y)[c];
        sum += v;
        squares += v * v;
      }
    const double texels = static_cast<double>(image.image.width) * image.image.height;
    const double mean = static_cast<double>(sum) / texels;
    variance += static_cast<double>(squares) / texels - mean * mean;
  }
  return std::sqrt(2 * variance);
}

// The mean step at the places that lie whole periods from the border; 0 where the image holds no whole number of them.
Step step_at_periods(const Turned& image, const Period& period, int side) {
  const int count = whole_periods(period, image.length());
  if (count < 2) return {};
  Step sum;
  int places = 0;
  for (int k = 1; k < count; ++k) {
    const auto place = static_cast<int>(std::lround(static_cast<double>(k) * image.length() / count));
    if (place < side || place > image.length() - side) continue;
    sum += step_between(image, place - side, place, side);
    ++places;
  }
  return places > 0 ? sum / places : sum;
}

// The mean step at places inside.
Step step_inside(const Turned& image, int side) {
  const int last = image.length() - side;
  const int stride = std::max(1, (last - side) / inside_places);
  Step sum;
  int places = 0;
  for (int place = side; place <= last; place += stride, ++places)
    sum += step_between(image, place - side, place, side);
  return sum / places;
}

// The mean step between places a quarter to three quarters of the image apart.
Step step_of_strangers(const Turned& image, int side) {
  constexpr int distances = 8, turn = 3; // a turn, so that each distance is taken all over the image
  Step sum;
  for (int i = 0; i < far_pairs; ++i) {
    const int apart = image.length() / 4 + i * turn % distances * (image.length() / (2 * distances));
    const int place = (image.length() - side - apart) * i / (far_pairs - 1);
    sum += step_between(image, place, place + apart, side);
  }
  return sum / far_pairs;
}

bool wraps(const Turned& image, const Period& period) {
  return std::all_of(limits_of_squares.begin(), limits_of_squares.end(), [&](const SquareLimit& limit) {
    const Step inside = step_inside(image, limit.side);
    if (limit.side == 1 && inside.squared > related * unrelated_step(image)) return false;
    const Step at_periods = step_at_periods(image, period, limit.side);
    const Step strangers = step_of_strangers(image, limit.side);
    const Step border = step_between(image, image.length() - limit.side, 0, limit.side);
    const auto is_usual = [&](double Step::*mean) {
      const double usual = std::max(inside.*mean, at_periods.*mean);
      return border.*mean <=
             usual + std::max(limit.excess * usual, limit.share * (strangers.*mean - inside.*mean));
    };
    // Of large squares there are too few for the second mean to say much.
    return is_usual(&Step::squared) && (limit.side > 2 || is_usual(&Step::rooted));
  });
}

} // namespace

SampleWrap detect_wrap(const FeatureImage& image, const Periodicity& periods) {
  if (image.width < smallest_side || image.height < smallest_side) return {};
  return {wraps({image, false}, periods.x), wraps({image, true}, periods.y)};
}

std::vector<SampleMap> continued(std::span<const SampleMap> samples, Size to) {
  std::vector<SampleMap> maps;
  for (const SampleMap& map : samples) {
    SampleMap longer = map;
    longer.image = Image(to.width, to.height, map.image.channels());
    for (int y = 0; y < to.height; ++y) {
      const auto from = map.image.row(y % map.image.height());
      const auto row = longer.image.row(y);
      for (std::size_t at = 0; at < row.size(); at += from.size())
        std::copy_n(from.begin(), std::min(from.size(), row.size() - at),
                    row.begin() + static_cast<std::ptrdiff_t>(at));
    }
    maps.push_back(std::move(longer));
  }
  return maps;
}

} // namespace tilepack
