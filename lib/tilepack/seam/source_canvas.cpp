#include "tilepack/seam/source_canvas.h"

#include <algorithm>

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

namespace {

// visit(index of p, index of q, cost) for all pairs of neighbours.
template <typename Visit>
void for_each_pair(const FeatureImage& image, const SourceCanvas& canvas, Visit&& visit) {
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x) {
      const std::size_t p = canvas.index(x, y);
      if (x + 1 < canvas.width)
        visit(p, p + 1, seam_cost(image, canvas.texels[p], canvas.texels[p + 1], 1, 0));
      if (y + 1 < canvas.height) {
        const std::size_t q = canvas.index(x, y + 1);
        visit(p, q, seam_cost(image, canvas.texels[p], canvas.texels[q], 0, 1));
      }
    }
}

} // namespace

std::int64_t seam_energy(const FeatureImage& image, const SourceCanvas& canvas) {
  std::int64_t sum = 0;
  for_each_pair(image, canvas, [&](std::size_t, std::size_t, std::int64_t cost) { sum += cost; });
  return sum;
}

std::vector<std::int64_t> seams_at_texels(const FeatureImage& image, const SourceCanvas& canvas) {
  std::vector<std::int64_t> costs(canvas.texels.size());
  for_each_pair(image, canvas, [&](std::size_t p, std::size_t q, std::int64_t cost) {
    costs[p] += cost;
    costs[q] += cost;
  });
  return costs;
}

} // namespace tilepack
