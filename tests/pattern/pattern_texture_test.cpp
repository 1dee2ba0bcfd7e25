#include "pattern/pattern_scenes.h"
#include "support/small_pack.h"

#include "tilepack/sampler/fast_sampler.h"

#include <catch2/catch.hpp>
#include <chrono>

using namespace tilepack;
using namespace tilepack::test;

namespace {

PatternOptions with(PatternFilter filter) {
  PatternOptions options;
  options.filter = filter;
  return options;
}

} // namespace

TEST_CASE("a basic tiling shows in each cell the pattern of its number", "[pattern]") {
  const HashKind hash = GENERATE(HashKind::mix, HashKind::chain);
  const std::vector<Image> images = noise_patterns(5, {16, 16});
  Scene scene(std::int64_t{1} << 31);
  const NodeId index = scene.random(5, 0, hash);
  scene.add(PatternsTexture{pattern_source(images), scene.grid(), index});
  const PatternTexture texture(scene.graph, 0, with(PatternFilter::nearest));
  for (std::uint64_t k = 0; k < 300; ++k) {
    const auto cell = static_cast<std::int64_t>(random_below(1, "cell", k, 0x7fffffff));
    const int x = static_cast<int>(random_below(1, "x", k, 16)),
              y = static_cast<int>(random_below(1, "y", k, 16));
    const TileCoordinate u{cell, (x + 0.5) / 16}, v{cell / 3, (y + 0.5) / 16};
    const auto pattern = static_cast<std::size_t>(index_at(scene.graph, index, {u, v}));
    const auto texel = images[pattern].texel(x, y);
    CHECK(difference(value_at(texture, u, v, 1.0 / 16), {texel[0], texel[1], texel[2]}) < 1e-6);
  }
}

TEST_CASE("a Wang pack in a scene is the pack itself", "[pattern]") {
  const auto pack = std::make_shared<const Pack>(small_pack());
  Scene scene(60, {8, 8});
  scene.add(WangTexture{source_of(pack, "small"), scene.grid()});
  const PatternTexture texture(scene.graph, 0);
  const FastSampler sampler(*pack, 0);
  constexpr std::size_t count = 700;
  std::vector<float> values[3], expected[3], x(count), y(count), level(count, 0.25f);
  std::vector<std::int32_t> tile_x(count, 50), tile_y(count, 3);
  float *out[3], *to[3];
  for (int c = 0; c < 3; ++c) {
    values[c].resize(count);
    expected[c].resize(count);
    out[c] = values[c].data();
    to[c] = expected[c].data();
  }
  const double step = std::exp2(0.25) / 8;
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = static_cast<float>(0.3 + static_cast<double>(i) * step);
    y[i] = 0.7f;
  }
  sampler.sample({count, tile_x.data(), tile_y.data(), x.data(), y.data(), level.data()}, Filter::trilinear,
                 Weights::exact, to);
  texture.sample_run({{{50, 0.3}, {3, 0.7}}, step, 0, count}, {step, 0, 0, step}, out);
  double largest = 0;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < count; ++i)
      largest = std::max(largest, static_cast<double>(std::fabs(values[c][i] - expected[c][i])));
  CHECK(largest < 2e-4); // x in floats far from its tile
}

