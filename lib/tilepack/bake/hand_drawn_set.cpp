#include "tilepack/bake/hand_drawn_set.h"

#include "tilepack/bake/material_normals.h"
#include "tilepack/error/error.h"
#include "tilepack/json/json_cursor.h"
#include "tilepack/tileset/border_agreement.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace tilepack {
namespace {

std::tuple<int, int, int, int> order_of(const EdgeTile& t) {
  return {t.north, t.east, t.south, t.west};
}

std::tuple<int, int, int, int> order_of(const CornerTile& t) {
  return {t.nw, t.ne, t.sw, t.se};
}

// HandDrawnTile numbers in the order of their colors if that makes the set complete, else as they came.
std::vector<std::size_t> usual_order(const TileColors& tiles) {
  return std::visit(
      [](const auto& list) {
        std::vector<std::size_t> as_given(list.size());
        std::iota(as_given.begin(), as_given.end(), std::size_t{0});
        std::vector<std::size_t> sorted = as_given;
        std::stable_sort(sorted.begin(), sorted.end(),
                         [&](std::size_t a, std::size_t b) { return order_of(list[a]) < order_of(list[b]); });
        auto reordered = list;
        for (std::size_t i = 0; i < list.size(); ++i) reordered[i] = list[sorted[i]];
        return is_complete_set(reordered) ? sorted : as_given;
      },
      tiles);
}

} // namespace

TileColors parsed_color_list(std::string_view text, const std::string& file) {
  const JsonCursor root = JsonCursor::parse(text, file);
  const std::size_t count = root.array(1, limits::most_tiles);
  const bool corner = root.item(0).find("nw").has_value();
  std::vector<EdgeTile> edges;
  std::vector<CornerTile> corners;
  for (std::size_t i = 0; i < count; ++i) {
    const JsonCursor tile = root.item(i);
    const auto color = [&](const char* name) {
      return tile.member(name).small_integer(
          0, (corner ? limits::most_corner_colors : limits::most_edge_colors) - 1);
    };
    if (corner) {
      tile.only({"nw", "ne", "sw", "se"});
      corners.push_back({color("nw"), color("ne"), color("sw"), color("se")});
    } else {
      tile.only({"north", "east", "south", "west"});
      edges.push_back({color("north"), color("east"), color("south"), color("west")});
    }
  }
  if (corner) return corners;
  return edges;
}

std::vector<std::string> complete_drawings(std::vector<HandDrawnTile>& drawings, Role role) {
  std::vector<std::string> notes;
  std::set<std::string> told;
  if (role != Role::normal) return notes;
  for (HandDrawnTile& drawing : drawings) {
    SampleMap map{{"normal", role, Encoding::linear, drawing.image.depth},
                  std::move(drawing.image.image),
                  drawing.file};
    for (const std::string& sentence : complete_normals(map))
      if (told.insert(sentence).second) notes.push_back(drawing.file + ": " + sentence);
    drawing.image.image = std::move(map.image);
  }
  return notes;
}

TileSet drawn_set(std::span<const HandDrawnTile> drawings, const TileColors& tiles,
                  const MaterialFile& map_made) {
  if (drawings.size() != static_cast<std::size_t>(tile_count(tiles)))
    throw Error(ErrorKind::invalid_content, "colors",
                fmt::format("the list has {} entries, and there are {} drawings; give one entry a drawing",
                            tile_count(tiles), drawings.size()));
  const ImageFile& first = drawings[0].image;
  const Size size = first.image.size();
  for (const int side : {size.width, size.height})
    if (side < limits::smallest_tile_side_made || side > limits::largest_tile_side)
      throw Error(ErrorKind::invalid_content, drawings[0].file,
                  fmt::format("is {} x {} texels; each side of a tile must be {} to {}", size.width,
                              size.height, limits::smallest_tile_side_made, limits::largest_tile_side));
  for (const HandDrawnTile& drawing : drawings) {
    if (drawing.image.image.size() != size)
      throw Error(ErrorKind::invalid_content, drawing.file,
                  fmt::format("is {} x {} texels, and {} is {} x {}; all tiles must have one size",
                              drawing.image.image.width(), drawing.image.image.height(), drawings[0].file,
                              size.width, size.height));
    if (drawing.image.image.channels() != first.image.channels())
      throw Error(ErrorKind::invalid_content, drawing.file,
                  fmt::format("has {} channels, and {} has {}; all tiles must have the same",
                              drawing.image.image.channels(), drawings[0].file, first.image.channels()));
  }
  const std::vector<std::size_t> order = usual_order(tiles);
  TileSet set;
  set.tile_size = size;
  set.colors = color_counts(tiles);
  set.tiles = std::visit(
      [&](const auto& list) {
        auto reordered = list;
        for (std::size_t i = 0; i < list.size(); ++i) reordered[i] = list[order[i]];
        return TileColors(reordered);
      },
      tiles);
  MapFormat format{map_made.name,
                   map_made.role,
                   is_light(map_made.role) ? first.encoding : Encoding::linear,
                   first.depth,
                   filled_contents(map_made.contents, first.image.channels()),
                   map_made.normal_y};
  TileMap map(std::move(format), {});
  for (const std::size_t drawing : order)
    map.tiles.push_back(quantised(drawings[drawing].image.image, map.depth));
  set.maps.push_back(std::move(map));
  set.guard = agreed_guard(set);
  return set;
}

} // namespace tilepack
