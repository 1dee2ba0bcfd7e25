#include "tilepack/sampler/virtual_texture.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/place_tiles.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/pack/pack_maps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <string>

namespace tilepack {
namespace {

// One row of the window that lies in row y of the texture: cell by cell, since within a cell the texels are
// consecutive in the tile too.
void copy_row(const LatticeWords& words, const std::vector<Image>& tiles, const VirtualRect& rect,
              std::int64_t y, std::span<float> out) {
  const Size tile = tiles.front().size();
  const int texel_y = static_cast<int>(wrapped(y, static_cast<std::int64_t>(tile.height)));
  const std::int64_t cell_y = (y - texel_y) / tile.height;
  const auto channels = static_cast<std::size_t>(tiles.front().channels());
  for (int column = 0; column < rect.width;) {
    const std::int64_t x = rect.x + column;
    const int texel_x = static_cast<int>(wrapped(x, static_cast<std::int64_t>(tile.width)));
    const int count = std::min(tile.width - texel_x, rect.width - column);
    const auto id = tile_of_cell(words, cell_at(words, (x - texel_x) / tile.width, cell_y));
    const auto from = tiles[id].row(texel_y).subspan(static_cast<std::size_t>(texel_x) * channels,
                                                     static_cast<std::size_t>(count) * channels);
    std::copy(from.begin(), from.end(),
              out.begin() + static_cast<std::ptrdiff_t>(column) * tiles.front().channels());
    column += count;
  }
}

// The same where the texture doesn't wrap, texel by texel.
void copy_bordered_row(const LatticeWords& words, const std::vector<Image>& tiles, const VirtualRect& rect,
                       std::int64_t y, WrapMode border, std::span<float> out) {
  const Size tile = tiles.front().size();
  const auto channels = static_cast<std::size_t>(tiles.front().channels());
  for (int column = 0; column < rect.width; ++column) {
    const std::int64_t x = within(rect.x + column, std::int64_t{words.width} * tile.width, border);
    const auto id = tile_of_cell(words, cell_at(words, x / tile.width, y / tile.height));
    const auto from = tiles[id].texel(static_cast<int>(x % tile.width), static_cast<int>(y % tile.height));
    std::copy(from.begin(), from.end(), out.subspan(static_cast<std::size_t>(column) * channels).begin());
  }
}

} // namespace

Image virtual_texture(const Pack& pack, const std::vector<Image>& tiles, VirtualRect rect, WrapMode border) {
  if (rect.width < 1 || rect.height < 1)
    throw Error(ErrorKind::usage, field("rect"),
                std::to_string(rect.width) + " x " + std::to_string(rect.height) +
                    " texels; both sides must be at least 1");
  Image result(rect.width, rect.height, tiles.at(0).channels());
  const LatticeWords words = lattice_words(pack.mapping, pack.colors);
  const std::int64_t height = pack.mapping.size.height * tiles.at(0).height();
  tbb::parallel_for(0, rect.height, [&](int row) {
    const std::int64_t y = within(rect.y + row, height, border);
    if (border == WrapMode::wrap)
      copy_row(words, tiles, rect, y, result.row(row));
    else
      copy_bordered_row(words, tiles, rect, y, border, result.row(row));
  });
  return result;
}

Image virtual_texture(const Pack& pack, int map, int level, VirtualRect rect) {
  const Image& texture = level_at(map_at(pack, map), level);
  return virtual_texture(pack, tiles_at_level(texture, pack.layout, pack.tile_size, level), rect);
}

} // namespace tilepack
