#include "tilepack/layout/layout.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tilepack {

namespace {

// Axes of a rotated layout's cell in texels of a texture of this size, and the part of it that the tile
// takes.
Placement rotated_cell(const LayoutWords& words, int column, int row, Size texture) {
  const double n = words.n;
  const double k = words.k;
  const double m = n * n + k * k;
  const double across = texture.width / (m * words.squares);
  const double down = texture.height / m;
  return {{column * across, row * down}, {n * across, k * down}, {(0 - k) * across, n * down}};
}

// All tiles in their cells; `placed` gets each once it is there.
template <typename Tiles, typename Placed>
Image side_by_side_in_cells(Tiles& tiles, const Layout& layout, Placed placed) {
  if (tiles.size() != layout.cells.size() || tiles.empty())
    throw Error(ErrorKind::internal, "atlas",
                fmt::format("{} tiles for a layout of {} cells; give one image a cell", tiles.size(),
                            layout.cells.size()));
  const Size tile = tiles.front().size();
  const Size whole{layout.columns * tile.width, layout.rows * tile.height};
  const int channels = tiles.front().channels();
  const bool is_full =
      layout.cells.size() == static_cast<std::size_t>(layout.columns) * static_cast<std::size_t>(layout.rows);
  Image image = is_full ? Image::unset(whole, channels) : Image(whole.width, whole.height, channels);
  for (const Cell& cell : layout.cells) {
    auto& from = tiles.at(static_cast<std::size_t>(cell.tile));
    if (from.size() != tile)
      throw Error(ErrorKind::internal, "atlas",
                  fmt::format("tile {} is {} x {} texels, tile 0 {} x {}; all must have one size", cell.tile,
                              from.width(), from.height(), tile.width, tile.height));
    paste(image, from, cell.column * tile.width, cell.row * tile.height);
    placed(from);
  }
  return image;
}

} // namespace

LayoutWords layout_words(const Layout& layout, Size tile_size) {
  const auto word = [](int value) { return static_cast<std::uint32_t>(value); };
  LayoutWords words;
  words.columns = word(layout.columns);
  words.rows = word(layout.rows);
  words.tile_width = word(tile_size.width);
  words.tile_height = word(tile_size.height);
  words.border = word(layout.border);
  if (layout.kind == LayoutKind::rotated) {
    words.n = word(layout.rotated.scheme.n);
    words.k = word(layout.rotated.scheme.k);
    words.squares = word(layout.rotated.scheme.squares);
    words.gutter = word(layout.rotated.gutter);
  }
  const Size grid = texture_size(words, 0); // of a rotated layout nothing yet
  words.texture_width = word(words.n > 0 ? layout.rotated.size.width : grid.width);
  words.texture_height = word(words.n > 0 ? layout.rotated.size.height : grid.height);
  return words;
}

Size texture_size(const LayoutWords& words, int level) {
  const auto side = [&](std::uint32_t whole, std::uint32_t tiles, std::uint32_t tile) {
    if (words.n > 0) return std::max(1, static_cast<int>(whole >> level));
    return static_cast<int>(tiles * ((tile >> level) + 2 * (words.border >> level)));
  };
  return {side(words.texture_width, words.columns, words.tile_width),
          side(words.texture_height, words.rows, words.tile_height)};
}

Size texture_size(const Layout& layout, Size tile_size, int level) {
  return texture_size(layout_words(layout, tile_size), level);
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

Placement placement(const LayoutWords& words, int column, int row, int level) {
  if (words.n > 0) {
    const Placement whole = rotated_cell(words, column, row, texture_size(words, level));
    const double cell_side = words.tile_width + 2 * words.gutter;
    const double gutter = words.gutter / cell_side;
    const double part = words.tile_width / cell_side;
    return {whole.at(gutter, gutter),
            {whole.east.x * part, whole.east.y * part},
            {whole.south.x * part, whole.south.y * part}};
  }
  const double border = words.border >> level;
  const double width = words.tile_width >> level;
  const double height = words.tile_height >> level;
  return {{column * (width + 2 * border) + border, row * (height + 2 * border) + border},
          {width, 0},
          {0, height}};
}

Placement placement(const Layout& layout, int tile, Size tile_size, int level) {
  const Cell& cell = layout.cells.at(static_cast<std::size_t>(tile));
  return placement(layout_words(layout, tile_size), cell.column, cell.row, level);
}

Image atlas(const std::vector<Image>& tiles, const Layout& layout) {
  return side_by_side_in_cells(tiles, layout, [](const Image&) {});
}

Image atlas(std::vector<Image>&& tiles, const Layout& layout) {
  return side_by_side_in_cells(tiles, layout, [](Image& tile) { tile = Image(); });
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
