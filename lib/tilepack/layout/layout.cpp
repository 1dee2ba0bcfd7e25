#include "tilepack/layout/layout.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <utility>

namespace tilepack {

std::string_view name_of(LayoutKind kind) {
  switch (kind) {
  case LayoutKind::tile_index:
    return "tile-index";
  case LayoutKind::de_bruijn:
    return "de-bruijn";
  case LayoutKind::rotated:
    return "rotated";
  case LayoutKind::array:
    break;
  }
  return "array";
}

std::string_view name_of(Matching matching) {
  switch (matching) {
  case Matching::found:
    return "found";
  case Matching::none:
    return "none";
  case Matching::not_found:
    break;
  }
  return "not-found";
}

namespace {

// Axes of a rotated layout's cell in texels of a texture of this size, and the part of it that the tile
// takes.
Placement rotated_cell(const Layout& layout, const Cell& cell, Size texture) {
  const RotatedScheme& scheme = layout.rotated.scheme;
  const double m = scheme.n * scheme.n + scheme.k * scheme.k;
  const double across = texture.width / (m * scheme.squares);
  const double down = texture.height / m;
  return {{cell.column * across, cell.row * down},
          {scheme.n * across, scheme.k * down},
          {-scheme.k * across, scheme.n * down}};
}

} // namespace

Size texture_size(const Layout& layout, Size tile_size, int level) {
  if (layout.kind == LayoutKind::rotated)
    return {std::max(1, layout.rotated.size.width >> level),
            std::max(1, layout.rotated.size.height >> level)};
  const int border = 2 * (layout.border >> level);
  return {layout.columns * ((tile_size.width >> level) + border),
          layout.rows * ((tile_size.height >> level) + border)};
}

int levels_held(const Layout& layout, Size tile_size, int tile_levels) {
  int levels = 1;
  for (; levels < tile_levels; ++levels) {
    if (layout.border > 0 && layout.border % (1 << levels) != 0) break;
    if (layout.kind != LayoutKind::rotated) continue;
    // A turned cell holds a texel centre for certain if it holds a circle of the diagonal of a texel.
    const RotatedScheme& scheme = layout.rotated.scheme;
    const std::int64_t side = texture_size(layout, tile_size, levels).height;
    const std::int64_t diagonal_squared = scheme.k == 0 ? 1 : 2;
    if (side * side < diagonal_squared * (scheme.n * scheme.n + scheme.k * scheme.k)) break;
  }
  return levels;
}

Placement placement(const Layout& layout, int tile, Size tile_size, int level) {
  const Cell& cell = layout.cells.at(static_cast<std::size_t>(tile));
  if (layout.kind == LayoutKind::rotated) {
    const Placement whole = rotated_cell(layout, cell, texture_size(layout, tile_size, level));
    const double cell_side = tile_size.width + 2 * layout.rotated.gutter;
    const double gutter = layout.rotated.gutter / cell_side;
    const double part = tile_size.width / cell_side;
    return {whole.at(gutter, gutter),
            {whole.east.x * part, whole.east.y * part},
            {whole.south.x * part, whole.south.y * part}};
  }
  const int border = layout.border >> level;
  const double width = tile_size.width >> level;
  const double height = tile_size.height >> level;
  return {{cell.column * (width + 2 * border) + border, cell.row * (height + 2 * border) + border},
          {width, 0},
          {0, height}};
}

Image atlas(const std::vector<Image>& tiles, const Layout& layout) {
  if (tiles.size() != layout.cells.size() || tiles.empty())
    throw Error(ErrorKind::internal, "atlas",
                fmt::format("{} tiles for a layout of {} cells; give one image a cell", tiles.size(),
                            layout.cells.size()));
  const Size tile = tiles.front().size();
  Image image(layout.columns * tile.width, layout.rows * tile.height, tiles.front().channels());
  for (const Cell& cell : layout.cells) {
    const Image& from = tiles.at(static_cast<std::size_t>(cell.tile));
    if (from.size() != tile)
      throw Error(ErrorKind::internal, "atlas",
                  fmt::format("tile {} is {} x {} texels, tile 0 {} x {}; all must have one size", cell.tile,
                              from.width(), from.height(), tile.width, tile.height));
    paste(image, from, cell.column * tile.width, cell.row * tile.height);
  }
  return image;
}

std::vector<Image> tiles_of(const Image& image, const Layout& layout) {
  if (layout.columns < 1 || layout.rows < 1 || image.width() % layout.columns != 0 ||
      image.height() % layout.rows != 0)
    throw Error(ErrorKind::invalid_content, "tiles_of",
                fmt::format("an image of {} x {} texels can't be cut into {} x {} equal tiles", image.width(),
                            image.height(), layout.columns, layout.rows));
  const Size tile{image.width() / layout.columns, image.height() / layout.rows};
  std::vector<Image> tiles(layout.cells.size());
  for (const Cell& cell : layout.cells)
    tiles.at(static_cast<std::size_t>(cell.tile)) =
        crop(image, {cell.column * tile.width, cell.row * tile.height, tile.width, tile.height});
  return tiles;
}

} // namespace tilepack
