#include "support/good_pack.h"

#include "tilepack/check/structure_checks.h"
#include "tilepack/mip/far_levels.h"
#include "tilepack/mip/level_size.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <functional>
#include <limits>

using namespace tilepack;
using namespace tilepack::test;

namespace {

std::vector<EdgeTile>& edges(Pack& pack) {
  return std::get<std::vector<EdgeTile>>(pack.tiles);
}

Cell& cell_of(Pack& pack, int tile) {
  return pack.layout.cells[static_cast<std::size_t>(tile)];
}

std::span<float> texel(Pack& pack, int level, int tile, int x, int y) {
  const Size size = level_size(pack.tile_size, level);
  const Cell& cell = cell_of(pack, tile);
  return pack.maps[0].levels[level].texel(cell.column * size.width + x, cell.row * size.height + y);
}

void change(float& value) {
  value = value > 0.5f ? 0.0f : 1.0f;
}

struct Corruption {
  const char* name;
  Rule rule;
  std::function<void(Pack&)> spoil;
};

const Corruption corruptions[] = {
    {"a color out of range", Rule::color_range, [](Pack& p) { edges(p)[3].west = 2; }},
    {"a negative color", Rule::color_range, [](Pack& p) { edges(p)[3].north = -1; }},
    {"two tiles of the same colors", Rule::tile_repeated, [](Pack& p) { edges(p)[5] = edges(p)[6]; }},
    {"a missing combination", Rule::set_incomplete, [](Pack& p) { edges(p)[5] = edges(p)[6]; }},
    {"a missing tile", Rule::set_incomplete,
     [](Pack& p) {
       edges(p).pop_back();
       p.layout.cells.pop_back();
     }},
    {"tiles in another order", Rule::tile_order, [](Pack& p) { std::swap(edges(p)[5], edges(p)[6]); }},
    {"a tile placed twice", Rule::tile_not_placed, [](Pack& p) { cell_of(p, 5).tile = 6; }},
    {"a tile not placed", Rule::tile_not_placed, [](Pack& p) { p.layout.cells.pop_back(); }},
    {"a tile id out of range", Rule::tile_not_placed, [](Pack& p) { cell_of(p, 5).tile = 16; }},
    {"two tiles in a cell", Rule::cell_taken_twice,
     [](Pack& p) {
       cell_of(p, 5) = {5, cell_of(p, 6).column, cell_of(p, 6).row};
     }},
    {"a cell outside the grid", Rule::cell_outside, [](Pack& p) { cell_of(p, 5).column = 4; }},
    {"a negative cell", Rule::cell_outside, [](Pack& p) { cell_of(p, 5).row = -1; }},
    {"an empty cell", Rule::cell_empty, [](Pack& p) { p.layout.cells.pop_back(); }},
    {"two tiles changed places", Rule::border_colors,
     [](Pack& p) { std::swap(cell_of(p, 5).column, cell_of(p, 6).column); }},
    {"a layout moved by a cell, legal but not where the formula looks", Rule::cell_formula,
     [](Pack& p) {
       for (Cell& cell : p.layout.cells) cell.column = (cell.column + 1) % 4;
     }},
    {"a NaN", Rule::not_finite,
     [](Pack& p) { texel(p, 2, 1, 1, 1)[1] = std::numeric_limits<float>::quiet_NaN(); }},
    {"an infinity", Rule::not_finite,
     [](Pack& p) { texel(p, 0, 1, 7, 7)[1] = std::numeric_limits<float>::infinity(); }},
    {"a value between codes", Rule::not_representable, [](Pack& p) { texel(p, 0, 1, 7, 7)[1] = 0.5f; }},
    {"a value above 1", Rule::not_representable, [](Pack& p) { texel(p, 0, 1, 7, 7)[1] = 2.0f; }},
    {"an edited border texel", Rule::edge_texels, [](Pack& p) { change(texel(p, 0, 9, 7, 0)[2]); }},
    {"an edited texel in the guard band", Rule::guard_texels,
     [](Pack& p) { change(texel(p, 0, 9, 14, 7)[2]); }},
    {"an edited texel in the guard band of level 1", Rule::guard_texels,
     [](Pack& p) { change(texel(p, 1, 9, 3, 0)[2]); }},
    {"an edited border texel at level 2", Rule::sanitized_edges,
     [](Pack& p) { change(texel(p, 2, 9, 1, 3)[0]); }},
    {"a table entry twice", Rule::table_not_permutation,
     [](Pack& p) { p.mapping.table[3] = p.mapping.table[4]; }},
    {"a table entry out of range", Rule::table_not_permutation, [](Pack& p) { p.mapping.table[3] = 16; }},
    {"an empty table", Rule::table_not_permutation, [](Pack& p) { p.mapping.table.clear(); }},
    {"a table that repeats rows", Rule::table_repeats_rows, [](Pack& p) { p.mapping.size.height = 9; }},
    {"a table that repeats columns", Rule::table_repeats_rows, [](Pack& p) { p.mapping.size.width = 17; }},
    {"a biased table", Rule::table_biased, [](Pack& p) { p.mapping.table = shuffled(17); }},
    {"an empty virtual texture", Rule::virtual_size, [](Pack& p) { p.mapping.size.width = 0; }},
    {"a huge virtual texture", Rule::virtual_size,
     [](Pack& p) { p.mapping.size.height = (std::int64_t{1} << 31) + 1; }},
    {"a level too few", Rule::levels_missing, [](Pack& p) { p.maps[0].levels.pop_back(); }},
    {"levels announced that no tile has", Rule::levels_missing, [](Pack& p) { p.tile_levels = 6; }},
    {"a tile painted over at level 0 alone", Rule::level_stale,
     [](Pack& p) {
       for (int y = 4; y < 12; ++y)
         for (int x = 4; x < 12; ++x) std::ranges::fill(texel(p, 0, 9, x, y), 0.0f);
     }},
    {"a tile painted over at a coarser level alone", Rule::level_stale,
     [](Pack& p) {
       for (int y = 2; y < 6; ++y)
         for (int x = 2; x < 6; ++x) change(texel(p, 1, 9, x, y)[0]);
     }},
    {"a level of another size", Rule::level_size, [](Pack& p) { p.maps[0].levels[2] = Image(15, 16, 3); }},
};

} // namespace

