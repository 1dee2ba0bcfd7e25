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
