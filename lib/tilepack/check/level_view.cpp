#include "tilepack/check/level_view.h"

#include "tilepack/layout/rotated_lattice.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/mip/normal_variance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace tilepack {
namespace {

bool whole(double v) {
  return v == std::floor(v);
}

// Turned tiles have no rows of texels along their edges that could be compared.
std::optional<Rect> upright_rect(const Pack& pack, int tile, int level) {
  const Placement at = placement(pack.layout, tile, pack.tile_size, level);
  if (at.east.y != 0 || at.south.x != 0 || !whole(at.origin.x) || !whole(at.origin.y)) return std::nullopt;
  return Rect{static_cast<int>(at.origin.x), static_cast<int>(at.origin.y), static_cast<int>(at.east.x),
              static_cast<int>(at.south.y)};
}

bool inside(const Image& image, const Rect& rect) {
  return rect.x >= 0 && rect.y >= 0 && rect.width > 0 && rect.height > 0 &&
         rect.x <= image.width() - rect.width && rect.y <= image.height() - rect.height;
}

} // namespace

bool has_right_size(const Pack& pack, const Image& image, int level) {
  return !image.empty() && image.size() == texture_size(pack.layout, pack.tile_size, level);
}

bool places_are_sound(const Layout& layout, int tiles) {
  if (static_cast<int>(layout.cells.size()) != tiles || tiles == 0) return false;
  std::optional<RotatedLattice> lattice;
  if (layout.kind == LayoutKind::rotated) {
    if (tile_count(layout.rotated.scheme) != tiles) return false;
    lattice.emplace(layout.rotated.scheme);
  }
  std::set<std::pair<int, int>> taken;
  for (int id = 0; id < tiles; ++id) {
    const Cell& cell = layout.cells[static_cast<std::size_t>(id)];
    const bool inside =
        lattice ? lattice->site_with(cell.column, cell.row) >= 0
                : cell.column >= 0 && cell.column < layout.columns && cell.row >= 0 && cell.row < layout.rows;
    if (cell.tile != id || !inside || !taken.emplace(cell.column, cell.row).second) return false;
  }
  return true;
}

bool plain_boxes(const PackedMap& map) {
  return map.role != Role::normal && roughness_channels(map, map.channels).empty() &&
         color_channels(map.channels) == map.channels;
}

double full_range(const PackedMap& map) {
  if (map.depth == Depth::u8 || map.depth == Depth::u16) return 1;
  double largest = 0;
  for (const float v : map.levels.front().data())
    if (std::isfinite(v)) largest = std::max(largest, std::abs(static_cast<double>(v)));
  return largest > 0 ? largest : 1;
}

std::string place_name(const PackedMap& map, int level) {
  return fmt::format("map {}, level {}", map.name, level);
}

LevelView view_of(const Pack& pack, const PackedMap& map, int level) {
  const Image& image = map.levels[static_cast<std::size_t>(level)];
  LevelView view{&pack, &map, level, &image, level_size(pack.tile_size, level), {}};
  view.rects.resize(static_cast<std::size_t>(tile_count(pack.tiles)));
  if (!has_right_size(pack, image, level) || pack.layout.kind == LayoutKind::rotated) return view;
  for (std::size_t i = 0; i < std::min(pack.layout.cells.size(), view.rects.size()); ++i) {
    const int tile = pack.layout.cells[i].tile;
    if (tile != static_cast<int>(i)) continue;
    const auto rect = upright_rect(pack, tile, level);
    if (rect && inside(image, *rect)) view.rects[i] = rect;
  }
  return view;
}

} // namespace tilepack