TEST_CASE("a good pack has no issues") {
  for (const GoodPackOptions& options :
       {GoodPackOptions{}, GoodPackOptions{.colors = {3, 2, 0}, .tile = {24, 16}, .guard = 1, .channels = 1},
        GoodPackOptions{.colors = {1, 1, 0}, .tile = {4, 4}, .depth = Depth::u16},
        GoodPackOptions{.tile = {9, 7}, .depth = Depth::f16, .mips = MipMode::none},
        GoodPackOptions{.depth = Depth::f32}}) {
    Pack pack = good_pack(options);
    pack.mapping.table = shuffled(48);
    const auto issues = check_structure(pack);
    INFO(listing(issues));
    CHECK(issues.empty());
  }
}

TEST_CASE("far levels must be there, and the means of the last level of tiles") {
  GoodPackOptions options;
  options.mips = MipMode::box;
  Pack good = good_pack(options);
  good.full_chain = true;
  PackedMap& map = good.maps[0];
  const TileMap format{map, {Image(1, 1, 3)}};
  for (const Image& level : far_levels({map.levels.back(), format}, 1,
                                       far_level_sizes(good.layout, good.tile_size, good.tile_levels)))
    map.far_levels.push_back(quantised(level, map.depth));
  REQUIRE(map.far_levels.size() == 2);
  CHECK_FALSE(has(check_structure(good), Rule::level_stale));
  CHECK_FALSE(has(check_structure(good), Rule::levels_missing));
  Pack missing = good;
  missing.maps[0].far_levels.pop_back();
  CHECK(has(check_structure(missing), Rule::levels_missing));
  Pack stale = good;
  std::ranges::fill(stale.maps[0].far_levels[1].data(), 1.0f);
  CHECK(has(check_structure(stale), Rule::level_stale));
}

TEST_CASE("each corruption of a good pack is caught by its own rule") {
  for (const Corruption& corruption : corruptions) {
    Pack pack = good_pack();
    corruption.spoil(pack);
    const auto issues = check_structure(pack);
    INFO(corruption.name << "\n" << listing(issues));
    CHECK(has(issues, corruption.rule));
  }
}

TEST_CASE("an edited tile is named, not the tiles it differs from") {
  for (const int tile : {0, 7, 15}) {
    Pack pack = good_pack();
    change(texel(pack, 0, tile, 5, 15)[0]);
    const auto issues = check_texels(pack);
    INFO(listing(issues));
    REQUIRE(issues.size() == 1);
    CHECK(issues[0].where.find(fmt::format("tile {}, south edge (color ", tile)) != std::string::npos);
  }
}

TEST_CASE("a texel is named by its place in the image, so that it is found in an editor") {
  Pack pack = good_pack();
  const Cell cell = cell_of(pack, 11);
  change(texel(pack, 0, 11, 15, 6)[0]);
  const auto issues = check_texels(pack);
  REQUIRE(issues.size() == 1);
  const std::string place = fmt::format("({}, {})", cell.column * 16 + 15, cell.row * 16 + 6);
  CHECK(issues[0].found.find(place) != std::string::npos);
}

