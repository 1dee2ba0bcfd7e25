#include "tilepack/seam/source_canvas.h"

namespace tilepack {

std::int64_t seam_cost(const FeatureImage& image, SourceTexel p_source, SourceTexel q_source, int dx,
                       int dy) {
  if (q_source.x == p_source.x + dx && q_source.y == p_source.y + dy) return 0;
  const std::uint8_t* p_shown = image.texel(p_source.x, p_source.y);
  const std::uint8_t* q_shown = image.texel(q_source.x, q_source.y);
  const std::uint8_t* p_other = image.clamped_texel(q_source.x - dx, q_source.y - dy);
  const std::uint8_t* q_other = image.clamped_texel(p_source.x + dx, p_source.y + dy);
  const std::int64_t difference = squared_difference(p_shown, p_other, image.channels) +
                                  squared_difference(q_shown, q_other, image.channels);
  if (image.flat_seam == 0) return difference;
  const int last = image.channels - 1;
  const std::int64_t flat = p_shown[last] + q_shown[last] + p_other[last] + q_other[last];
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
