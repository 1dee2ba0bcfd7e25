#include "tilepack/sampler/render.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/place_tiles.h"
#include "tilepack/numeric/exact_math.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/pack/pack_maps.h"
#include "tilepack/sampler/reference_sampler.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace tilepack {
namespace {

int output_side(int texels, double scale, const char* way) {
  const double side = std::max(1.0, std::floor(texels * scale + 0.5));
  if (side > max_render_side)
    throw Error(ErrorKind::usage, "",
                "the picture would be " + std::to_string(static_cast<std::int64_t>(std::min(side, 1e18))) +
                    " pixels " + way + "; at most " + std::to_string(max_render_side) +
                    " are: take a smaller " + field("rect") + " or " + field("scale") + ", or a coarser " +
                    field("level"));
  return static_cast<int>(side);
}

const PackedMap& map_of(const Pack& pack, int map, int level) {
  const PackedMap& result = map_at(pack, map);
  if (!is_far(result, level)) level_at(result, level);
  return result;
}

// The place of a pixel, `offset` texels of the view's level from texel `first` of it. Texels of far levels are 2^n of the last
// level of tiles, which is the last that has whole ones a tile.
TileCoordinate place_of_pixel(std::int64_t first, double offset, int tile_side, int far_steps) {
  const std::int64_t texel = wrapped(first, static_cast<std::int64_t>(tile_side));
  return normalised({((first - texel) / tile_side) << far_steps,
                     std::ldexp(static_cast<double>(texel) + offset, far_steps) / tile_side});
}

// A pixel steps 1 / scale texels of the level, which are 2^level of the finest.
FootprintEllipse covered_by_pixel(const View& view, Size tile) {
  const double step = std::ldexp(1.0 / view.scale, view.level);
  return ellipse_of({step / tile.width, 0, 0, step / tile.height}, tile);
}

// Texels of `level` are 1 / scale pixels wide; a level up doubles them.
LevelBlend levels_for(const View& view, const PackedMap& map, const FootprintEllipse& pixel) {
  const auto of_tiles = static_cast<int>(map.levels.size());
  const int of_chain = of_tiles + static_cast<int>(map.far_levels.size());
  if (view.elliptical) return level_blend(level_of(pixel), of_tiles, Filter::trilinear);
  if (view.filter != Filter::trilinear)
    return level_blend(view.level, view.filter == Filter::nearest ? of_tiles : of_chain, view.filter);
  return level_blend(view.level - exact_log2(view.scale), of_chain, view.filter);
}

} // namespace

Size output_size(const View& view) {
  if (view.rect.width < 1 || view.rect.height < 1)
    throw Error(ErrorKind::usage, field("rect"),
                std::to_string(view.rect.width) + " x " + std::to_string(view.rect.height) +
                    " texels; both sides must be at least 1");
  if (!(view.scale > 0) || !std::isfinite(view.scale))
    throw Error(ErrorKind::usage, field("scale"),
                std::to_string(view.scale) + "; it must be a number above 0 (1: a pixel a texel)");
  return {output_side(view.rect.width, view.scale, "wide"),
          output_side(view.rect.height, view.scale, "high")};
}

Renderer::Renderer(const Pack& of_pack, int map_index, const View& of_view, const RenderTarget& of_target)
    : pack(&of_pack), map(&map_of(of_pack, map_index, of_view.level)), view(of_view), target(of_target),
      picture(output_size(of_view)), pixel(covered_by_pixel(of_view, of_pack.tile_size)),
      levels(levels_for(of_view, *map, pixel)),
      texels(of_pack, map_index, levels.fine, levels.coarse), edge{of_pack.mapping.size, of_view.border} {
  if (copies_texels()) {
    Image level = map->levels[static_cast<std::size_t>(view.level)];
    if (target.encoding != map->encoding)
      level = from_linear(to_linear(level, map->encoding), target.encoding);
    stored = tiles_at_level(level, pack->layout, pack->tile_size, view.level);
    for (Image& tile : stored) tile = quantised(tile, target.depth);
    return;
  }
  if (pack->corner_pack && view.corner_width > 0)
    corners.emplace(*pack, map_index, view.corner_width, levels.fine, levels.coarse);
  columns.resize(static_cast<std::size_t>(picture.width));
  for (int i = 0; i < picture.width; ++i)
    columns[static_cast<std::size_t>(i)] =
        within(place_of_pixel(view.rect.x, (i + 0.5) / view.scale, texels.tile_size(last_of_tiles()).width,
                              far_steps()),
               pack->mapping.size.width, view.border);
}

bool Renderer::copies_texels() const {
  return view.scale == 1.0 && !view.elliptical && !is_far(*map, view.level);
}

int Renderer::last_of_tiles() const {
  return std::min(view.level, texels.levels() - 1);
}

int Renderer::far_steps() const {
  return view.level - last_of_tiles();
}

Image Renderer::rows(int first, int count) const {
  if (copies_texels())
    return virtual_texture(*pack, stored, {view.rect.x, view.rect.y + first, picture.width, count},
                           view.border);
  Image band(picture.width, count, channels());
  tbb::parallel_for(0, count, [&](int row) { render_row(first + row, band.row(row)); });
  return band;
}

void Renderer::render_row(int row, std::span<float> out) const {
  const TileCoordinate y = within(place_of_pixel(view.rect.y, (row + 0.5) / view.scale,
                                                 texels.tile_size(last_of_tiles()).height, far_steps()),
                                  edge.size.height, view.border);
  const auto channel_count = static_cast<std::size_t>(channels());
  const bool renormal =
      value_space(*map).has_vectors() && (view.elliptical || view.filter != Filter::nearest);
  const TileReader reader{texels, corners ? &*corners : nullptr, edge};
  std::array<double, 4> buffer{};
  const std::span<double> value(buffer.data(), channel_count);

  // The tile is found once a cell, not once a pixel: columns run from west to east.
  TilePoint point;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const TileCoordinate& x = columns[i];
    if (i == 0 || x.tile != columns[i - 1].tile)
      point = {x.tile, y.tile, texels.place(x.tile, y.tile), 0, y.fraction};
    point.x = x.fraction;
    if (view.elliptical)
      reader.sample(point, levels, pixel, value);
    else
      reader.sample(point, levels, view.filter, value);
    if (renormal) renormalise(value);
    store_pixel(value, target, out.subspan(i * channel_count, channel_count));
  }
}

} // namespace tilepack
