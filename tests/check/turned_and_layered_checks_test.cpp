// Packs whose tiles lie turned or in layers, spoilt in each way that a check is for.

#include "support/framed_pack.h"
#include "support/good_pack.h"

#include "tilepack/check/structure_checks.h"
#include "tilepack/tileset/sequential_set.h"

#include <catch2/catch.hpp>
#include <functional>
#include <limits>

using namespace tilepack;
using namespace tilepack::test;

namespace {

// Waves that differ from tile to tile inside a frame of 4 texels that all share, so that any two tiles fit.
TileSet wavy_set(const std::vector<EdgeTile>& tiles, int side) {
  TileSet set{{side, side}, color_counts(tiles), tiles, {}, 4};
  TileMap map{"color", Role::color, Encoding::srgb, Depth::u8, {}};
  for (std::size_t id = 0; id < tiles.size(); ++id) {
    Image tile(side, side, 3, 128.0f / 255);
    for (int y = 4; y < side - 4; ++y)
      for (int x = 4; x < side - 4; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          tile.texel(x, y)[c] =
              quantised(static_cast<float>(
                            0.5 + 0.4 * std::sin(0.2 * x + 0.13 * y * (1.0 + double(id % 3)) + double(c))),
                        Depth::u8);
    map.tiles.push_back(std::move(tile));
  }
  set.maps.push_back(std::move(map));
  return set;
}

Pack rotated_pack(std::optional<int> gutter = {}) {
  PackingOptions options;
  options.layout = LayoutKind::rotated;
  options.rotated.scheme = RotatedScheme{2, 2, 1};
  options.rotated.gutter = gutter;
  options.mapping = MappingKind::index;
  options.virtual_size = {6, 6};
  return packed(wavy_set(sequential_edge_set(2, 2), 32), options, 1);
}

Pack array_pack() {
  PackingOptions options;
  options.layout = LayoutKind::array;
  options.array.border = 4;
  options.virtual_size = {6, 6};
  return packed(framed_set(complete_edge_set(2, 2), {16, 16}, 5), options, 1);
}

std::vector<EdgeTile>& edges(Pack& pack) {
  return std::get<std::vector<EdgeTile>>(pack.tiles);
}

Cell& cell_of(Pack& pack, int tile) {
  return pack.layout.cells[static_cast<std::size_t>(tile)];
}

Image& level_of(Pack& pack, std::size_t level) {
  return pack.maps[0].levels[level];
}

// The texel (x, y) of a layer at level 0, border included: 24 rows a layer.
float& layer_texel(Pack& pack, int tile, int x, int y) {
  return level_of(pack, 0).texel(x, cell_of(pack, tile).row * 24 + y)[1];
}

void change(float& value) {
  value = value > 0.5f ? 0.0f : 1.0f;
}

// Black where the tile lies, as a brush would leave it.
void paint(Pack& pack, int tile, int level) {
  const Placement place = placement(pack.layout, tile, pack.tile_size, level);
  Image& image = level_of(pack, static_cast<std::size_t>(level));
  for (double v = 0.15; v < 0.85; v += 0.01)
    for (double u = 0.15; u < 0.85; u += 0.01) {
      const Placement::Vector at = place.at(u, v);
      std::ranges::fill(image.texel((static_cast<int>(at.x) + image.width()) % image.width(),
                                    (static_cast<int>(at.y) + image.height()) % image.height()),
                        0.0f);
    }
}

struct Corruption {
  const char* name;
  Rule rule;
  std::function<void(Pack&)> spoil;
};

const Corruption of_turned_packs[] = {
    {"a tile between the places of the scheme", Rule::cell_outside,
     [](Pack& p) { cell_of(p, 3).column = (cell_of(p, 3).column + 1) % p.layout.columns; }},
    {"a tile off the texture", Rule::cell_outside, [](Pack& p) { cell_of(p, 3).row = -1; }},
    {"two tiles in one place", Rule::cell_taken_twice,
     [](Pack& p) {
       cell_of(p, 3).column = cell_of(p, 4).column;
       cell_of(p, 3).row = cell_of(p, 4).row;
     }},
    {"a tile that is placed twice", Rule::tile_not_placed, [](Pack& p) { cell_of(p, 3).tile = 4; }},
    {"a tile that is not placed", Rule::tile_not_placed, [](Pack& p) { p.layout.cells.pop_back(); }},
    {"two tiles that changed places", Rule::border_colors,
     [](Pack& p) {
       std::swap(cell_of(p, 1).column, cell_of(p, 2).column);
       std::swap(cell_of(p, 1).row, cell_of(p, 2).row);
     }},
    {"a tile of other colors", Rule::border_colors, [](Pack& p) { edges(p)[5].east ^= 1; }},
    {"a color out of range", Rule::color_range, [](Pack& p) { edges(p)[5].east = 2; }},
    {"a NaN", Rule::not_finite,
     [](Pack& p) { level_of(p, 1).texel(3, 3)[0] = std::numeric_limits<float>::quiet_NaN(); }},
    {"a value between codes", Rule::not_representable, [](Pack& p) { level_of(p, 1).texel(3, 3)[0] = 0.5f; }},
    {"a texture of another size", Rule::level_size, [](Pack& p) { level_of(p, 0) = Image(90, 91, 3); }},
    {"a scheme whose texture is larger", Rule::level_size,
     [](Pack& p) {
       p.layout.rotated.size = {92, 92};
     }},
    {"a level too few", Rule::levels_missing, [](Pack& p) { p.maps[0].levels.pop_back(); }},
    {"levels without a texel a tile", Rule::levels_missing, [](Pack& p) { p.tile_levels = 6; }},
    {"a tile painted over at level 0 alone", Rule::level_stale, [](Pack& p) { paint(p, 2, 0); }},
    {"a tile painted over at level 1 alone", Rule::level_stale, [](Pack& p) { paint(p, 5, 1); }},
    {"an index map of tiles that don't fit", Rule::index_colors,
     [](Pack& p) { std::swap(p.mapping.ids[7], p.mapping.ids[8]); }},
};

const Corruption of_layered_packs[] = {
    {"a layer beyond the last", Rule::cell_outside, [](Pack& p) { cell_of(p, 3).row = 16; }},
    {"two tiles in a layer", Rule::cell_taken_twice, [](Pack& p) { cell_of(p, 3).row = 4; }},
    {"a missing layer", Rule::tile_not_placed, [](Pack& p) { p.layout.cells.pop_back(); }},
    {"a tile in two layers", Rule::tile_not_placed, [](Pack& p) { cell_of(p, 3).tile = 4; }},
    {"another border", Rule::level_size, [](Pack& p) { p.layout.border = 2; }},
    {"an edited texel on the border of a tile", Rule::edge_texels,
     [](Pack& p) { change(layer_texel(p, 6, 12, 4)); }},
    {"an edited texel round a tile", Rule::layer_border, [](Pack& p) { change(layer_texel(p, 6, 12, 1)); }},
    {"an edited texel beyond a tile's corner", Rule::layer_border,
     [](Pack& p) { change(layer_texel(p, 6, 22, 22)); }},
    {"an edited texel round a tile at level 1", Rule::layer_border,
     [](Pack& p) { change(level_of(p, 1).texel(0, 30)[0]); }},
    {"layers in another order than their texels", Rule::edge_texels,
     [](Pack& p) { std::swap(cell_of(p, 3).row, cell_of(p, 4).row); }},
    {"a level too few", Rule::levels_missing, [](Pack& p) { p.maps[0].levels.pop_back(); }},
    {"levels with half a border texel", Rule::levels_missing, [](Pack& p) { p.tile_levels = 4; }},
    {"a level of another size", Rule::level_size, [](Pack& p) { level_of(p, 1) = Image(12, 180, 3); }},
    {"a tile painted over at level 0 alone", Rule::level_stale,
     [](Pack& p) {
       for (int y = 8; y < 16; ++y)
         for (int x = 8; x < 16; ++x) layer_texel(p, 7, x, y) = 0.0f;
     }},
};

} // namespace

TEST_CASE("good turned and layered packs have no issues") {
  for (const Pack& pack : {rotated_pack(), rotated_pack(3), array_pack()}) {
    const auto issues = check_structure(pack);
    INFO(listing(issues));
    CHECK(issues.empty());
  }
}

TEST_CASE("each corruption of a turned pack is caught by its own rule") {
  for (const Corruption& corruption : of_turned_packs) {
    Pack pack = rotated_pack();
    REQUIRE(pack.layout.rotated.matching == Matching::found);
    corruption.spoil(pack);
    const auto issues = check_structure(pack);
    INFO(corruption.name << "\n" << listing(issues));
    CHECK(has(issues, corruption.rule));
  }
}

TEST_CASE("each corruption of a layered pack is caught by its own rule") {
  for (const Corruption& corruption : of_layered_packs) {
    Pack pack = array_pack();
    corruption.spoil(pack);
    const auto issues = check_structure(pack);
    INFO(corruption.name << "\n" << listing(issues));
    CHECK(has(issues, corruption.rule));
  }
}

TEST_CASE("turned neighbours need not match where gutters keep them apart, unless the pack says so") {
  const auto swapped = [](Pack pack) {
    std::swap(cell_of(pack, 1).column, cell_of(pack, 2).column);
    std::swap(cell_of(pack, 1).row, cell_of(pack, 2).row);
    return pack;
  };
  Pack pack = swapped(rotated_pack(3));
  CHECK(has(check_layout(pack), Rule::border_colors)); // its matching is "found"
  pack.layout.rotated.matching = Matching::none;
  CHECK(check_layout(pack).empty());
  pack.layout.rotated.gutter = 0;
  CHECK(has(check_layout(pack), Rule::border_colors));
}

TEST_CASE("the issue names the two turned tiles and the color between them") {
  Pack pack = rotated_pack();
  edges(pack)[5].east ^= 1;
  const auto issues = check_layout(pack);
  INFO(listing(issues));
  REQUIRE(issues.size() == 1);
  CHECK(issues[0].where == "layout, tile 5 and its east neighbour");
  CHECK(issues[0].found.find("tile 5 east edge (color ") != std::string::npos);
}
