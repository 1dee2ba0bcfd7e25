#include "tilepack/seam/source_canvas.h"

#include <algorithm>
#include <numeric>

namespace tilepack {

namespace {

SourceTexel clamped(const FeatureImage& image, SourceTexel s) {
  return {std::clamp(s.x, 0, image.width - 1), std::clamp(s.y, 0, image.height - 1)};
}

std::size_t index(const FeatureImage& image, SourceTexel s) {
  return static_cast<std::size_t>(s.y) * static_cast<std::size_t>(image.width) +
         static_cast<std::size_t>(s.x);
}

} // namespace

std::int64_t seam_cost(const FeatureImage& image, SourceTexel p_source, SourceTexel q_source, int dx,
                       int dy) {
  if (q_source.x == p_source.x + dx && q_source.y == p_source.y + dy) return 0;
  const SourceTexel p_beyond = clamped(image, {q_source.x - dx, q_source.y - dy});
  const SourceTexel q_beyond = clamped(image, {p_source.x + dx, p_source.y + dy});
  const std::size_t p = index(image, p_source), q = index(image, q_source);
  const std::size_t p_other = index(image, p_beyond), q_other = index(image, q_beyond);
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::uint8_t* values = image.values.data();
  std::int64_t difference =
      squared_difference(values + p * channels, values + p_other * channels, image.channels) +
      squared_difference(values + q * channels, values + q_other * channels, image.channels);
  if (!image.sensitivity.empty()) {
    const auto& s = image.sensitivity;
    difference = difference * (s[p] + s[q] + s[p_other] + s[q_other]) / (4 * sensitivity_unit);
  }
  if (image.flat_seam == 0) return difference;
  const std::uint8_t* last = values + channels - 1;
  const std::int64_t flat =
      last[p * channels] + last[q * channels] + last[p_other * channels] + last[q_other * channels];
  return difference + image.flat_seam * flat / (4 * 255);
}

void seams_by_rows(const FeatureImage& image, const SourceCanvas& canvas,
                   const std::function<void(int, const std::vector<std::int64_t>&)>& visit) {
  const auto w = static_cast<std::size_t>(canvas.width);
  std::vector<std::int64_t> own(w), below(w);
  for (int y = 0; y < canvas.height; ++y) {
    const SourceTexel* row = canvas.texels.data() + canvas.index(0, y);
    for (std::size_t x = 0; x < w; ++x) {
      if (x + 1 < w) {
        const std::int64_t cost = seam_cost(image, row[x], row[x + 1], 1, 0);
        own[x] += cost;
        own[x + 1] += cost;
      }
      if (y + 1 < canvas.height) {
        const std::int64_t cost = seam_cost(image, row[x], row[x + w], 0, 1);
        own[x] += cost;
        below[x] += cost;
      }
    }
    visit(y, own);
    own.swap(below);
    std::fill(below.begin(), below.end(), 0);
  }
}

std::vector<std::int64_t> seams_at_texels(const FeatureImage& image, const SourceCanvas& canvas) {
  std::vector<std::int64_t> shares;
  shares.reserve(canvas.texels.size());
  seams_by_rows(image, canvas, [&](int, const std::vector<std::int64_t>& row) {
    shares.insert(shares.end(), row.begin(), row.end());
  });
  return shares;
}

std::int64_t seam_energy(const FeatureImage& image, const SourceCanvas& canvas) {
  std::int64_t twice = 0; // each seam is shared by two texels
  seams_by_rows(image, canvas, [&](int, const std::vector<std::int64_t>& row) {
    twice = std::accumulate(row.begin(), row.end(), twice);
  });
  return twice / 2;
}

} // namespace tilepack
