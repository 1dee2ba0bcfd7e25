#include "support/small_pack.h"

#include "tilepack/bake/packing.h"
#include "tilepack/error/error.h"
#include "tilepack/layout/de_bruijn.h"
#include "tilepack/sampler/fast_sampler.h"
#include "tilepack/sampler/ground_truth.h"
#include "tilepack/sampler/reference_sampler.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace tilepack;

namespace {

struct Places {
  std::vector<std::int32_t> tile_x, tile_y;
  std::vector<float> x, y, level;

  void add(std::int32_t tx, float fx, std::int32_t ty, float fy, float l) {
    tile_x.push_back(tx);
    tile_y.push_back(ty);
    x.push_back(fx);
    y.push_back(fy);
    level.push_back(l);
  }
  SampleBatch batch() const {
    return {x.size(), tile_x.data(), tile_y.data(), x.data(), y.data(), level.data()};
  }
};

float unit(std::uint64_t index) {
  return static_cast<float>(random_below(11, "place", index, 1u << 24)) / static_cast<float>(1 << 24);
}

// Runs of neighbours as a renderer asks for them, then places all over, then awkward ones.
Places all_kinds_of_places() {
  Places p;
  for (int run = 0; run < 40; ++run) {
    const auto r = static_cast<std::uint64_t>(run) * 8;
    const auto tx = static_cast<std::int32_t>(random_below(1, "x", r, 200)) - 100;
    const auto ty = static_cast<std::int32_t>(random_below(1, "y", r, 200)) - 100;
    const float step = unit(r) * 0.1f;
    const float level = unit(r + 1) * 5 - 1;
    for (int k = 0; k < 37; ++k)
      p.add(tx, unit(r + 2) + step * static_cast<float>(k), ty, unit(r + 3),
            level + 0.01f * static_cast<float>(k));
  }
  for (std::uint64_t k = 0; k < 1500; ++k)
    p.add(static_cast<std::int32_t>(random_bits(2, "x", k)), unit(3000 + 3 * k),
          static_cast<std::int32_t>(random_bits(2, "y", k)), unit(3001 + 3 * k) * 3 - 1,
          unit(3002 + 3 * k) * 6 - 1);
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float odd : {0.0f, -0.0f, std::nextafter(1.0f, 0.0f), 1.0f, -1.0f, 0.5f, 3.0625f, -2.9375f,
                          4194304.0f, 1e9f, -3e9f, 1e18f, 1e30f, infinity, -infinity, std::nanf("")})
    for (const std::int32_t tile :
         {0, -1, 5, std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min()})
      for (const float level : {0.0f, 1.25f, 99.0f, -infinity, infinity, std::nanf("")}) {
        p.add(tile, odd, 3, 0.3f, level);
        p.add(2, 0.7f, tile, odd, level);
      }
  return p;
}

std::array<std::vector<float>, 4> looked_up(const FastSampler& sampler, const SampleBatch& batch,
                                            Filter filter, Weights weights = Weights::exact,
                                            bool parallel = false) {
  std::array<std::vector<float>, 4> out;
  std::array<float*, 4> targets{};
  const auto channels = static_cast<std::size_t>(sampler.channels());
  for (std::size_t c = 0; c < channels; ++c) {
    out[c].assign(batch.count + 1, -7.0f); // one more, to see that nothing is written beyond the end
    targets[c] = out[c].data();
  }
  const std::span<float* const> span(targets.data(), channels);
  if (parallel)
    sampler.sample_parallel(batch, filter, weights, span);
  else
    sampler.sample(batch, filter, weights, span);
  for (std::size_t c = 0; c < channels; ++c) {
    REQUIRE(out[c].back() == -7.0f);
    out[c].pop_back();
  }
  return out;
}

