#include "support/noise_pack.h"

#include "tilepack/bake/bake_fields.h"
#include "tilepack/bake/packing.h"
#include "tilepack/error/error.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

TileSet noise_set() {
  TileSet set;
  set.tile_size = {16, 16};
  set.colors = {2, 2, 0};
  set.tiles = complete_edge_set(2, 2);
  set.maps = {{"color", Role::color, Encoding::srgb, Depth::u8, {}}};
  for (std::uint64_t i = 0; i < 16; ++i)
    set.maps[0].tiles.push_back(quantised(test::noise(16, 16, 3, i), Depth::u8));
  return set;
}

PackingOptions turned() {
  PackingOptions options;
  options.layout = LayoutKind::rotated;
  options.virtual_size = {8, 8};
  return options;
}

} // namespace

TEST_CASE("a plan says where every tile will lie and how large the texture is") {
  const TileSet set = noise_set();
  const PackingPlan plan = planned_packing(turned(), set.tiles, set.tile_size);
  const Pack pack = packed(set, plan, 1);
  CHECK(pack.layout == plan.layout);
  CHECK(pack.maps[0].levels[0].size() == plan.texture);
  CHECK(pack.mapping.kind == plan.mapping);
  CHECK(packed(set, turned(), 1).maps[0].levels == pack.maps[0].levels);
}

TEST_CASE("a rotated layout of two variants lays their toruses side by side") {
  PackingOptions options = turned();
  options.rotated.scheme = RotatedScheme{4, 0, 2};
  options.mapping = MappingKind::mix;
  for (const ColorCounts& colors : {ColorCounts{2, 2, 0, 2}, ColorCounts{0, 0, 2, 2}}) {
    const PackingPlan plan = planned_packing(options, complete_set(colors), {16, 16});
    CHECK(plan.layout.rotated.matching == Matching::found);
    CHECK(plan.layout.rotated.gutter == 0);
    CHECK(plan.texture == Size{128, 64});
  }
}

// The search is the slow part of a plan; with another plan than the search would find, its layout is what counts.
TEST_CASE("packing takes the layout from its plan and searches for none") {
  const TileSet set = noise_set();
  PackingOptions other = turned();
  other.rotated.scheme = RotatedScheme{4, 0, 1};
  other.rotated.gutter = 2;
  PackingPlan plan = planned_packing(turned(), set.tiles, set.tile_size);
  const PackingPlan second = planned_packing(other, set.tiles, set.tile_size);
  REQUIRE(!(plan.layout == second.layout));
  plan.layout = second.layout;
  CHECK(packed(set, plan, 1).layout == second.layout);
}

TEST_CASE("fields of packing are those that drawn tiles have use for") {
  std::vector<std::string> names;
  for (const BakeField& field : packing_fields()) names.push_back(field.name);
  CHECK(names == std::vector<std::string>{"seed", "layout", "scheme", "gutter", "power-of-two", "turn-filter",
                                          "border", "corner-pack", "mips", "full-mips", "jump-weight",
                                          "mapping", "virtual-size", "image-format", "depth"});
}
