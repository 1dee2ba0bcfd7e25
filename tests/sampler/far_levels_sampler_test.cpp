#include "support/images.h"
#include "support/shader_packs.h"

#include "tilepack/error/error.h"
#include "tilepack/numeric/exact_math.h"
#include "tilepack/numeric/random.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/sampler/fast_sampler.h"
#include "tilepack/sampler/pack_texture.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/render.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

using namespace tilepack;

namespace {

double drawn(std::string_view purpose, int i) {
  return static_cast<double>(random_bits(4, purpose, static_cast<std::uint64_t>(i)) >> 11) * 0x1p-53;
}

// Places whose levels lie between the last of tiles and beyond the last of all.
struct FarPlaces {
  std::vector<std::int32_t> tile_x, tile_y;
  std::vector<float> x, y, level;

  explicit FarPlaces(const Pack& pack, int count = 3001) {
    const auto far = static_cast<double>(pack.maps[0].far_levels.size());
    for (int i = 0; i < count; ++i) {
      tile_x.push_back(static_cast<std::int32_t>(drawn("tx", i) * 400) - 200);
      tile_y.push_back(static_cast<std::int32_t>(drawn("ty", i) * 400) - 200);
      x.push_back(static_cast<float>(drawn("x", i)));
      y.push_back(static_cast<float>(drawn("y", i)));
      level.push_back(static_cast<float>(pack.tile_levels - 1.5 + drawn("level", i) * (far + 1)));
    }
  }
  SampleBatch batch() const {
    return {x.size(), tile_x.data(), tile_y.data(), x.data(), y.data(), level.data()};
  }
};

double largest_difference(const Pack& pack, Filter filter, bool exact) {
  const FastSampler fast(pack, 0);
  const ReferenceSampler reference(pack, 0);
  const auto channels = static_cast<std::size_t>(fast.channels());
  const FarPlaces places(pack);
  std::array<std::vector<float>, 4> values;
  std::array<float*, 4> to{};
  for (std::size_t c = 0; c < channels; ++c) {
    values[c].resize(places.x.size());
    to[c] = values[c].data();
  }
  if (exact)
    fast.sample_exact(places.batch(), filter, Weights::exact, {to.data(), channels});
  else
    fast.sample(places.batch(), filter, Weights::exact, {to.data(), channels});
  std::array<double, 4> expected{};
  double largest = 0;
  for (std::size_t i = 0; i < places.x.size(); ++i) {
    if (exact && places.level[i] < static_cast<float>(pack.tile_levels)) continue; // partly of tiles
    reference.sample({places.tile_x[i], static_cast<double>(places.x[i])},
                     {places.tile_y[i], static_cast<double>(places.y[i])},
                     static_cast<double>(places.level[i]), filter, {expected.data(), channels});
    for (std::size_t c = 0; c < channels; ++c)
      largest = std::max(largest, std::fabs(static_cast<double>(values[c][i]) - expected[c]));
  }
  return largest;
}

} // namespace

TEST_CASE("far levels are read alike by the fast sampler and the reference") {
  int packs = 0;
  for (const test::NamedPack& named : test::shader_packs()) {
    if (!named.pack.full_chain || named.pack.layout.kind == LayoutKind::rotated) continue;
    ++packs;
    INFO(named.name);
    for (const Filter filter : {Filter::nearest, Filter::bilinear, Filter::trilinear})
      CHECK(largest_difference(named.pack, filter, false) < 2e-5);
    if (!named.pack.corner_pack) CHECK(largest_difference(named.pack, Filter::trilinear, true) < 2e-5);
  }
  CHECK(packs == 4);
}

TEST_CASE("far levels lead to the mean, the same everywhere, and leave levels of tiles as they were") {
  for (test::NamedPack& named : test::shader_packs()) {
    if (!named.pack.full_chain || named.pack.layout.kind == LayoutKind::array || named.pack.corner_pack)
      continue;
    INFO(named.name);
    Pack& pack = named.pack;
    const ReferenceSampler sampler(pack, 0);
    Pack bare = pack;
    bare.full_chain = false;
    bare.maps[0].far_levels.clear();
    const ReferenceSampler without(bare, 0);
    const Image mean = to_linear(pack.maps[0].far_levels.back(), pack.maps[0].encoding);
    REQUIRE(mean.size() == Size{1, 1});
    std::array<double, 3> value{}, other{};
    for (int i = 0; i < 100; ++i) {
      const TileCoordinate x{i * 7 - 300, drawn("x", i)}, y{i * 11 - 500, drawn("y", i)};
      for (const double level : {40.0, std::numeric_limits<double>::infinity()}) {
        sampler.sample(x, y, level, Filter::trilinear, value);
        for (std::size_t c = 0; c < 3; ++c)
          CHECK(value[c] == Approx(static_cast<double>(mean.texel(0, 0)[c])).margin(1e-6));
      }
      const double level = drawn("level", i) * (pack.tile_levels - 1);
      sampler.sample(x, y, level, Filter::trilinear, value);
      without.sample(x, y, level, Filter::trilinear, other);
      CHECK(value == other);
    }
  }
}