// The largest difference from the reference. Where alpha is 0 the two differ in color by definition.
double largest_error(const Pack& pack, const FastSampler& fast, Filter filter, const Places& places) {
  const ReferenceSampler reference(pack, 0);
  const auto got = looked_up(fast, places.batch(), filter);
  const auto channels = static_cast<std::size_t>(fast.channels());
  double worst = 0;
  for (std::size_t i = 0; i < places.x.size(); ++i) {
    std::array<double, 4> wanted{};
    reference.sample({places.tile_x[i], static_cast<double>(places.x[i])},
                     {places.tile_y[i], static_cast<double>(places.y[i])},
                     static_cast<double>(places.level[i]), filter,
                     std::span<double>(wanted.data(), channels));
    for (std::size_t c = 0; c < channels; ++c) {
      const double error = std::fabs(wanted[c] - static_cast<double>(got[c][i]));
      worst = std::isfinite(error) ? std::max(worst, error) : std::numeric_limits<double>::infinity();
    }
  }
  return worst;
}

void check_all_targets(const Pack& pack, TexelStorage storage, double tolerance) {
  const Places places = all_kinds_of_places();
  for (const std::string& target : fast_sampler_targets())
    for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear}) {
      const FastSampler fast(pack, 0, target);
      CAPTURE(target, name_of(filter));
      CHECK(fast.storage() == storage);
      CHECK(largest_error(pack, fast, filter, places) < tolerance);
    }
}

constexpr double float_rounding = 4e-6; // of weights: tile side 8, values up to 1
constexpr double u16_rounding = 0.51 / 65535;

} // namespace

TEST_CASE("the fast sampler is the reference for every kind of texel") {
  struct Kind {
    Encoding encoding;
    Depth depth;
    int channels;
    TexelStorage storage;
  };
  for (const Kind& kind : {Kind{Encoding::linear, Depth::u8, 3, TexelStorage::u8},
                           Kind{Encoding::srgb, Depth::u8, 3, TexelStorage::u16},
                           Kind{Encoding::linear, Depth::u16, 1, TexelStorage::u16},
                           Kind{Encoding::srgb, Depth::u16, 3, TexelStorage::f32},
                           Kind{Encoding::linear, Depth::f16, 3, TexelStorage::f16},
                           Kind{Encoding::linear, Depth::f32, 1, TexelStorage::f32}}) {
    SmallPack wanted;
    wanted.encoding = kind.encoding;
    wanted.depth = kind.depth;
    wanted.channels = kind.channels;
    check_all_targets(small_pack(wanted), kind.storage, float_rounding + u16_rounding);
  }
}

TEST_CASE("the fast sampler is the reference for every mapping") {
  const ColorCounts colors{3, 2, 0};
  for (const VirtualSize size :
       {VirtualSize{6, 5}, VirtualSize{16, 64}, VirtualSize{1, 1}, VirtualSize{7, 1}}) {
    SmallPack wanted;
    wanted.colors = colors;
    wanted.encoding = Encoding::linear;
    wanted.virtual_size = size;
    Pack pack = small_pack(wanted);
    check_all_targets(pack, TexelStorage::u8, float_rounding);
    pack.mapping = index_mapping(pack.mapping, colors);
    check_all_targets(pack, TexelStorage::u8, float_rounding);
  }
  SmallPack wanted;
  wanted.colors = colors;
  wanted.encoding = Encoding::linear;
  Pack pack = small_pack(wanted);
  const std::int64_t side = std::int64_t{1} << 31;
  for (const VirtualSize size :
       {VirtualSize{side, side}, VirtualSize{side - 1, 3}, VirtualSize{1 << 20, 1000003}}) {
    pack.mapping = mix_mapping(size, 99);
    check_all_targets(pack, TexelStorage::u8, float_rounding);
  }
}

TEST_CASE("a permutation shorter than the texture is read modulo its length") {
  SmallPack wanted;
  wanted.encoding = Encoding::linear;
  wanted.virtual_size = {50, 40};
  Pack pack = small_pack(wanted);
  for (const int length : {8, 13}) {
    pack.mapping.table = permutation_table(length, 3);
    check_all_targets(pack, TexelStorage::u8, float_rounding);
  }
}

