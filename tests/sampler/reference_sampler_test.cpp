#include "support/small_pack.h"

#include "tilepack/error/error.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/sampler/reference_sampler.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace tilepack;

namespace {

constexpr double tiny = 1e-12;

std::vector<double> sampled(const Pack& pack, TileCoordinate x, TileCoordinate y, double level,
                            Filter filter) {
  std::vector<double> out(static_cast<std::size_t>(pack.maps[0].channels));
  ReferenceSampler(pack, 0).sample(x, y, level, filter, out);
  return out;
}

// The tile of a cell, found without the sampler: the id, then its place.
Cell cell_at(const Pack& pack, std::int64_t x, std::int64_t y) {
  return pack.layout.cells[static_cast<std::size_t>(tile_at(pack.mapping, pack.colors, x, y))];
}

double linear(const Pack& pack, int level, int x, int y, int channel) {
  const Image& image = pack.maps[0].levels[static_cast<std::size_t>(level)];
  const float stored =
      image.texel(wrapped(x, image.width()), wrapped(y, image.height()))[static_cast<std::size_t>(channel)];
  return static_cast<double>(static_cast<float>(srgb_to_linear(static_cast<double>(stored))));
}

} // namespace

TEST_CASE("a texel's centre gives the texel, in linear light, by every filter") {
  const Pack pack = small_pack();
  for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear})
    for (std::int64_t cell_y = -2; cell_y < 8; cell_y += 3)
      for (std::int64_t cell_x = -9; cell_x < 9; ++cell_x)
        for (int level = 0; level < 4; ++level) {
          const int side = 8 >> level;
          const int i = side / 2;
          const Cell cell = cell_at(pack, cell_x, cell_y);
          const auto out =
              sampled(pack, {cell_x, (i + 0.5) / side}, {cell_y, (i + 0.5) / side}, level, filter);
          for (int c = 0; c < 3; ++c)
            REQUIRE(out[static_cast<std::size_t>(c)] ==
                    linear(pack, level, cell.column * side + i, cell.row * side + i, c));
        }
}

TEST_CASE("bilinear on a border reads the neighbour in the pack") {
  const Pack pack = small_pack();
  const Cell cell = cell_at(pack, 2, 3);
  const auto out = sampled(pack, {2, 0.0}, {3, 4.5 / 8}, 0, Filter::bilinear);
  const int x = cell.column * 8;
  const int y = cell.row * 8 + 4;
  for (int c = 0; c < 3; ++c)
    CHECK(out[static_cast<std::size_t>(c)] ==
          Approx((linear(pack, 0, x - 1, y, c) + linear(pack, 0, x, y, c)) / 2).margin(tiny));
}

TEST_CASE("bilinear inside weighs four texels by their distance") {
  const Pack pack = small_pack();
  const Cell cell = cell_at(pack, 4, 1);
  const auto out = sampled(pack, {4, 3.75 / 8}, {1, 6.0 / 8}, 0, Filter::bilinear);
  const int x = cell.column * 8 + 3;
  const int y = cell.row * 8 + 5;
  for (int c = 0; c < 3; ++c) {
    const double north = 0.75 * linear(pack, 0, x, y, c) + 0.25 * linear(pack, 0, x + 1, y, c);
    const double south = 0.75 * linear(pack, 0, x, y + 1, c) + 0.25 * linear(pack, 0, x + 1, y + 1, c);
    CHECK(out[static_cast<std::size_t>(c)] == Approx((north + south) / 2).margin(tiny));
  }
}

TEST_CASE("trilinear blends two levels") {
  const Pack pack = small_pack();
  const TileCoordinate x{1, 0.37};
  const TileCoordinate y{2, 0.81};
  const auto fine = sampled(pack, x, y, 1, Filter::bilinear);
  const auto coarse = sampled(pack, x, y, 2, Filter::bilinear);
  const auto blend = sampled(pack, x, y, 1.25, Filter::trilinear);
  for (std::size_t c = 0; c < 3; ++c)
    CHECK(blend[c] == Approx(0.75 * fine[c] + 0.25 * coarse[c]).margin(tiny));
}

TEST_CASE("the virtual texture wraps") {
  const Pack pack = small_pack();
  for (const std::int64_t tile : {-6, 6, 60000, -6000000})
    CHECK(sampled(pack, {2 + tile, 0.3}, {1, 0.6}, 0, Filter::bilinear) ==
          sampled(pack, {2, 0.3}, {1, 0.6}, 0, Filter::bilinear));
}

TEST_CASE("tile and fraction are one coordinate") {
  const Pack pack = small_pack();
  CHECK(sampled(pack, {0, 3.25}, {5, -2.25}, 0, Filter::bilinear) ==
        sampled(pack, {3, 0.25}, {2, 0.75}, 0, Filter::bilinear));
}