TEST_CASE("far levels weigh colors by alpha") {
  Pack pack = test::shader_packs().front().pack;
  pack.full_chain = true;
  PackedMap& map = pack.maps[0];
  map.channels = 4;
  map.depth = Depth::f32;
  for (std::size_t l = 0; l < map.levels.size(); ++l)
    map.levels[l] = test::noise(map.levels[l].width(), map.levels[l].height(), 4, l, Depth::f32);
  for (const Size size : {Size{2, 2}, Size{1, 1}})
    map.far_levels.push_back(test::noise(size.width, size.height, 4, 77, Depth::f32));
  CHECK(largest_difference(pack, Filter::trilinear, false) < 2e-5);
}

namespace {

// The pack of a full chain whose textures have odd sides from the fourth level on: 72, 36, 18, 9, 4, 2, 1.
Pack odd_chain() {
  for (test::NamedPack& named : test::shader_packs())
    if (named.name == "full chain, 3 corner colors") return std::move(named.pack);
  throw std::logic_error("no such pack");
}

// What a texture unit does with a texture that repeats, of which `level` is one level.
double filtered(const Image& level, double u, double v, int channel) {
  const double x = u * level.width() - 0.5, y = v * level.height() - 0.5;
  const double east = x - std::floor(x), south = y - std::floor(y);
  double sum = 0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      sum += (i == 0 ? 1 - east : east) * (j == 0 ? 1 - south : south) *
             static_cast<double>(level.texel(wrapped(static_cast<int>(std::floor(x)) + i, level.width()),
                                             wrapped(static_cast<int>(std::floor(y)) + j,
                                                     level.height()))[static_cast<std::size_t>(channel)]);
  return sum;
}

} // namespace

TEST_CASE("far levels are read as levels of a plain texture at the place of the tile") {
  const Pack pack = odd_chain();
  const PackedMap& map = pack.maps[0];
  const ReferenceSampler reference(pack, 0);
  REQUIRE(map.far_levels.size() == 3);
  REQUIRE(map.far_levels[0].width() == 4);
  for (std::size_t far = 0; far < map.far_levels.size(); ++far) {
    const Image level = to_linear(map.far_levels[far], map.encoding);
    for (int i = 0; i < 200; ++i) {
      const TileCoordinate x{i * 7 - 300, drawn("x", i)}, y{i * 11 - 500, drawn("y", i)};
      const int id = tile_at(pack.mapping, pack.colors, x.tile, y.tile);
      const Cell& cell = pack.layout.cells[static_cast<std::size_t>(id)];
      const double u = (cell.column + x.fraction) / pack.layout.columns,
                   v = (cell.row + y.fraction) / pack.layout.rows;
      std::array<double, 3> value{};
      for (const Filter filter : {Filter::bilinear, Filter::trilinear}) {
        reference.sample(x, y, pack.tile_levels + static_cast<double>(far), filter, value);
        for (int c = 0; c < 3; ++c)
          CHECK(value[static_cast<std::size_t>(c)] == Approx(filtered(level, u, v, c)).margin(1e-9));
      }
    }
  }
}

TEST_CASE("windows read far levels as the reference does") {
  const Pack pack = odd_chain();
  const ReferenceSampler reference(pack, 0);
  struct Case {
    int level;
    double scale;
    Filter filter;
    double read;
  };
  for (const Case& c : {Case{0, 1.0 / 20, Filter::trilinear, exact_log2(20)},
                        {4, 1, Filter::bilinear, 4},
                        {5, 1, Filter::trilinear, 5},
                        {5, 2, Filter::trilinear, 4},
                        {4, 1, Filter::nearest, 3},
                        {6, 0.5, Filter::trilinear, 6},
                        {2, 1.0 / 6, Filter::bilinear, 2}}) {
    INFO(c.level << " at scale " << c.scale);
    const View view{{-31, 17, 40, 23}, c.level, c.scale, c.filter};
    const Renderer renderer(pack, 0, view, {Encoding::linear, Depth::f32});
    const Image image = renderer.rows(0, renderer.size().height);
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const double texel = std::exp2(c.level) / pack.tile_size.width; // in tiles
        std::array<double, 3> wanted{};
        reference.sample({0, (-31 + (x + 0.5) / c.scale) * texel}, {0, (17 + (y + 0.5) / c.scale) * texel},
                         c.read, c.filter, wanted);
        for (std::size_t i = 0; i < 3; ++i)
          REQUIRE(static_cast<double>(image.texel(x, y)[i]) == Approx(wanted[i]).margin(1e-6));
      }
  }
  CHECK_THROWS_AS(Renderer(pack, 0, {{0, 0, 1, 1}, 7, 1, Filter::trilinear}, {}), Error);
}

TEST_CASE("views read far levels as the reference does, down to the mean") {
  const Pack pack = odd_chain();
  const ReferenceSampler reference(pack, 0);
  std::array<double, 3> value{}, wanted{};
  for (const ViewFilter filter : {ViewFilter::trilinear, ViewFilter::anisotropic}) {
    const PackTexture texture(pack, 0, filter);
    for (const double texels :
         {1.0, 5.0, 11.0, 23.0, 50.0, 1e6}) { // as large as the pixel is, along both axes
      const double step = texels / pack.tile_size.width;
      for (int i = 0; i < 50; ++i) {
        const TileCoordinate x{i * 3 - 60, drawn("x", i)}, y{i * 5 - 90, drawn("y", i)};
        texture.sample(x, y, {step, 0, 0, step}, value);
        reference.sample(x, y, exact_log2(texels), Filter::trilinear, wanted);
        for (std::size_t c = 0; c < 3; ++c) CHECK(value[c] == Approx(wanted[c]).margin(1e-9));
      }
    }
  }
}