TEST_CASE("corner-colored packs are looked up too") {
  SmallPack wanted;
  wanted.encoding = Encoding::linear;
  Pack pack = small_pack(wanted);
  pack.colors = {0, 0, 2};
  const auto tiles = complete_corner_set(2);
  pack.tiles = tiles;
  pack.layout = de_bruijn_layout(tiles);
  pack.mapping = permutation_mapping({6, 5}, pack.colors, 4);
  check_all_targets(pack, TexelStorage::u8, float_rounding);
  pack.mapping = mix_mapping({1000, 1 << 20}, 4);
  check_all_targets(pack, TexelStorage::u8, float_rounding);
  for (const VirtualSize size : {VirtualSize{6, 5}, VirtualSize{1000, 1 << 20}}) {
    pack.mapping = even_mapping(size, 2, 4);
    check_all_targets(pack, TexelStorage::u8, float_rounding);
  }
}

TEST_CASE("odd tiles and tiles of one texel are looked up as others") {
  // Filters that weigh; nearest may fall on either side of a texel's border where a fraction has no exact
  // place.
  for (const Size tile : {Size{1, 1}, Size{7, 5}, Size{13, 2}}) {
    SmallPack wanted;
    wanted.tile_size = tile;
    wanted.encoding = Encoding::linear;
    const Pack pack = small_pack(wanted);
    for (const std::string& target : fast_sampler_targets())
      for (const Filter filter : {Filter::bilinear, Filter::trilinear})
        CHECK(largest_error(pack, FastSampler(pack, 0, target), filter, all_kinds_of_places()) <
              float_rounding);
  }
}

TEST_CASE("colors are weighed by alpha in the fast sampler") {
  SmallPack wanted;
  wanted.channels = 4;
  Pack pack = small_pack(wanted);
  for (Image& level : pack.maps[0].levels)
    for (std::size_t i = 3; i < level.data().size(); i += 4)
      level.data()[i] = quantised(0.25f + 0.75f * level.data()[i], Depth::u8);
  check_all_targets(pack, TexelStorage::f32, 4 * float_rounding);
}

TEST_CASE("where alpha is 0, so are the colors of the fast sampler") {
  SmallPack wanted;
  wanted.channels = 2;
  Pack pack = small_pack(wanted);
  for (Image& level : pack.maps[0].levels)
    for (std::size_t i = 1; i < level.data().size(); i += 2) level.data()[i] = 0;
  const auto out = looked_up(FastSampler(pack, 0), all_kinds_of_places().batch(), Filter::trilinear);
  for (const float value : out[0]) REQUIRE(value == 0.0f);
}

TEST_CASE("threads and batch lengths change no bit") {
  const Pack pack = small_pack();
  Places places;
  for (std::uint64_t k = 0; k < 50000; ++k)
    places.add(static_cast<std::int32_t>(k / 400), unit(k % 9000), 4, unit(k % 7777), unit(k % 5555) * 4);
  const FastSampler fast(pack, 0);
  const auto whole = looked_up(fast, places.batch(), Filter::trilinear);
  CHECK(looked_up(fast, places.batch(), Filter::trilinear, Weights::exact, true) == whole);
  for (const std::size_t count : {0, 1, 15, 63, 64, 65, 1000}) {
    SampleBatch part = places.batch();
    part.count = count;
    const auto got = looked_up(fast, part, Filter::trilinear);
    for (std::size_t c = 0; c < 3; ++c)
      REQUIRE(std::equal(got[c].begin(), got[c].end(), whole[c].begin(),
                         whole[c].begin() + static_cast<std::ptrdiff_t>(count)));
  }
}

