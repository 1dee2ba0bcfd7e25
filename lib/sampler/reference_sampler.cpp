#include "tilepack/sampler/reference_sampler.h"

#include "tilepack/sampler/texel_sums.h"

#include <cassert>

namespace tilepack {
namespace {

void add_taps(TexelSums& sums, const PackTexels::Taps& taps, double weight, bool alpha) {
  for (int i = 0; i < taps.count; ++i) {
    const PackTexels::Tap& tap = taps.taps[static_cast<std::size_t>(i)];
    sums.add(tap.texel, weight * tap.weight, alpha);
  }
}

void add_level(TexelSums& sums, const PackTexels& texels, const CornerTexels* corners, const TilePoint& point,
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
  assert(out.size() == static_cast<std::size_t>(texels.channels()) && out.size() <= TexelSums::max_channels);
  TexelSums sums;
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
