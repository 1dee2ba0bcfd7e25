#include "tilepack/exemplar/sample_wrap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tilepack {
namespace {

constexpr int smallest_side = 16;
constexpr int inside_places = 256; // at which the step inside is measured, evenly spread

struct SquareLimit {
  int side;     // texels
  double share; // of the step inside
};
constexpr std::array limits_of_squares{SquareLimit{1, 1.18}, SquareLimit{2, 1.12}, SquareLimit{4, 1.45}};

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

// The mean of what squares of `side` texels on both sides of a place differ by, squared, in units that are the same
// at all places: the second square begins at `place`, which may be 0.
double step_at(const Turned& image, int place, int side) {
  const int channels = image.image.channels - image.image.guides;
  std::int64_t sum = 0;
  for (int j = 0; j + side <= image.across(); j += side)
    for (int c = 0; c < channels; ++c) {
      int difference = 0;
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
          difference += image.texel(place + x, j + y)[c] -
                        image.texel((place + image.length() - side + x) % image.length(), j + y)[c];
      sum += static_cast<std::int64_t>(difference) * difference;
    }
  return std::sqrt(static_cast<double>(sum));
}

// What step_at(image, place, 1) would be on average if no texel had anything to do with its neighbour.
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
  return std::sqrt(2 * variance * image.across());
}

// The mean step at the places that lie whole periods from the border; 0 where the image holds no whole number of them.
double step_at_periods(const Turned& image, const Period& period, int side) {
  const int count = whole_periods(period, image.length());
  if (count < 2) return 0;
  double sum = 0;
  int places = 0;
  for (int k = 1; k < count; ++k) {
    const auto place = static_cast<int>(std::lround(static_cast<double>(k) * image.length() / count));
    if (place < side || place > image.length() - side) continue;
    sum += step_at(image, place, side);
    ++places;
  }
  return places > 0 ? sum / places : 0;
}

bool wraps(const Turned& image, const Period& period) {
  return std::all_of(limits_of_squares.begin(), limits_of_squares.end(), [&](const SquareLimit& limit) {
    const int first = limit.side;
    const int last = image.length() - limit.side;
    const int stride = std::max(1, (last - first) / inside_places);
    double inside = 0;
    int places = 0;
    for (int place = first; place <= last; place += stride, ++places)
      inside += step_at(image, place, limit.side);
    if (limit.side == 1 && inside > related * places * unrelated_step(image)) return false;
    const double usual = std::max(inside / places, step_at_periods(image, period, limit.side));
    return step_at(image, 0, limit.side) <= limit.share * usual;
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