TEST_CASE("arrays left out are zeros") {
  const Pack pack = small_pack();
  const std::vector<float> x{0.3f, 1.7f, -4.2f};
  const std::vector<std::int32_t> no_tiles(3, 0);
  const std::vector<float> no_level(3, 0.0f);
  const FastSampler fast(pack, 0);
  CHECK(looked_up(fast, {3, nullptr, nullptr, x.data(), x.data(), nullptr}, Filter::trilinear) ==
        looked_up(fast, {3, no_tiles.data(), no_tiles.data(), x.data(), x.data(), no_level.data()},
                  Filter::trilinear));
}

TEST_CASE("fixed weights are the weights of positions on a grid of 256 a texel") {
  SmallPack wanted;
  wanted.encoding = Encoding::linear;
  const Pack pack = small_pack(wanted);
  const ReferenceSampler reference(pack, 0);
  Places places;
  for (std::uint64_t k = 0; k < 500; ++k) places.add(3, unit(2 * k), 2, unit(2 * k + 1), 0.0f);
  for (const std::string& target : fast_sampler_targets()) {
    const auto got =
        looked_up(FastSampler(pack, 0, target), places.batch(), Filter::bilinear, Weights::fixed_8_8);
    for (std::size_t i = 0; i < places.x.size(); ++i) {
      const auto on_grid = [](float fraction) {
        return std::nearbyint(static_cast<double>(fraction) * 8 * 256) / 2048;
      };
      std::array<double, 3> wanted_value{};
      // A grid place on the tile's east border is read from this tile, as the hardware does.
      const double x = on_grid(places.x[i]);
      const double y = on_grid(places.y[i]);
      if (x >= 1 || y >= 1) continue;
      reference.sample({3, x}, {2, y}, 0, Filter::bilinear, wanted_value);
      for (std::size_t c = 0; c < 3; ++c)
        REQUIRE(static_cast<double>(got[c][i]) == Approx(wanted_value[c]).margin(float_rounding));
    }
  }
}

TEST_CASE("a plain texture is looked up over its whole side") {
  SmallPack wanted;
  wanted.colors = {1, 1, 0};
  wanted.encoding = Encoding::linear;
  const Pack pack = small_pack(wanted);
  const FastSampler plain(pack.maps[0], pack.tile_size);
  CHECK(largest_error(pack, plain, Filter::trilinear, all_kinds_of_places()) < float_rounding);
}

TEST_CASE("arrays are looked up with the texels beyond their layers") {
  for (const int border : {0, 4}) {
    SmallPack wanted;
    wanted.encoding = Encoding::linear;
    Pack pack = small_pack(wanted);
    PackingOptions options;
    options.layout = LayoutKind::array;
    options.array.border = border;
    options.mips.mode = MipMode::edges;
    options.virtual_size = {40, 50};
    pack = packed(tile_set_of(pack), options, 3);
    REQUIRE(pack.maps[0].levels.size() > 1);
    check_all_targets(pack, TexelStorage::u8, float_rounding);
  }
}

TEST_CASE("corner packs are blended in") {
  SmallPack wanted;
  wanted.encoding = Encoding::linear;
  wanted.tile_size = {32, 16};
  Pack pack = small_pack(wanted);
  PackingOptions options;
  options.corner_pack = true;
  options.virtual_size = {40, 50};
  pack = packed(tile_set_of(pack), options, 3);
  pack.corner_pack->width = 8; // of tiles without anything in common it is 0
  const Places places = all_kinds_of_places();
  for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear})
    CHECK(largest_error(pack, FastSampler(pack, 0), filter, places) < float_rounding * 4);
  const FastSampler fast(pack, 0);
  CHECK(looked_up(fast, places.batch(), Filter::trilinear) ==
        looked_up(fast, places.batch(), Filter::trilinear, Weights::exact, true));
}

TEST_CASE("what the fast sampler can't look up is an error") {
  Pack pack = small_pack();
  CHECK_THROWS_AS(FastSampler(pack, 1), Error);
  CHECK_THROWS_AS(FastSampler(pack, 0, "ABACUS"), Error);
  pack.layout.kind = LayoutKind::rotated;
  CHECK_THROWS_WITH(FastSampler(pack, 0), Catch::Contains("reference sampler"));
}
