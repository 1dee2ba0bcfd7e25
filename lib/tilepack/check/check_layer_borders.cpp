#include "tilepack/check/level_view.h"
#include "tilepack/check/structure_checks.h"
#include "tilepack/layout/place_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

// NaN is another rule's matter.
bool differ(float a, float b) {
  return a != b && std::isfinite(a) && std::isfinite(b);
}

void check_layer(const Image& is, const Image& should, Rect layer, const std::string& where,
                 std::vector<Issue>& issues) {
  int differing = 0;
  int first_x = 0;
  int first_y = 0;
  double largest = 0;
  for (int y = layer.y; y < layer.y + layer.height; ++y)
    for (int x = layer.x; x < layer.x + layer.width; ++x) {
      const auto a = is.texel(x, y);
      const auto b = should.texel(x, y);
      bool same = true;
      for (std::size_t c = 0; c < a.size(); ++c) {
        if (!differ(a[c], b[c])) continue;
        same = false;
        largest = std::max(largest, std::fabs(static_cast<double>(a[c]) - static_cast<double>(b[c])));
      }
      if (same || differing++ > 0) continue;
      first_x = x;
      first_y = y;
    }
  if (differing > 0)
    issues.push_back(
        {Rule::layer_border, where,
         fmt::format("{} texels round the tile differ, by up to {:.4g}; the first at ({}, {}) of "
                     "the image",
                     differing, largest, first_x, first_y),
         "the texels of the first tiles whose colors fit there"});
}

} // namespace

std::vector<Issue> check_layer_borders(const Pack& pack) {
  std::vector<Issue> issues;
  const Layout& layout = pack.layout;
  if (layout.kind != LayoutKind::array || layout.border == 0) return issues;
  if (!places_are_sound(layout, tile_count(pack.tiles))) return issues;
  for (const PackedMap& map : pack.maps)
    for (int level = 0; level < std::min(static_cast<int>(map.levels.size()), 31); ++level) {
      const Image& image = map.levels[static_cast<std::size_t>(level)];
      if (layout.border >> level == 0 || !has_right_size(pack, image, level)) continue;
      const TileMap tiles(map, tiles_at_level(image, layout, pack.tile_size, level));
      const Image expected = place_tiles(tiles, pack.tiles, layout, pack.tile_size, level);
      const int height = image.height() / layout.rows;
      for (const Cell& cell : layout.cells)
        check_layer(image, expected, {0, cell.row * height, image.width(), height},
                    fmt::format("{}, layer {} (tile {})", place_name(map, level), cell.row, cell.tile),
                    issues);
    }
  return issues;
}

} // namespace tilepack
