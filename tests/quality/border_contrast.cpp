#include "tilepack/tileset/source_map.h"
#include "border_contrast.h"

#include <algorithm>
#include <cstdlib>

namespace tilepack::quality {
namespace {

struct MeanStep {
  double sum = 0.0;
  double steps = 0.0;

  void add(const FeatureImage& image, const std::uint8_t* a, const std::uint8_t* b) {
    for (int c = 0; c < image.channels; ++c) sum += std::abs(a[c] - b[c]);
    steps += image.channels;
  }
  double mean() const { return sum / std::max(steps, 1.0); }
};

} // namespace

double border_contrast(const FeatureImage& sample, const SourceMap& sources) {
  const int width = sources.tile_size.width;
  const int height = sources.tile_size.height;
  const int depth = std::min(width, height) / 8;
  MeanStep near_borders;
  for (const auto& texels : sources.texels) {
    const auto shown = [&](int x, int y) {
      const SourceTexel from = texels[static_cast<std::size_t>(y * width + x)];
      return sample.texel(from.x, from.y);
    };
    for (int y = 0; y + 1 < height; ++y)
      for (int x = 0; x + 1 < width; ++x) {
        if (std::min({x, y, width - 1 - x, height - 1 - y}) >= depth) continue;
        near_borders.add(sample, shown(x, y), shown(x + 1, y));
        near_borders.add(sample, shown(x, y), shown(x, y + 1));
      }
  }
  MeanStep everywhere;
  for (int y = 0; y + 1 < sample.height; ++y)
    for (int x = 0; x + 1 < sample.width; ++x) {
      everywhere.add(sample, sample.texel(x, y), sample.texel(x + 1, y));
      everywhere.add(sample, sample.texel(x, y), sample.texel(x, y + 1));
    }
  return everywhere.mean() > 0.0 ? near_borders.mean() / everywhere.mean() : 1.0;
}

} // namespace tilepack::quality
