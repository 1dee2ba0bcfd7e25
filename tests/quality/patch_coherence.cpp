#include "patch_coherence.h"

#include "tilepack/numeric/random.h"
#include "tilepack/tileset/source_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tilepack::quality {
namespace {

constexpr int side = 8;

struct Patch {
  std::vector<std::uint8_t> values;  // row by row
  std::vector<SourceTexel> proposed; // where in the sample the patch would begin by each of its texels
};

Patch patch_of(const FeatureImage& sample, const SourceMap& sources, std::size_t tile, int x0, int y0) {
  Patch patch;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const SourceTexel from =
          sources.texels[tile][static_cast<std::size_t>((y0 + y) * sources.tile_size.width + x0 + x)];
      const std::uint8_t* texel = sample.texel(from.x, from.y);
      patch.values.insert(patch.values.end(), texel, texel + sample.channels);
      const SourceTexel start{std::clamp(from.x - x, 0, sample.width - side),
                              std::clamp(from.y - y, 0, sample.height - side)};
      if (std::find(patch.proposed.begin(), patch.proposed.end(), start) == patch.proposed.end())
        patch.proposed.push_back(start);
    }
  return patch;
}

// The sum of squares, or anything not below `limit` once that is reached.
std::int64_t distance(const FeatureImage& sample, const Patch& patch, int x, int y, std::int64_t limit) {
  const int row = side * sample.channels;
  std::int64_t sum = 0;
  for (int j = 0; j < side && sum < limit; ++j) {
    const std::uint8_t* a = sample.texel(x, y + j);
    const std::uint8_t* b = patch.values.data() + j * row;
    int part = 0;
    for (int i = 0; i < row; ++i) {
      const int d = a[i] - b[i];
      part += d * d;
    }
    sum += part;
  }
  return sum;
}

double nearest(const FeatureImage& sample, const Patch& patch) {
  // Good finds first: then nearly all others are given up after a row.
  std::int64_t best = std::numeric_limits<std::int64_t>::max();
  for (const SourceTexel& start : patch.proposed)
    best = std::min(best, distance(sample, patch, start.x, start.y, best));
  for (int y = 0; y + side <= sample.height && best > 0; ++y)
    for (int x = 0; x + side <= sample.width; ++x) best = std::min(best, distance(sample, patch, x, y, best));
  return std::sqrt(static_cast<double>(best) / (side * side * sample.channels));
}

} // namespace

Coherence patch_coherence(const FeatureImage& sample, const SourceMap& sources, int patches,
                          std::uint64_t seed) {
  std::vector<double> distances(static_cast<std::size_t>(patches));
  tbb::parallel_for(std::size_t{0}, distances.size(), [&](std::size_t i) {
    const auto below = [&](const char* what, std::size_t count) {
      return random_below(seed, what, i, static_cast<std::uint32_t>(count));
    };
    const std::size_t tile = below("tile", sources.texels.size());
    const int x = static_cast<int>(below("x", static_cast<std::size_t>(sources.tile_size.width - side + 1)));
    const int y = static_cast<int>(below("y", static_cast<std::size_t>(sources.tile_size.height - side + 1)));
    distances[i] = nearest(sample, patch_of(sample, sources, tile, x, y));
  });
  std::sort(distances.begin(), distances.end());
  return {distances[distances.size() / 2], distances[distances.size() * 19 / 20]};
}

} // namespace tilepack::quality
