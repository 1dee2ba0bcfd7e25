#include "tilepack/match/patch_search.h"

#include <opencv2/core.hpp>

#include <limits>

namespace tilepack {

Overlap::Overlap(int patch_width, int patch_height, int channel_count)
    : width(patch_width), height(patch_height), channels(channel_count),
      weight(static_cast<std::size_t>(patch_width) * static_cast<std::size_t>(patch_height)),
      weighted(weight.size() * static_cast<std::size_t>(channel_count)) {}

void Overlap::add(int x, int y, const std::uint8_t* texel, int texel_weight) {
  const std::size_t i =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  weight[i] += texel_weight;
  for (int c = 0; c < channels; ++c) {
    const int value = texel[c];
    weighted[i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)] += texel_weight * value;
    constant += static_cast<std::int64_t>(texel_weight) * value * value;
  }
}

struct PatchSearch::Spectra {
  int width = 0;
  int height = 0;
  int channels = 0;
  int rows = 0; // of the padded transform
  int columns = 0;
  std::vector<cv::Mat> channel; // of the image, one a channel
  cv::Mat squares;              // of the sum over channels of squares
};

namespace {

cv::Mat forward(cv::Mat& plane, int nonzero_rows) {
  cv::dft(plane, plane, 0, nonzero_rows);
  return plane;
}

// Exact for |v| < 2^51: adding 1.5 * 2^52 leaves no room for a fraction, so the sum is rounded to an integer.
std::int64_t nearest_integer(double v) {
  constexpr double shift = 6755399441055744.0;
  return static_cast<std::int64_t>((v + shift) - shift);
}

} // namespace

PatchSearch::PatchSearch(const FeatureImage& image) : spectra(std::make_unique<Spectra>()) {
  Spectra& s = *spectra;
  s.width = image.width;
  s.height = image.height;
  s.channels = image.channels;
  s.rows = cv::getOptimalDFTSize(image.height);
  s.columns = cv::getOptimalDFTSize(image.width);
  for (int c = -1; c < image.channels; ++c) {
    cv::Mat plane(s.rows, s.columns, CV_64F, cv::Scalar(0));
    for (int y = 0; y < image.height; ++y) {
      double* row = plane.ptr<double>(y);
      for (int x = 0; x < image.width; ++x) {
        const std::uint8_t* texel = image.texel(x, y);
        if (c >= 0) {
          row[x] = texel[c];
        } else {
          int sum = 0;
          for (int i = 0; i < image.channels; ++i) sum += texel[i] * texel[i];
          row[x] = sum;
        }
      }
    }
    forward(plane, image.height);
    (c >= 0 ? s.channel.emplace_back() : s.squares) = plane;
  }
}

PatchSearch::~PatchSearch() = default;

PositionMap PatchSearch::mismatches(const Overlap& overlap) const {
  const Spectra& s = *spectra;
  // sum w |S - v|² = (S² ⋆ w) - 2 sum over channels (S ⋆ w v) + constant, ⋆ a correlation. Positions at which
  // the patch would wrap round the padded image are not read.
  cv::Mat total(s.rows, s.columns, CV_64F, cv::Scalar(0));
  cv::Mat plane(s.rows, s.columns, CV_64F);
  cv::Mat product;
  for (int c = -1; c < s.channels; ++c) {
    plane.setTo(0);
    std::size_t i = 0;
    for (int y = 0; y < overlap.height; ++y) {
      double* row = plane.ptr<double>(y);
      for (int x = 0; x < overlap.width; ++x, ++i)
        row[x] = c < 0 ? overlap.weight[i]
                       : -2.0 * overlap.weighted[i * static_cast<std::size_t>(s.channels) +
                                                 static_cast<std::size_t>(c)];
    }
    forward(plane, overlap.height);
    const cv::Mat& image = c < 0 ? s.squares : s.channel[static_cast<std::size_t>(c)];
    cv::mulSpectrums(image, plane, product, 0, true);
    total += product;
  }
  PositionMap map{s.width - overlap.width + 1, s.height - overlap.height + 1, {}};
  cv::dft(total, total, cv::DFT_INVERSE | cv::DFT_SCALE, map.height);
  map.values.resize(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
  std::size_t i = 0;
  for (int y = 0; y < map.height; ++y) {
    const double* row = total.ptr<double>(y);
    for (int x = 0; x < map.width; ++x) map.values[i++] = nearest_integer(row[x]) + overlap.constant;
  }
  return map;
}

std::int64_t mismatch_at(const FeatureImage& image, const Overlap& overlap, SourceTexel position) {
  std::int64_t sum = overlap.constant;
  std::size_t i = 0;
  for (int y = 0; y < overlap.height; ++y)
    for (int x = 0; x < overlap.width; ++x, ++i) {
      if (overlap.weight[i] == 0) continue;
      const std::uint8_t* texel = image.texel(position.x + x, position.y + y);
      for (int c = 0; c < overlap.channels; ++c) {
        const int value = texel[c];
        const std::size_t j = i * static_cast<std::size_t>(overlap.channels) + static_cast<std::size_t>(c);
        sum += static_cast<std::int64_t>(value) * (overlap.weight[i] * value - 2 * overlap.weighted[j]);
      }
    }
  return sum;
}

SourceTexel best_near(const FeatureImage& image, const Overlap& overlap, SourceTexel start, int distance) {
  std::int64_t best = std::numeric_limits<std::int64_t>::max();
  SourceTexel place;
  for (int dy = -distance; dy <= distance; ++dy)
    for (int dx = -distance; dx <= distance; ++dx) {
      const SourceTexel at{std::clamp(start.x + dx, 0, image.width - overlap.width),
                           std::clamp(start.y + dy, 0, image.height - overlap.height)};
      const std::int64_t mismatch = mismatch_at(image, overlap, at);
      if (mismatch < best) {
        best = mismatch;
        place = at;
      }
    }
  return place;
}

} // namespace tilepack
