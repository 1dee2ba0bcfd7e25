#include "tilepack/match/patch_search.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
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
  struct Part {
    Rect area;    // of the image
    int rows = 0; // of the padded transform
    int columns = 0;
    std::vector<cv::Mat> channel; // one a channel
    cv::Mat squares;              // of the sum over channels of squares
  };
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<Part> parts;
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

// The whole image, or the middles of its quarters.
std::vector<Rect> searched_parts(const FeatureImage& image, Size largest_patch, std::int64_t most_texels) {
  const double texels = static_cast<double>(image.width) * image.height;
  if (texels <= static_cast<double>(most_texels)) return {{0, 0, image.width, image.height}};
  const double share = std::sqrt(static_cast<double>(most_texels) / 4.0 / texels);
  const auto side = [&](int whole, int patch) {
    return std::min(whole, std::max(static_cast<int>(whole * share), 2 * patch));
  };
  const int w = side(image.width, largest_patch.width);
  const int h = side(image.height, largest_patch.height);
  std::vector<Rect> parts;
  for (const int y : {1, 3})
    for (const int x : {1, 3})
      parts.push_back({std::clamp(x * image.width / 4 - w / 2, 0, image.width - w),
                       std::clamp(y * image.height / 4 - h / 2, 0, image.height - h), w, h});
  return parts;
}

} // namespace

PatchSearch::PatchSearch(const FeatureImage& image, Size largest_patch, std::int64_t most_texels)
    : spectra(std::make_unique<Spectra>()) {
  Spectra& s = *spectra;
  s.width = image.width;
  s.height = image.height;
  s.channels = image.channels;
  for (const Rect& area : searched_parts(image, largest_patch, most_texels)) {
    Spectra::Part& part = s.parts.emplace_back();
    part.area = area;
    part.rows = cv::getOptimalDFTSize(area.height);
    part.columns = cv::getOptimalDFTSize(area.width);
    for (int c = -1; c < image.channels; ++c) {
      cv::Mat plane(part.rows, part.columns, CV_64F, cv::Scalar(0));
      for (int y = 0; y < area.height; ++y) {
        double* row = plane.ptr<double>(y);
        for (int x = 0; x < area.width; ++x) {
          const std::uint8_t* texel = image.texel(area.x + x, area.y + y);
          if (c >= 0) {
            row[x] = texel[c];
          } else {
            int sum = 0;
            for (int i = 0; i < image.channels; ++i) sum += texel[i] * texel[i];
            row[x] = sum;
          }
        }
      }
      forward(plane, area.height);
      (c >= 0 ? part.channel.emplace_back() : part.squares) = plane;
    }
  }
}

PatchSearch::~PatchSearch() = default;

PositionMap PatchSearch::mismatches(const Overlap& overlap) const {
  const Spectra& s = *spectra;
  PositionMap map{s.width - overlap.width + 1, s.height - overlap.height + 1, {}};
  map.values.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height), ruled_out);
  for (const Spectra::Part& part : s.parts) {
    // sum w |S - v|² = (S² ⋆ w) - 2 sum over channels (S ⋆ w v) + constant, ⋆ a correlation. Positions at
    // which the patch would wrap round the padded image are not read.
    cv::Mat total(part.rows, part.columns, CV_64F, cv::Scalar(0));
    cv::Mat plane(part.rows, part.columns, CV_64F);
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
      const cv::Mat& image = c < 0 ? part.squares : part.channel[static_cast<std::size_t>(c)];
      cv::mulSpectrums(image, plane, product, 0, true);
      total += product;
    }
    const int high = part.area.height - overlap.height + 1;
    const int wide = part.area.width - overlap.width + 1;
    cv::dft(total, total, cv::DFT_INVERSE | cv::DFT_SCALE, high);
    for (int y = 0; y < high; ++y) {
      const double* row = total.ptr<double>(y);
      std::int64_t* values = map.values.data() +
                             static_cast<std::size_t>(part.area.y + y) * static_cast<std::size_t>(map.width) +
                             static_cast<std::size_t>(part.area.x);
      for (int x = 0; x < wide; ++x) values[x] = nearest_integer(row[x]) + overlap.constant;
    }
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
