#include "tilepack/mip/alpha_coverage.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/mip/normal_variance.h"
#include "tilepack/numeric/random.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>

using namespace tilepack;

namespace {

// A material of one 8 × 8 tile: normals that lean by `lean` east and west by turns, and a flat roughness.
TileSet material(double lean, float roughness) {
  TileSet set{{8, 8}, {1, 1, 0}, complete_edge_set(1, 1), {}, 0};
  Image normals(8, 8, 3);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const auto n = normals.texel(x, y);
      n[0] = static_cast<float>((x % 2 == 0 ? lean : -lean) * 0.5 + 0.5);
      n[1] = 0.5f;
      n[2] = static_cast<float>(std::sqrt(1 - lean * lean) * 0.5 + 0.5);
    }
  set.maps.push_back(
      {"roughness", Role::roughness, Encoding::linear, Depth::u8, {Image(8, 8, 1, roughness)}});
  set.maps.push_back({"normal", Role::normal, Encoding::linear, Depth::u8, {normals}});
  return set;
}

} // namespace

TEST_CASE("roughness takes up the spread of the normals it covers") {
  const double lean = 0.6;
  const auto chain = mip_chain(material(lean, 0.3f), 0, {});
  const double length = std::sqrt(1 - lean * lean); // of the mean of the two directions
  const double spread = (1 - length) / length;
  const double expected = std::pow(std::pow(0.3, 4) + 2 * spread, 0.25);
  for (std::size_t level = 1; level < 4; ++level)
    CHECK(chain[level].tiles[0].texel(0, 0)[0] == Approx(expected).margin(1e-6));
  CHECK(chain[0].tiles[0].texel(0, 0)[0] == 0.3f);
}

TEST_CASE("flat normals change no roughness, and the option leaves it as it is") {
  for (const TileMap& level : mip_chain(material(0.0, 0.02f), 0, {}))
    CHECK(level.tiles[0].texel(0, 0)[0] == 0.02f);
  MipOptions plain;
  plain.roughness_from_normals = false;
  for (const TileMap& level : mip_chain(material(0.6, 0.3f), 0, plain))
    CHECK(level.tiles[0].texel(0, 0)[0] == 0.3f);
}

TEST_CASE("roughness inside a packed map takes up the spread too, and gloss its opposite") {
  const double lean = 0.6;
  TileSet set = material(lean, 0.3f);
  TileMap& packed = set.maps.emplace_back();
  packed.name = "orm";
  packed.role = Role::data;
  packed.encoding = Encoding::linear;
  packed.contents = {ChannelContent::ao, ChannelContent::roughness, ChannelContent::metallic,
                     ChannelContent::gloss};
  Image texels(8, 8, 4, 0.3f);
  for (int i = 0; i < 64; ++i) texels.texel(i % 8, i / 8)[3] = 0.7f;
  packed.tiles = {texels};
  const auto roughness = mip_chain(set, 0, {});
  const auto chain = mip_chain(set, 2, {});
  for (std::size_t level = 1; level < 4; ++level) {
    const auto texel = chain[level].tiles[0].texel(0, 0);
    CHECK(texel[0] == Approx(0.3f));
    CHECK(texel[1] == roughness[level].tiles[0].texel(0, 0)[0]);
    CHECK(texel[2] == Approx(0.3f));
    CHECK(texel[3] == Approx(1.0f - texel[1]).margin(1e-6));
    CHECK(chain[level].contents == packed.contents);
  }
  MipOptions plain;
  plain.roughness_from_normals = false;
  CHECK(mip_chain(set, 2, plain)[3].tiles[0].texel(0, 0)[1] == Approx(0.3f));
}

TEST_CASE("roughness stays within 0 to 1, even where the normals cancel out") {
  Image roughness(1, 1, 2, 0.5f);
  const MapFormat format{"roughness", Role::roughness};
  add_normal_variance(roughness, Image(1, 1, 3, 0.0f), roughness_channels(format, 2));
  CHECK(roughness.texel(0, 0)[0] == 1.0f);
  CHECK(roughness.texel(0, 0)[1] == 0.5f); // alpha
}

TEST_CASE("coverage of a cut-out texture is kept at every level, and lost without the option") {
  TileSet set{{32, 32}, {2, 1, 0}, complete_edge_set(2, 1), {}, 0};
  TileMap map{"leaves", Role::color, Encoding::srgb, Depth::u8, {}};
  std::uint64_t index = 0;
  for (int id = 0; id < 4; ++id) {
    Image tile(32, 32, 4, 0.25f);
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) // three texels in ten opaque
        tile.texel(x, y)[3] = random_below(2, "leaf", index++, 10) < 3 ? 1.0f : 0.0f;
    map.tiles.push_back(tile);
  }
  set.maps.push_back(map);
  MipOptions options;
  options.mode = MipMode::edges;
  const double coverage = alpha_coverage(map.tiles, 0.5);
  CHECK(coverage == Approx(0.3).margin(0.05));
  CHECK(alpha_coverage(mip_chain(set, 0, options)[3].tiles, 0.5) < 0.1);
  options.alpha_coverage = 50;
  const auto chain = mip_chain(set, 0, options);
  for (std::size_t level = 1; level < 4; ++level) {
    std::vector<Image> stored;
    for (const Image& tile : chain[level].tiles) stored.push_back(quantised(tile, Depth::u8));
    // As near as values shared by several tiles allow.
    CHECK(alpha_coverage(stored, 0.5) == Approx(coverage).margin(0.08));
  }
  // Sanitized texels are still equal.
  CHECK(chain[1].tiles[0].texel(5, 0)[3] == chain[1].tiles[1].texel(5, 0)[3]);
}

TEST_CASE("coverage of none and of all changes nothing") {
  std::vector<Image> tiles{Image(2, 2, 4, 0.3f)};
  const std::vector<Image> before = tiles;
  keep_alpha_coverage(tiles, 0.5, 0.0);
  CHECK(tiles == before);
  keep_alpha_coverage(tiles, 0.5, 1.0);
  CHECK(tiles == before);
}
