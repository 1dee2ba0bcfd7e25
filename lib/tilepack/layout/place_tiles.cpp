#include "tilepack/layout/place_tiles.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/rotated_lattice.h"
#include "tilepack/layout/surroundings.h"
#include "tilepack/numeric/as_size.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/tileset/border_colors.h"
#include "tilepack/tileset/value_space.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace tilepack {
namespace {

constexpr int most_channels = 4;

std::vector<Surroundings> chosen_surroundings(const TileColors& colors, const Layout& layout,
                                              Outside outside) {
  if (outside == Outside::own) return {};
  if (layout.kind == LayoutKind::rotated && layout.rotated.gutter == 0) {
    std::vector<Surroundings> packed = packed_surroundings(layout);
    if (colors_match(colors, packed)) return packed;
  }
  return fitting_surroundings(colors);
}

// What a filter may weigh: linear light, with color multiplied by alpha where there is one. The plain color
// follows in channels of its own, for places where no texel read has any alpha.
class WorkingValues {
public:
  explicit WorkingValues(const TileMap& tiles) : space(value_space(tiles)), alpha(space.has_alpha()) {}

  Image from_stored(const Image& tile) const {
    Image linear = to_linear(tile, space.encoding);
    if (!alpha) return linear;
    const int colors = tile.channels() - 1;
    Image both(tile.width(), tile.height(), 2 * colors + 1);
    for (int y = 0; y < tile.height(); ++y)
      for (int x = 0; x < tile.width(); ++x) {
        const auto from = linear.texel(x, y);
        const auto to = both.texel(x, y);
        for (int c = 0; c < colors; ++c) {
          to[as_size(c)] = from[as_size(c)] * from.back();
          to[as_size(colors + c)] = from[as_size(c)];
        }
        to.back() = from.back();
      }
    return both;
  }

  void to_stored(std::span<const double> value, std::span<float> out) const {
    if (!alpha) {
      for (std::size_t c = 0; c < out.size(); ++c) out[c] = static_cast<float>(value[c]);
      if (space.has_vectors()) renormalise(out);
      return;
    }
    const std::size_t colors = out.size() - 1;
    const double coverage = value.back();
    for (std::size_t c = 0; c < colors; ++c)
      out[c] = static_cast<float>(coverage > 1e-6 ? value[c] / coverage : value[colors + c]);
    out[colors] = static_cast<float>(coverage);
  }

private:
  ValueSpace space;
  bool alpha;
};

std::vector<int> tiles_on_sites(const RotatedLattice& lattice, const Layout& layout) {
  std::vector<int> tile_on(layout.cells.size());
  for (const Cell& cell : layout.cells)
    tile_on.at(as_size(lattice.site_with(cell.column, cell.row))) = cell.tile;
  return tile_on;
}

Image rotated_texture(const TileMap& tiles, const TileColors& colors, const Layout& layout, Size tile_size,
                      int level, const PlaceOptions& options) {
  const WorkingValues working(tiles);
  std::vector<Image> linear(tiles.tiles.size());
  tbb::parallel_for(std::size_t{0}, linear.size(),
                    [&](std::size_t id) { linear[id] = working.from_stored(tiles.tiles[id]); });
  // All levels share one geometry, so at coarser ones gutters are parts of a texel.
  const double side = linear.front().width();
  const double gutter = layout.rotated.gutter * side / tile_size.width;
  const int margin = static_cast<int>(std::ceil(gutter)) + filter_reach(options.filter);
  const std::vector<Image> wide =
      with_margin(linear, chosen_surroundings(colors, layout, options.outside), margin);

  const RotatedLattice lattice(layout.rotated.scheme);
  const std::vector<int> tile_on = tiles_on_sites(lattice, layout);
  const Size size = texture_size(layout, tile_size, level);
  Image texture(size.width, size.height, tiles.tiles.front().channels());
  tbb::parallel_for(0, size.height, [&](int y) {
    std::array<double, 2 * most_channels> buffer{};
    const std::span<double> value(buffer.data(), as_size(linear.front().channels()));
    for (int x = 0; x < size.width; ++x) {
      const RotatedLattice::Owner owner = lattice.owner_of(size, x, y);
      const Image& from = wide[as_size(tile_on[as_size(owner.site)])];
      resample(from, owner.x * (side + 2 * gutter) - gutter + margin,
               owner.y * (side + 2 * gutter) - gutter + margin, options.filter, value);
      working.to_stored(value, texture.texel(x, y));
    }
  });
  return from_linear(texture, tiles.encoding);
}

// Bilinear over the four texels round a place, those of other sites left out.
class OwnTexels {
public:
  OwnTexels(const Image& of_texture, const RotatedLattice& lattice)
      : texture(&of_texture), owners(as_size(of_texture.width()) * as_size(of_texture.height())) {
    for (int y = 0; y < texture->height(); ++y)
      for (int x = 0; x < texture->width(); ++x)
        owners[as_size(y) * as_size(texture->width()) + as_size(x)] = lattice.owner_of(texture->size(), x, y).site;
  }

