#include "tilepack/sampler/reference_sampler.h"

#include "tilepack/tileset/value_space.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tilepack {
namespace {

void add_taps(ValueSums& sums, const PackTexels::Taps& taps, double weight, bool alpha) {
  for (int i = 0; i < taps.count; ++i) {
    const PackTexels::Tap& tap = taps.taps[static_cast<std::size_t>(i)];
    sums.add(tap.texel, weight * tap.weight, alpha);
  }
}

// A filter that reads two texels along an axis stays in the tile of a point this far from its borders.
double kept_from_border(double fraction, int side, bool at_first, bool at_last) {
  if (at_first && fraction * side < 0.5) {
    double centre = 0.5 / side;
    while (centre * side < 0.5) centre = std::nextafter(centre, 1.0); // divided and multiplied, it may be off
    return centre;
  }
  if (at_last && fraction * side > side - 0.5) {
    double centre = (side - 0.5) / side;
    while (centre * side > side - 0.5) centre = std::nextafter(centre, 0.0);
    return centre;
  }
  return fraction;
}

// Beyond a border that doesn't wrap, bilinear filtering between a texel and its like beyond the border gives
// that texel, be it clamped or mirrored: so does the texel's centre.
TilePoint kept_inside(const TilePoint& point, const VirtualEdge& edge, Size tile) {
  if (edge.border == WrapMode::wrap) return point;
  TilePoint kept = point;
  kept.x = kept_from_border(point.x, tile.width, point.cell_x == 0, point.cell_x == edge.size.width - 1);
  kept.y = kept_from_border(point.y, tile.height, point.cell_y == 0, point.cell_y == edge.size.height - 1);
  return kept;
}

// Texel `texel` counted from the border of a cell, brought back into a virtual texture that doesn't wrap.
int brought_back(int texel, std::int64_t cell, int side, std::int64_t tiles, WrapMode border) {
  if (border == WrapMode::wrap) return texel;
  const std::int64_t index = cell * side + texel;
  return texel + static_cast<int>(within(index, tiles * side, border) - index);
}

// What an ellipse round a point covers in one level.
struct Covered {
  const VirtualEdge& edge;
  const TilePoint& point;
  const FootprintEllipse& ellipse;
  int level = 0;

  // Adds the texels of the tile at `place`, weights adding up to `weight`.
  void add_to(ValueSums& sums, const PackTexels& texels, PackTexels::Place place, double weight) const {
    const Size tile = texels.tile_size(level);
    const EllipseTexels covered(ellipse, level);
    const double x = point.x * tile.width;
    const double y = point.y * tile.height;
    double total = 0;
    covered.each(x, y, [&](int, int, double share) { total += share; });
    covered.each(x, y, [&](int i, int j, double share) {
      const int column = brought_back(i, point.cell_x, tile.width, edge.size.width, edge.border);
      const int row = brought_back(j, point.cell_y, tile.height, edge.size.height, edge.border);
      add_taps(sums, texels.texel_taps(level, place, column, row), weight * share / total,
               texels.has_alpha());
    });
  }
};

// add(texels, place, share) for the pack and, near a corner, the corner pack.
template <typename Add>
void with_corners(const PackTexels& texels, const CornerTexels* corners, const TilePoint& point, int level,
                  Add&& add) {
  const double corner = corners ? corners->weight(level, point.x, point.y) : 0.0;
  if (corner < 1.0) add(texels, point.place, 1.0 - corner);
  if (corner > 0.0)
    add(corners->pack_texels(), corners->place(point.cell_x, point.cell_y, point.x, point.y), corner);
}

template <typename AddLevel>
void blend_levels(const PackTexels& texels, const LevelBlend& levels, std::span<double> out,
                  AddLevel&& add_level) {
  assert(out.size() == static_cast<std::size_t>(texels.channels()) && out.size() <= ValueSums::max_channels);
  ValueSums sums;
  add_level(sums, levels.fine, 1.0 - levels.coarse_weight);
  if (levels.coarse_weight > 0.0) add_level(sums, levels.coarse, levels.coarse_weight);
  sums.resolve(out, texels.has_alpha());
}

} // namespace

void TileReader::sample(const TilePoint& point, const LevelBlend& levels, Filter filter,
                        std::span<double> out) const {
  blend_levels(texels, levels, out, [&](ValueSums& sums, int level, double weight) {
    const Size tile = texels.tile_size(std::min(level, texels.levels() - 1)); // far levels: as the last
    const TilePoint at = filter == Filter::nearest ? point : kept_inside(point, edge, tile);
    with_corners(
        texels, corners, at, level, [&](const PackTexels& from, PackTexels::Place place, double share) {
          add_taps(sums, from.taps(level, place, at.x, at.y, filter), weight * share, texels.has_alpha());
        });
  });
}

void TileReader::sample(const TilePoint& point, const LevelBlend& levels, const FootprintEllipse& ellipse,
                        std::span<double> out) const {
  blend_levels(texels, levels, out, [&](ValueSums& sums, int level, double weight) {
    const Covered covered{edge, point, ellipse, level};
    with_corners(texels, corners, point, level,
                 [&](const PackTexels& from, PackTexels::Place place, double share) {
                   covered.add_to(sums, from, place, weight * share);
                 });
  });
}

ReferenceSampler::ReferenceSampler(const Pack& pack, int map, double corner_width, WrapMode border)
    : texels(pack, map), edge{pack.mapping.size, border} {
  if (pack.corner_pack && corner_width > 0) corners.emplace(pack, map, corner_width);
}

TilePoint ReferenceSampler::point_at(TileCoordinate x, TileCoordinate y) const {
  const TileCoordinate east = within(x, edge.size.width, edge.border);
  const TileCoordinate south = within(y, edge.size.height, edge.border);
  return {east.tile, south.tile, texels.place(east.tile, south.tile), east.fraction, south.fraction};
}

void ReferenceSampler::sample(TileCoordinate x, TileCoordinate y, double level, Filter filter,
                              std::span<double> out) const {
  const int levels = filter == Filter::nearest ? texels.levels() : texels.chain_levels();
  reader().sample(point_at(x, y), level_blend(level, levels, filter), filter, out);
}

void ReferenceSampler::sample(TileCoordinate x, TileCoordinate y, const Footprint& footprint,
                              std::span<double> out) const {
  const FootprintEllipse ellipse = ellipse_of(footprint, texels.tile_size(0));
  reader().sample(point_at(x, y), level_blend(level_of(ellipse), texels.levels(), Filter::trilinear), ellipse,
                  out);
}

} // namespace tilepack