TEST_CASE("a run is what its pixels are", "[pattern]") {
  Scene scene(64);
  const NodeId index = scene.random(4);
  const NodeId ground =
      scene.add(PatternsTexture{pattern_source(noise_patterns(4, {16, 16})), scene.grid(), index});
  const NodeId x = scene.number(0, 1, 1), y = scene.number(0, 1, 2), turn = scene.number(0, 1, 3);
  const NodeId spot = scene.add(PatternsTexture{pattern_source(spots(4, 16)), scene.grid(), index, true,
                                                TransformFit::overflow, x, y, no_node, turn});
  scene.add(LayersTexture{{ground, spot}});
  const PatternTexture texture(scene.graph, 0);
  for (const double step : {0.02, 0.3, 1.7, 5.0}) {
    const Footprint footprint{step, 0, 0, step};
    constexpr std::size_t count = 300;
    std::vector<float> values[3];
    float* out[3];
    for (int c = 0; c < 3; ++c) {
      values[c].resize(count);
      out[c] = values[c].data();
    }
    const PatternRun run{{{62, 0.4}, {3, 0.2}}, step, 0, count}; // over the scene's border
    texture.sample_run(run, footprint, out);
    for (std::size_t i = 0; i < count; i += 7) {
      const PatternPlace place = run.at(i);
      const std::vector<double> one = value_at(texture, place.u, place.v, step);
      for (std::size_t c = 0; c < 3; ++c) {
        INFO(step << " " << i);
        REQUIRE(std::fabs(one[c] - static_cast<double>(values[c][i])) < 1e-4);
      }
    }
  }
}

TEST_CASE("nothing steps at the borders of cells", "[pattern]") {
  // Across borders of cells, 2e-7 of a cell apart: tiles whose neighbours' texels are read, moved patterns, sprites.
  Scene scene(64, {16, 16}, 4);
  const int kind = GENERATE(0, 1, 2);
  const NodeId index = scene.random(4);
  if (kind == 0) {
    std::vector<Image> opaque = noise_patterns(4, {16, 16}, 4);
    scene.add(PatternsTexture{pattern_source(opaque), scene.grid(), index});
  } else if (kind == 1) {
    const NodeId x = scene.number(0, 1, 1), y = scene.number(0, 1, 2), scale = scene.number(0.3, 1.4, 4),
                 turn = scene.number(0, 1, 3);
    scene.add(PatternsTexture{pattern_source(spots(4, 16)), scene.grid(), index, true, TransformFit::overflow,
                              x, y, scale, turn});
  } else {
    auto sprites = std::make_shared<SpriteMap>(PatternGrid{64, 64}, 32);
    for (int i = 0; i < 4000; ++i) {
      const auto k = static_cast<std::uint64_t>(i);
      Sprite sprite{
          i % 4, {{0, 64 * chance("sx", k)}, {0, 64 * chance("sy", k)}}, 0.2 + 0.5 * chance("ss", k)};
      sprite.cosine = std::cos(6.28 * chance("st", k));
      sprite.sine = std::sin(6.28 * chance("st", k));
      sprites->set(i, sprite);
    }
    scene.add(SpritesTexture{pattern_source(spots(4, 16)), sprites});
  }
  const PatternTexture texture(scene.graph, 0);
  for (const double width : {0.01, 1.0 / 16, 0.17, 0.35}) {
    double largest = 0;
    for (std::uint64_t k = 0; k < 600; ++k) {
      const auto cell = static_cast<std::int64_t>(random_below(5, "cell", k, 64));
      const double along = 64 * chance("along", k);
      constexpr double e = 1e-7;
      const auto east = value_at(texture, {cell, e}, {0, along}, width),
                 west = value_at(texture, {cell, -e}, {0, along}, width);
      const auto south = value_at(texture, {0, along}, {cell, e}, width),
                 north = value_at(texture, {0, along}, {cell, -e}, width);
      // Colors count by how much there is of them.
      const auto shown = [](std::vector<double> v) {
        for (std::size_t c = 0; c < 3; ++c) v[c] *= v[3];
        return v;
      };
      largest =
          std::max({largest, difference(shown(east), shown(west)), difference(shown(south), shown(north))});
    }
    INFO(kind << " " << width);
    CHECK(largest < 2e-4);
  }
}