TEST_CASE("the fraction stays exact 2^31 tiles out") {
  Pack pack = small_pack();
  const std::int64_t side = std::int64_t{1} << 31;
  pack.mapping = mix_mapping({side, side}, 5);
  const Cell cell = cell_at(pack, side - 1, side - 2);
  const auto out = sampled(pack, {side - 1, 3.5 / 8}, {-2, 2.5 / 8}, 0, Filter::bilinear);
  for (int c = 0; c < 3; ++c)
    CHECK(out[static_cast<std::size_t>(c)] == linear(pack, 0, cell.column * 8 + 3, cell.row * 8 + 2, c));
}

TEST_CASE("index mappings are looked up") {
  Pack pack = small_pack();
  const auto before = sampled(pack, {4, 0.3}, {3, 0.9}, 0.5, Filter::trilinear);
  pack.mapping = index_mapping(pack.mapping, pack.colors);
  CHECK(sampled(pack, {4, 0.3}, {3, 0.9}, 0.5, Filter::trilinear) == before);
  pack.mapping.ids[3 * 6 + 4] = (pack.mapping.ids[3 * 6 + 4] + 5) % 16;
  CHECK(sampled(pack, {4, 0.3}, {3, 0.9}, 0.5, Filter::trilinear) != before);
}

TEST_CASE("odd coordinates and levels have defined results") {
  const Pack pack = small_pack();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto origin = sampled(pack, {1, 0.0}, {1, 0.5}, 0, Filter::bilinear);
  for (const double odd : {std::nan(""), infinity, -infinity}) {
    CHECK(sampled(pack, {1, odd}, {1, 0.5}, 0, Filter::bilinear) == origin);
    for (const double level : {std::nan(""), infinity, -infinity, 1e300})
      for (const double value : sampled(pack, {1, odd}, {1, odd}, level, Filter::trilinear))
        CHECK(std::isfinite(value));
  }
}

TEST_CASE("tiles of one texel, odd sides and one color are looked up as others") {
  for (const Size tile : {Size{1, 1}, Size{7, 5}, Size{1, 6}, Size{13, 13}}) {
    SmallPack wanted;
    wanted.tile_size = tile;
    const Pack pack = small_pack(wanted);
    for (double f = 0.0; f < 1.0; f += 0.0625)
      for (const double value : sampled(pack, {3, f}, {2, 1 - f}, 0.75, Filter::trilinear))
        REQUIRE((value >= 0.0 && value <= 1.0));
  }
  SmallPack wanted;
  wanted.colors = {1, 1, 0};
  const Pack pack = small_pack(wanted);
  CHECK(sampled(pack, {3, 0.4}, {2, 0.2}, 0, Filter::bilinear) ==
        sampled(pack, {0, 0.4}, {0, 0.2}, 0, Filter::bilinear));
}

TEST_CASE("colors are weighed by alpha") {
  SmallPack wanted;
  wanted.channels = 2;
  wanted.encoding = Encoding::linear;
  wanted.depth = Depth::f32;
  Pack pack = small_pack(wanted);
  const Cell cell = cell_at(pack, 0, 0);
  Image& level = pack.maps[0].levels[0];
  const auto put = [&](int i, float color, float alpha) {
    level.texel(cell.column * 8 + i, cell.row * 8)[0] = color;
    level.texel(cell.column * 8 + i, cell.row * 8)[1] = alpha;
  };
  put(2, 0.8f, 1.0f);
  put(3, 0.2f, 0.0f); // transparent: its color must not show
  put(4, 0.6f, 0.0f);
  const auto edge = sampled(pack, {0, 3.0 / 8}, {0, 0.5 / 8}, 0, Filter::bilinear);
  CHECK(edge[0] == Approx(0.8).margin(1e-7));
  CHECK(edge[1] == Approx(0.5));
  const auto gone = sampled(pack, {0, 4.0 / 8}, {0, 0.5 / 8}, 0, Filter::bilinear);
  CHECK(gone[0] == Approx(0.4).margin(1e-7));
  CHECK(gone[1] == 0.0);
}

TEST_CASE("normals are averaged as vectors and keep their length") {
  SmallPack wanted;
  wanted.role = Role::normal;
  wanted.encoding = Encoding::linear;
  wanted.channels = 4; // the fourth is no alpha in a normal map
  const Pack pack = small_pack(wanted);
  const Cell cell = cell_at(pack, 0, 0);
  const auto out = sampled(pack, {0, 3.0 / 8}, {0, 0.5 / 8}, 0, Filter::bilinear);
  for (std::size_t c = 0; c < 4; ++c) {
    const Image& level = pack.maps[0].levels[0];
    const auto a = static_cast<double>(level.texel(cell.column * 8 + 2, cell.row * 8)[c]);
    const auto b = static_cast<double>(level.texel(cell.column * 8 + 3, cell.row * 8)[c]);
    CHECK(out[c] == Approx((a + b) / 2).margin(tiny));
  }
}

TEST_CASE("a map the pack doesn't hold is an error") {
  const Pack pack = small_pack();
  CHECK_THROWS_AS(ReferenceSampler(pack, 1), Error);
  CHECK_THROWS_AS(ReferenceSampler(pack, -1), Error);
}
