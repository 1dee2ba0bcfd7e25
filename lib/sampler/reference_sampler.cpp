#include "tilepack/sampler/reference_sampler.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace tilepack {
namespace {

constexpr std::size_t max_channels = 4;

// Sums of weighted texels. With alpha, colors are summed weighed by it (`weighed`) and plainly (`plain`), for
// the case that no texel has any.
struct Sums {
  std::array<double, max_channels> weighed{};
  std::array<double, max_channels> plain{};

  void add(std::span<const float> texel, double weight, bool alpha) {
    const double coverage = alpha ? static_cast<double>(texel.back()) : 1.0;
    for (std::size_t c = 0; c < texel.size(); ++c) {
      plain[c] += weight * static_cast<double>(texel[c]);
      weighed[c] += weight * coverage * static_cast<double>(texel[c]);
    }
  }

  void resolve(std::span<double> out, bool alpha) const {
    const double coverage = alpha ? plain[out.size() - 1] : 1.0;
    for (std::size_t c = 0; c < out.size(); ++c)
      out[c] = alpha && coverage != 0.0 ? weighed[c] / coverage : plain[c];
    if (alpha) out.back() = coverage;
  }
};

void add_level(Sums& sums, const PackTexels& texels, PackTexels::Place place, double fraction_x,
               double fraction_y, int level, double weight, Filter filter) {
  const Size tile = texels.tile_size(level);
  const bool alpha = texels.has_alpha();
  if (filter == Filter::nearest) {
    sums.add(texels.texel(level, place, nearest_texel(fraction_x, tile.width),
                          nearest_texel(fraction_y, tile.height)),
             weight, alpha);
    return;
  }
  const Taps x = bilinear_taps(fraction_x, tile.width);
  const Taps y = bilinear_taps(fraction_y, tile.height);
  // A texel of weight 0 is not read: what lies there, infinity included, must not show.
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const double w = weight * (i == 0 ? 1.0 - x.weight : x.weight) * (j == 0 ? 1.0 - y.weight : y.weight);
      if (w != 0.0) sums.add(texels.texel(level, place, x.first + i, y.first + j), w, alpha);
    }
}

} // namespace

void sample_tile(const PackTexels& texels, PackTexels::Place place, double fraction_x, double fraction_y,
                 const LevelBlend& levels, Filter filter, std::span<double> out) {
  assert(out.size() == static_cast<std::size_t>(texels.channels()) && out.size() <= max_channels);
  Sums sums;
  add_level(sums, texels, place, fraction_x, fraction_y, levels.fine, 1.0 - levels.coarse_weight, filter);
  if (levels.coarse_weight > 0.0)
    add_level(sums, texels, place, fraction_x, fraction_y, levels.coarse, levels.coarse_weight, filter);
  sums.resolve(out, texels.has_alpha());
}

void ReferenceSampler::sample(TileCoordinate x, TileCoordinate y, double level, Filter filter,
                              std::span<double> out) const {
  const TileCoordinate east = normalised(x);
  const TileCoordinate south = normalised(y);
  sample_tile(texels, texels.place(east.tile, south.tile), east.fraction, south.fraction,
              level_blend(level, texels.levels(), filter), filter, out);
}

} // namespace tilepack
