#include "support/small_pack.h"

#include "tilepack/bake/packing.h"
#include "tilepack/layout/de_bruijn.h"
#include "tilepack/layout/place_tiles.h"
#include "tilepack/measure/against_reference.h"
#include "tilepack/sampler/ground_truth.h"

#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

constexpr int lookups = 400;

ReferenceErrors errors_of(const Pack& pack) {
  return against_reference(pack, 0, lookups, 1);
}

const ZoneError& zone(const ReferenceErrors& errors, int level, Zone wanted) {
  return errors.levels[static_cast<std::size_t>(level)].zones[static_cast<std::size_t>(wanted)];
}

// Corner-colored tiles of 8 x 8 texels, each texel the color of the corner it is nearest to: tiles agree on
// all they share, at edges and at corners.
Pack quarters() {
  TileSet set;
  set.tile_size = {8, 8};
  set.colors = {0, 0, 3};
  const auto tiles = complete_corner_set(3);
  set.tiles = tiles;
  set.guard = 4;
  TileMap map{"color", Role::color, Encoding::linear, Depth::f32, {}};
  for (const CornerTile& tile : tiles) {
    Image image(8, 8, 1);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const int color = y < 4 ? (x < 4 ? tile.nw : tile.ne) : (x < 4 ? tile.sw : tile.se);
        image.texel(x, y)[0] = static_cast<float>(color) / 2;
      }
    map.tiles.push_back(image);
  }
  set.maps.push_back(map);
  PackingOptions options;
  options.layout = LayoutKind::de_bruijn;
  options.mips.mode = MipMode::box;
  options.virtual_size = {20, 20};
  return packed(set, options, 1);
}

} // namespace

TEST_CASE("tiles that agree at edges and corners are looked up exactly as far as they agree") {
  const ReferenceErrors errors = errors_of(quarters());
  REQUIRE(errors.levels.size() == 4);
  for (int level = 0; level < 3; ++level)
    for (const Zone z : {Zone::interior, Zone::edge, Zone::corner}) {
      CAPTURE(level, name_of(z));
      CHECK(zone(errors, level, z).lookups == lookups);
      CHECK(zone(errors, level, z).neighbours == 0.0);
      CHECK(zone(errors, level, z).largest < 1e-4); // floats of the mip chain
    }
  // Tiles of one texel have nothing left to agree on.
  CHECK(zone(errors, 3, Zone::interior).lookups == 0);
  CHECK(zone(errors, 3, Zone::edge).lookups == 0);
  CHECK(zone(errors, 3, Zone::corner).neighbours > 1.0);
  CHECK(errors.levels[0].jump == 0.0);
  CHECK(errors.levels[0].corner_jump == 0.0);
  CHECK(errors.levels[3].corner_jump > 1.0);
}

TEST_CASE("tiles that don't agree are told from those that do, zone by zone") {
  Pack pack = quarters();
  // One texel off at the middle of every tile's west border, another in every tile: wrong across vertical
  // edges.
  float step = 0;
  for (const Cell& cell : pack.layout.cells)
    pack.maps[0].levels[0].texel(cell.column * 8, cell.row * 8 + 3)[0] = (step += 0.01f);
  const ReferenceErrors errors = errors_of(pack);
  CHECK(zone(errors, 0, Zone::interior).neighbours == 0.0);
  CHECK(zone(errors, 0, Zone::edge).neighbours > 1.0);
  CHECK(zone(errors, 0, Zone::corner).neighbours == 0.0);
  CHECK(errors.levels[0].jump > 0.0);
  CHECK(errors.levels[0].corner_jump == 0.0);
}

TEST_CASE("levels that are not mips of level 0 show against the truth and not against themselves") {
  SmallPack wanted;
  wanted.encoding = Encoding::linear;
  const ReferenceErrors errors = errors_of(small_pack(wanted));
  CHECK(zone(errors, 0, Zone::interior).rms < 1e-3);
  CHECK(zone(errors, 1, Zone::interior).rms > 10.0);
  CHECK(zone(errors, 1, Zone::interior).neighbours == 0.0);
  CHECK(zone(errors, 1, Zone::edge).neighbours > 1.0);
}

TEST_CASE("figures of a known error come out as defined") {
  Pack pack = quarters();
  for (float& v : pack.maps[0].levels[1].data()) v += 2.0f / 255;
  const ReferenceErrors errors = errors_of(pack);
  const ZoneError& error = zone(errors, 1, Zone::interior);
  CHECK(error.mean == Approx(2.0).margin(1e-3));
  CHECK(error.rms == Approx(2.0).margin(1e-3));
  CHECK(error.largest == Approx(2.0).margin(1e-3));
  REQUIRE(error.psnr);
  CHECK(*error.psnr == Approx(42.11).margin(0.01)); // 20 log10(255 / 2)
}

TEST_CASE("what doubles lose is no error") {
  // All tiles alike, so that blending with the corner pack changes nothing but last bits.
  TileSet set = tile_set_of(small_pack());
  for (TileMap& map : set.maps)
    for (Image& tile : map.tiles) tile = map.tiles.front();
  PackingOptions packing;
  packing.corner_pack = true;
  Pack pack = packed(std::move(set), packing, 1);
  pack.corner_pack->width = 4;
  const ZoneError interior = zone(against_reference(pack, 0, 2000, 1), 0, Zone::interior);
  CHECK(interior.rms > 0); // or the case tests nothing
  CHECK_FALSE(interior.psnr);
}

TEST_CASE("the reports of errors don't depend on threads") {
  const Pack pack = small_pack();
  std::string texts[2];
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    texts[threads / 4] = reference_errors_csv(against_reference(pack, lookups, 3));
  }
  CHECK(texts[0] == texts[1]);
  CHECK(texts[0] != reference_errors_csv(against_reference(pack, lookups, 4)));
}

TEST_CASE("the three forms of the errors tell the same") {
  const auto errors = against_reference(quarters(), 50, 1);
  const auto json = nlohmann::json::parse(reference_errors_json(errors));
  CHECK(json[0]["levels"].size() == 4);
  CHECK(json[0]["levels"][0]["zones"][2]["zone"] == "corner");
  CHECK(json[0]["levels"][0]["zones"][2]["neighbours"] == 0.0);
  const std::string csv = reference_errors_csv(errors);
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 13);
  CHECK(reference_errors_text(errors).find("exact") != std::string::npos);
}
