#include "support/noise_pack.h"

#include "tilepack/error/error.h"
#include "tilepack/pack/pack_maps.h"

#include <catch2/catch.hpp>

using namespace tilepack;
using Catch::Contains;

TEST_CASE("maps of a pack are found by name and number", "[pack]") {
  const Pack pack = test::noise_pack();
  REQUIRE(pack.maps.size() >= 2);
  CHECK(map_called(pack, "") == 0);
  for (int m = 0; m < static_cast<int>(pack.maps.size()); ++m) {
    CHECK(map_called(pack, pack.maps[static_cast<std::size_t>(m)].name) == m);
    CHECK(&map_at(pack, m) == &pack.maps[static_cast<std::size_t>(m)]);
  }
  CHECK(&level_at(pack.maps[0], 0) == &pack.maps[0].levels[0]);
}

TEST_CASE("a map or level that a pack has not is refused with those it has", "[pack]") {
  const Pack pack = test::noise_pack();
  const std::string count = std::to_string(pack.maps.size() - 1);
  CHECK_THROWS_WITH(map_called(pack, "colour"),
                    Contains("no map 'colour', did you mean 'color'?; it has color, "));
  CHECK_THROWS_WITH(map_called(pack, "q"), Contains("no map 'q'; it has color, "));
  for (const int map : {-1, static_cast<int>(pack.maps.size())})
    CHECK_THROWS_WITH(map_at(pack, map),
                      "map: " + std::to_string(map) + " is not a map of the pack; it has 0.." + count);
  const std::string levels = std::to_string(pack.maps[0].levels.size() - 1);
  for (const int level : {-1, static_cast<int>(pack.maps[0].levels.size())})
    CHECK_THROWS_WITH(level_at(pack.maps[0], level), "level: " + std::to_string(level) +
                                                         " is not stored; map color has levels 0.." + levels);
}
