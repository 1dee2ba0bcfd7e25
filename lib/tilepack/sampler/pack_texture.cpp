#include "tilepack/sampler/pack_texture.h"

#include "tilepack/error/error.h"
#include "tilepack/numeric/exact_math.h"
#include "tilepack/tileset/value_space.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

constexpr int most_probes = 16;
constexpr double fade_levels = 2;

// The mean of the coarsest level.
std::array<double, 4> mean_of(const Pack& pack, int map) {
  const int level = static_cast<int>(pack.maps[static_cast<std::size_t>(map)].levels.size()) - 1;
  const PackTexels texels(pack, map, level, level);
  const Size tile = texels.tile_size(level);
  const int width = tile.width * pack.layout.columns, height = tile.height * pack.layout.rows;
  ValueSums sums;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) sums.add(texels.texel(level, {0, 0}, x, y), 1.0, texels.has_alpha());
  std::array<double, 4> mean{};
  sums.resolve({mean.data(), static_cast<std::size_t>(texels.channels())}, texels.has_alpha(),
               static_cast<double>(width) * height);
  return mean;
}

} // namespace

ViewFilter view_filter_of(const std::string& name) {
  return enum_called<ViewFilter>(name, field("filter"), "filter of camera views");
}

Probes probes_for(const Footprint& footprint, Size tile, ViewFilter filter) {
  const FootprintEllipse covered = ellipse_of(footprint, tile);
  if (filter == ViewFilter::ewa) return {1, level_of(covered), 0, 0};
  Probes probes;
  if (!(covered.major > 1)) return probes; // magnified: level 0
  if (filter == ViewFilter::anisotropic) {
    const double ratio = covered.major / std::max(covered.minor, 1.0);
    probes.count = static_cast<int>(std::clamp(std::ceil(ratio), 1.0, static_cast<double>(most_probes)));
    probes.u_axis = covered.x * covered.major / tile.width;
    probes.v_axis = covered.y * covered.major / tile.height;
    // Not major / count, which jumps where one more probe is taken: rings that swim as the camera moves.
    const double finest = std::max(covered.minor, covered.major / most_probes);
    probes.level = std::max(0.0, exact_log2(finest));
    return probes;
  }
  probes.level = std::max(0.0, exact_log2(covered.major));
  return probes;
}

PackTexture::PackTexture(const Pack& pack, int map, ViewFilter of_filter, WrapMode border)
    : sampler(pack, map, default_corner_width, border), filter(of_filter), tile(pack.tile_size),
      space(value_space(pack.maps[static_cast<std::size_t>(map)])), mean(mean_of(pack, map)) {}

void PackTexture::sample(TileCoordinate u, TileCoordinate v, const Footprint& footprint,
                         std::span<double> out) const {
  const Probes probes = probes_for(footprint, tile, filter);
  const bool reads_far = sampler.chain_levels() > sampler.levels() && filter != ViewFilter::ewa;
  const double fade =
      reads_far ? 0.0 : std::clamp((probes.level - (sampler.levels() - 1)) / fade_levels, 0.0, 1.0);
  ValueSums sums;
  if (fade < 1) {
    std::array<double, 4> buffer{};
    const std::span<double> probe(buffer.data(), out.size());
    for (int i = 0; i < probes.count; ++i) {
      const double t = (i + 0.5) / probes.count - 0.5;
      const TileCoordinate x{u.tile, u.fraction + t * probes.u_axis};
      const TileCoordinate y{v.tile, v.fraction + t * probes.v_axis};
      if (filter == ViewFilter::ewa)
        sampler.sample(x, y, footprint, probe);
      else
        sampler.sample(x, y, probes.level, Filter::trilinear, probe);
      sums.add(std::span<const double>(probe), (1 - fade) / probes.count, space.has_alpha());
    }
  }
  if (fade > 0) sums.add(std::span<const double>(mean.data(), out.size()), fade, space.has_alpha());
  sums.resolve(out, space.has_alpha());
  if (space.has_alpha() && !(out.back() > 0)) std::fill(out.begin(), out.end() - 1, 0.0); // clear is black
  if (space.has_vectors()) renormalise(out);
}

} // namespace tilepack