  void at(Placement::Vector place, int site, std::span<float> out) const {
    const double left = std::floor(place.x - 0.5);
    const double top = std::floor(place.y - 0.5);
    const double right_weight = place.x - 0.5 - left;
    const double lower_weight = place.y - 0.5 - top;
    Sum sum;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        add(sum, static_cast<int>(left) + i, static_cast<int>(top) + j, site,
            (i == 0 ? 1 - right_weight : right_weight) * (j == 0 ? 1 - lower_weight : lower_weight));
    // A place at a tile's corner may have none of the tile's texels next to it: the nearest few then.
    for (int reach = 1; sum.weight <= 0 && reach <= 4; ++reach)
      for (int j = -reach; j <= reach + 1; ++j)
        for (int i = -reach; i <= reach + 1; ++i) {
          const int x = static_cast<int>(left) + i;
          const int y = static_cast<int>(top) + j;
          const double dx = x + 0.5 - place.x;
          const double dy = y + 0.5 - place.y;
          add(sum, x, y, site, 1.0 / (1e-3 + (dx * dx + dy * dy) * (dx * dx + dy * dy)));
        }
    for (std::size_t c = 0; c < out.size(); ++c)
      out[c] = sum.weight > 0
                   ? static_cast<float>(static_cast<double>(sum.base[c]) + sum.value[c] / sum.weight)
                   : 0.0f;
  }

private:
  // As in resample(): differences from the first texel, so that equal texels give their value exactly.
  struct Sum {
    std::span<const float> base;
    std::array<double, most_channels> value{};
    double weight = 0;
  };

  void add(Sum& sum, int x, int y, int site, double weight) const {
    const int tx = wrapped(x, texture->width());
    const int ty = wrapped(y, texture->height());
    if (weight <= 0 || owners[as_size(ty) * as_size(texture->width()) + as_size(tx)] != site) return;
    const auto texel = texture->texel(tx, ty);
    if (sum.base.empty()) sum.base = texel;
    for (std::size_t c = 0; c < texel.size(); ++c)
      sum.value[c] += weight * (static_cast<double>(texel[c]) - static_cast<double>(sum.base[c]));
    sum.weight += weight;
  }

  const Image* texture;
  std::vector<int> owners; // by texel: site
};

std::vector<Image> tiles_of_rotated(const Image& texture, const Layout& layout, Size tile_size, int level) {
  const RotatedLattice lattice(layout.rotated.scheme);
  const OwnTexels own(texture, lattice);
  const Size size{tile_size.width >> level, tile_size.height >> level};
  std::vector<Image> tiles(layout.cells.size());
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
    const Cell& cell = layout.cells[i];
    const int site = lattice.site_with(cell.column, cell.row);
    const Placement place = placement(layout, cell.tile, tile_size, level);
    Image tile(size.width, size.height, texture.channels());
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        own.at(place.at((x + 0.5) / size.width, (y + 0.5) / size.height), site, tile.texel(x, y));
    tiles[i] = std::move(tile);
  });
  return tiles;
}

void check_texture(const Image& texture, const Layout& layout, Size tile_size, int level) {
  const Size size = texture_size(layout, tile_size, level);
  if (texture.size() != size)
    throw Error(ErrorKind::invalid_content, fmt::format("level {}", level),
                fmt::format("{} x {} texels; the layout makes {} x {}", texture.width(), texture.height(),
                            size.width, size.height));
}

} // namespace

Image place_tiles(const TileMap& tiles, const TileColors& colors, const Layout& layout, Size tile_size,
                  int level, const PlaceOptions& options) {
  if (tiles.tiles.size() != layout.cells.size() || tiles.tiles.empty())
    throw Error(ErrorKind::internal, "place_tiles",
                fmt::format("{} tiles for a layout of {}", tiles.tiles.size(), layout.cells.size()));
  if (layout.kind == LayoutKind::rotated)
    return rotated_texture(tiles, colors, layout, tile_size, level, options);
  const int border = layout.border >> level;
  if (border == 0) return atlas(tiles.tiles, layout);
  return atlas(with_margin(tiles.tiles, chosen_surroundings(colors, layout, options.outside), border),
               layout);
}

std::vector<Image> tiles_at_level(const Image& texture, const Layout& layout, Size tile_size, int level) {
  check_texture(texture, layout, tile_size, level);
  if (layout.kind == LayoutKind::rotated) return tiles_of_rotated(texture, layout, tile_size, level);
  std::vector<Image> tiles = tiles_of(texture, layout);
  const int border = layout.border >> level;
  if (border > 0)
    for (Image& tile : tiles)
      tile = crop(tile, {border, border, tile.width() - 2 * border, tile.height() - 2 * border});
  return tiles;
}

} // namespace tilepack
