#include "support/noise_pack.h"

#include "tilepack/error/error.h"
#include "tilepack/lookup/material_lookup.h"

#include <catch2/catch.hpp>
#include <vector>

using namespace tilepack;

namespace {

MaterialLookup lookup_of(int variants) {
  return material_lookup(test::noise_pack(MappingKind::even, Depth::u8, 7, variants));
}

} // namespace

TEST_CASE("a tile is found by the materials at its corners", "[lookup]") {
  const Pack pack = test::noise_pack(MappingKind::even, Depth::u8, 7, 3);
  const MaterialLookup lookup = material_lookup(pack);
  const auto& tiles = std::get<std::vector<CornerTile>>(pack.tiles);
  for (std::uint32_t y = 0; y < 9; ++y)
    for (std::uint32_t x = 0; x < 9; ++x)
      for (std::uint32_t corners = 0; corners < 16; ++corners) {
        const CellColors c{corners >> 3 & 1, corners >> 2 & 1, corners >> 1 & 1, corners & 1};
        const std::uint32_t id = tile_of_corners(lookup, c, {x, y});
        REQUIRE(id < tiles.size());
        const CornerTile& t = tiles[id];
        CHECK(t == CornerTile{static_cast<int>(c.a), static_cast<int>(c.b), static_cast<int>(c.c),
                              static_cast<int>(c.d)});
        CHECK(id / 16 == variant_of_materials(lookup, {x, y}));
      }
}

TEST_CASE("where materials have several colors, a hash of the lattice point chooses", "[lookup]") {
  Pack pack = test::noise_pack(MappingKind::even, Depth::u8, 7);
  pack.colors.corner = 4;
  pack.tiles = complete_set(pack.colors);
  pack.materials = {"moss", "moss", "sand", "sand"};
  const MaterialLookup lookup = material_lookup(pack);
  CHECK(lookup.materials == 2);
  CHECK(lookup.colors() == 4);
  int second = 0;
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 0; x < 64; ++x)
      for (std::uint32_t material = 0; material < 2; ++material) {
        const std::uint32_t color = color_of_material(lookup, material, {x, y});
        CHECK(color / 2 == material);
        second += static_cast<int>(color % 2);
      }
  CHECK(second == Approx(4096).margin(200));
  CHECK(color_of_material(lookup_of(2), 1, {5, 6}) == 1);
  CHECK(tile_of_corners(lookup, {3, 2, 1, 0}, {9, 9}) == 3 * 64 + 2 * 16 + 4);
}

TEST_CASE("variants come equally often and know nothing of each other", "[lookup]") {
  const MaterialLookup lookup = lookup_of(4);
  constexpr std::uint32_t side = 128;
  constexpr double cells = side * side;
  std::vector<double> count(4), pairs(16);
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t here = variant_of_materials(lookup, {x, y});
      ++count[here];
      ++pairs[4 * here + variant_of_materials(lookup, {x + 1, y})];
    }
  double chi = 0, chi_of_pairs = 0;
  for (const double n : count) chi += (n - cells / 4) * (n - cells / 4) / (cells / 4);
  for (const double n : pairs) chi_of_pairs += (n - cells / 16) * (n - cells / 16) / (cells / 16);
  CHECK(chi < 16.3);          // 3 degrees of freedom, one in a thousand
  CHECK(chi_of_pairs < 37.7); // 15
  CHECK(variant_of_materials(lookup_of(1), {3, 4}) == 0);
}

TEST_CASE("only complete sets with corner colors can be looked up by materials", "[lookup]") {
  CHECK_THROWS_AS(material_lookup(test::noise_pack(MappingKind::mix)), Error);
  Pack pack = test::noise_pack(MappingKind::even);
  std::get<std::vector<CornerTile>>(pack.tiles).pop_back();
  CHECK_THROWS_AS(material_lookup(pack), Error);
}