TEST_CASE("without a guard or sanitized levels, differing borders are a warning") {
  Pack pack = good_pack({.guard = 0, .mips = MipMode::box});
  const auto issues = check_structure(pack);
  CHECK(has(issues, Rule::edge_texels_unpromised));
  CHECK(count(issues).errors == 0);
}

TEST_CASE("sanitized levels take it that level 0 agrees along edges, guard or not") {
  const Pack pack = good_pack({.guard = 0});
  CHECK(has(check_structure(pack), Rule::edge_texels));
}

TEST_CASE("mips that promise nothing about borders are not held to it") {
  Pack pack = good_pack({.guard = 1, .mips = MipMode::box});
  change(texel(pack, 2, 9, 1, 3)[0]);
  CHECK(check_texels(pack).empty());
}

TEST_CASE("border texels of fitted levels are fitted again") {
  for (const Depth depth : {Depth::u8, Depth::u16, Depth::f32})
    for (const int guard : {1, 2}) {
      Pack pack = good_pack({.guard = guard, .depth = depth, .mips = MipMode::least_squares});
      CHECK(listing(check_structure(pack)) == "");
      float& value = texel(pack, 3, 9, 1, 0)[2];
      const float was = value;
      value = quantised(was > 0.5f ? was - 0.04f : was + 0.04f, depth);
      const auto issues = check_fitted_borders(pack);
      REQUIRE(issues.size() == 1);
      CHECK(issues[0].rule == Rule::fitted_border);
      CHECK(issues[0].where == "map color, level 3, tile 9");
      value = was;
      pack.jump_weight = 100; // another fit
      CHECK(has(check_fitted_borders(pack), Rule::fitted_border));
      pack.jump_weight.reset(); // of a pack that does not tell, nothing is asked
      CHECK(check_fitted_borders(pack).empty());
    }
}

TEST_CASE("a fit is not asked of packs with other faults") {
  Pack pack = good_pack({.guard = 1, .mips = MipMode::least_squares});
  texel(pack, 0, 9, 7, 7)[0] = std::numeric_limits<float>::quiet_NaN();
  edges(pack)[3].west = 7;
  CHECK(check_fitted_borders(pack).empty());
}

TEST_CASE("sanitized corners are checked when promised") {
  Pack pack = good_pack();
  pack.mip_mode = MipMode::corners;
  CHECK(has(check_texels(pack), Rule::sanitized_corners));
  for (int level = 1; level < pack.tile_levels; ++level) {
    const Size size = level_size(pack.tile_size, level);
    for (int tile = 0; tile < tile_count(pack.tiles); ++tile)
      for (const int x : {0, size.width - 1})
        for (const int y : {0, size.height - 1}) std::ranges::fill(texel(pack, level, tile, x, y), 0.0f);
  }
  const auto issues = check_texels(pack);
  INFO(listing(issues));
  CHECK(issues.empty());
}

TEST_CASE("an index map may use an incomplete set, but neighbours must agree") {
  Pack pack = good_pack();
  pack.mapping = {MappingKind::index, {2, 1}, {}, 0, {0, 0}};
  edges(pack)[5] = edges(pack)[6];
  CHECK_FALSE(has(check_tiles(pack), Rule::tile_repeated));
  CHECK(check_mapping(pack).empty());
  pack.mapping.ids = {0, 16};
  CHECK(has(check_mapping(pack), Rule::index_id));
  pack.mapping.ids = {0, 1}; // tile 1 has a west edge of color 1, tile 0 none
  CHECK(has(check_mapping(pack), Rule::index_colors));
  pack.mapping.ids = {0};
  CHECK(has(check_mapping(pack), Rule::index_size));
}

TEST_CASE("a NaN in a border does not hide other faults nor crash the comparison") {
  Pack pack = good_pack({.depth = Depth::f32});
  for (int tile = 0; tile < 16; ++tile)
    texel(pack, 0, tile, 7, 0)[0] = std::numeric_limits<float>::quiet_NaN();
  change(texel(pack, 0, 3, 8, 0)[0]);
  const auto issues = check_texels(pack);
  CHECK(has(issues, Rule::not_finite));
  CHECK(has(issues, Rule::edge_texels));
}

TEST_CASE("an empty pack is full of issues but does no harm") {
  Pack pack;
  pack.tile_levels = 1;
  CHECK_FALSE(check_structure(pack).empty());
}