TEST_CASE("a clipped transform does step, so the test above can see it", "[pattern]") {
  Scene scene(64, {16, 16}, 4);
  const NodeId index = scene.random(1);
  std::vector<Image> full{Image(16, 16, 4, 1.0f)};
  scene.add(PatternsTexture{pattern_source(full), scene.grid(), index, false, TransformFit::none});
  const NodeId select = scene.random(2, 5);
  const NodeId clear = scene.add(ConstantTexture{{{}}});
  scene.add(SelectTexture{select, {1, clear}});
  const PatternTexture texture(scene.graph, 0);
  double largest = 0;
  for (std::int64_t cell = 0; cell < 64; ++cell)
    largest = std::max(largest, difference(value_at(texture, {cell, 1e-7}, {0, 0.5}, 0.01),
                                           value_at(texture, {cell, -1e-7}, {0, 0.5}, 0.01)));
  CHECK(largest > 0.9);
}

TEST_CASE("only what is looked at is read", "[pattern]") {
  Scene scene(64);
  const auto seen = pattern_source(noise_patterns(2, {64, 64})),
             unseen = pattern_source(noise_patterns(2, {64, 64}));
  int maps_read = 0;
  const auto areas = std::make_shared<StoredMap>(Size{2, 1}, [&] {
    ++maps_read;
    Grid<float> map(2, 1);
    map.at(1, 0) = 1;
    return map;
  });
  const NodeId index = scene.random(2);
  const NodeId a = scene.add(PatternsTexture{seen, scene.grid(), index});
  const NodeId b = scene.add(PatternsTexture{unseen, scene.grid(), index});
  const NodeId area = scene.add(StoredIndex{areas});
  scene.add(SelectTexture{area, {a, b}});
  const PatternTexture texture(scene.graph, 0);
  CHECK(maps_read == 0);
  CHECK(seen->openings() == 0);
  for (int i = 1; i < 31; ++i) value_at(texture, {i, 0.5}, {i, 0.5}, 4.0 / 16); // 16 texels a pixel: level 4
  CHECK(maps_read == 1);
  CHECK(seen->openings() == 1);
  CHECK(seen->finest_level(0) == 4);
  CHECK(unseen->openings() == 0);
  CHECK(unseen->finest_level(0) == -1);
  CHECK(texture.used_nodes() == std::vector<bool>{true, true, false, true, true});
  const std::size_t coarse = seen->bytes();
  value_at(texture, {3, 0.5}, {3, 0.5}, 1.0 / 64);
  CHECK(seen->finest_level(0) == 0);
  CHECK(seen->bytes() > 10 * coarse);
  value_at(texture, {40, 0.5}, {3, 0.5}, 1.0 / 64);
  CHECK(unseen->openings() == 1);
}

TEST_CASE("memory and time don't grow with the virtual size", "[pattern]") {
  const auto source = pattern_source(noise_patterns(16, {64, 64}));
  std::vector<double> seconds;
  std::vector<std::size_t> bytes;
  for (const int bits : {10, 15, 20}) {
    Scene scene(std::int64_t{1} << bits, {64, 64});
    const NodeId index = scene.random(16);
    scene.add(PatternsTexture{source, scene.grid(), index});
    const PatternTexture texture(scene.graph, 0);
    constexpr std::size_t count = 1024;
    std::vector<float> values[3];
    float* out[3];
    for (int c = 0; c < 3; ++c) {
      values[c].resize(count);
      out[c] = values[c].data();
    }
    double best = 1e9;
    for (int round = 0; round < 7; ++round) {
      const auto start = std::chrono::steady_clock::now();
      for (int row = 0; row < 64; ++row)
        texture.sample_run({{{500, 0.25}, {300, row / 64.0}}, 1.0 / 64, 0, count}, {1.0 / 64, 0, 0, 1.0 / 64},
                           out);
      best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    seconds.push_back(best);
    bytes.push_back(texture.bytes() + source->bytes());
  }
  CHECK(bytes[2] == bytes[0]);
  // The figures are in PATTERNS.md; a busy machine is no reason to fail, growth with the size would be a thousandfold.
  CHECK(seconds[2] < 2 * seconds[0]);
}
