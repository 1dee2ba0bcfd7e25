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

void add_taps(Sums& sums, const PackTexels::Taps& taps, double weight, bool alpha) {
  for (int i = 0; i < taps.count; ++i) {
    const PackTexels::Tap& tap = taps.taps[static_cast<std::size_t>(i)];
    sums.add(tap.texel, weight * tap.weight, alpha);
  }
}

void add_level(Sums& sums, const PackTexels& texels, const CornerTexels* corners, const TilePoint& point,
               int level, double weight, Filter filter) {
  const double corner = corners ? corners->weight(level, point.x, point.y) : 0.0;
  if (corner < 1.0)
    add_taps(sums, texels.taps(level, point.place, point.x, point.y, filter), weight * (1.0 - corner),
             texels.has_alpha());
  if (corner > 0.0)
    add_taps(sums,
             corners->taps(level, corners->place(point.cell_x, point.cell_y, point.x, point.y), point.x,
                           point.y, filter),
             weight * corner, texels.has_alpha());
}

} // namespace

void sample_tile(const PackTexels& texels, const CornerTexels* corners, const TilePoint& point,
                 const LevelBlend& levels, Filter filter, std::span<double> out) {
  assert(out.size() == static_cast<std::size_t>(texels.channels()) && out.size() <= max_channels);
  Sums sums;
  add_level(sums, texels, corners, point, levels.fine, 1.0 - levels.coarse_weight, filter);
  if (levels.coarse_weight > 0.0)
    add_level(sums, texels, corners, point, levels.coarse, levels.coarse_weight, filter);
  sums.resolve(out, texels.has_alpha());
}

void ReferenceSampler::sample(TileCoordinate x, TileCoordinate y, double level, Filter filter,
                              std::span<double> out) const {
  const TileCoordinate east = normalised(x);
  const TileCoordinate south = normalised(y);
  sample_tile(texels, corners ? &*corners : nullptr,
              {east.tile, south.tile, texels.place(east.tile, south.tile), east.fraction, south.fraction},
              level_blend(level, texels.levels(), filter), filter, out);
}

} // namespace tilepack
