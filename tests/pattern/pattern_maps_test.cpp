#include "pattern/pattern_scenes.h"

#include <tbb/parallel_for.h>

#include <catch2/catch.hpp>

using namespace tilepack;
using namespace tilepack::test;

namespace {

/// A stone of the set: color with alpha, height and normal, each of its own; only the middle is there.
std::shared_ptr<const PatternSource> stones() {
  Image color(16, 16, 4), height(16, 16, 1), normal(16, 16, 3);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const bool there = x >= 4 && x < 12 && y >= 4 && y < 12;
      const auto texel = color.texel(x, y);
      texel[0] = 0.75f;
      texel[3] = there ? 1.0f : 0.0f;
      height.texel(x, y)[0] = 0.9f;
      normal.texel(x, y)[0] = 0.8f;
      normal.texel(x, y)[1] = 0.5f;
      normal.texel(x, y)[2] = 0.9f;
    }
  Pack pack = pattern_pack({color}, {"color", Role::color, Encoding::linear, Depth::f32});
  pack.maps.push_back(pattern_pack({height}, {"height", Role::height, Encoding::linear, Depth::f32}).maps[0]);
  pack.maps.push_back(pattern_pack({normal}, {"normal", Role::normal, Encoding::linear, Depth::f32}).maps[0]);
  return source_of(std::make_shared<const Pack>(std::move(pack)), "stones");
}

Scene stones_on_sand() {
  Scene scene(64);
  scene.graph.maps = {{"color", Role::color, 3}, {"height", Role::height, 1}, {"normal", Role::normal, 3}};
  const NodeId sand = scene.add(ConstantTexture{{{0.25, 0.25, 0.25}, {0.125}, {0.5, 0.5, 1}}});
  const NodeId index = scene.add(ConstantIndex{0});
  const NodeId stone = scene.add(PatternsTexture{stones(), scene.grid(), index});
  scene.add(LayersTexture{{sand, stone}});
  return scene;
}

} // namespace

TEST_CASE("alpha of a pattern's color covers all its maps", "[pattern]") {
  const Scene scene = stones_on_sand();
  const PatternTexture color(scene.graph, 0), height(scene.graph, 1), normal(scene.graph, 2);
  const TileCoordinate middle{5, 0.5}, edge{5, 0.1};
  CHECK(value_at(color, middle, middle, 0.01)[0] == Approx(0.75));
  CHECK(value_at(color, edge, edge, 0.01)[0] == Approx(0.25));
  CHECK(value_at(height, middle, middle, 0.01)[0] == Approx(0.9));
  CHECK(value_at(height, edge, edge, 0.01)[0] == Approx(0.125));
  CHECK(value_at(normal, middle, middle, 0.01)[0] == Approx(0.8));
  CHECK(value_at(normal, edge, edge, 0.01)[0] == Approx(0.5));
  // A quarter of the ground is stone, as seen from afar; the normal is a unit vector again.
  for (const double width : {1.0, 3.0, 20.0}) {
    INFO(width);
    CHECK(value_at(color, middle, edge, width)[0] == Approx(0.25 + 0.25 * 0.5).margin(0.02));
    CHECK(value_at(height, middle, edge, width)[0] == Approx(0.125 + 0.25 * 0.775).margin(0.02));
    const std::vector<double> n = value_at(normal, middle, edge, width);
    const double x = 2 * n[0] - 1, y = 2 * n[1] - 1, z = 2 * n[2] - 1;
    CHECK(x * x + y * y + z * z == Approx(1));
    CHECK(x > 0.1);
  }
}

TEST_CASE("what covers nothing is clear where there is alpha, and 0 where there is none", "[pattern]") {
  Scene scene(64, {16, 16}, 4);
  scene.graph.maps.push_back({"normal", Role::normal, 3});
  const NodeId none = scene.add(ConstantIndex{-1});
  scene.add(
      PatternsTexture{source_of(std::make_shared<const Pack>(pattern_pack(
                                    spots(2, 16), {"color", Role::color, Encoding::linear, Depth::f32})),
                                "spots", {0, -1}),
                      scene.grid(), none});
  for (const double width : {0.01, 0.7, 3.0, 30.0}) {
    CHECK(value_at(PatternTexture(scene.graph, 0), {3, 0.4}, {4, 0.99}, width) ==
          std::vector<double>(4, 0.0));
    const std::vector<double> flat = value_at(PatternTexture(scene.graph, 1), {3, 0.4}, {4, 0.99}, width);
    CHECK(difference(flat, {0.5, 0.5, 1}) < 1e-6);
  }
}

TEST_CASE("no pixel is NaN, wherever it lies and whatever it covers", "[pattern]") {
  const Scene scene = stones_on_sand();
  const PatternTexture color(scene.graph, 0);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double odd : {0.0, -0.0, 1.0, -7.5, 1e18, -1e300, infinity, -infinity, std::nan("")})
    for (const double width : {0.0, 0.1, 7.0, 1e18, infinity, std::nan("")})
      for (const double value : value_at(color, {3, odd}, {-2, odd}, width)) {
        INFO(odd << " " << width);
        CHECK(std::isfinite(value));
      }
}

TEST_CASE("threads make no difference", "[pattern]") {
  const Scene scene = stones_on_sand();
  constexpr std::size_t width = 600;
  constexpr int rows = 64;
  const auto picture = [&](bool parallel) {
    const PatternTexture color(scene.graph, 0);
    std::vector<float> all(3 * width * rows);
    const auto row = [&](int y) {
      float* out[3];
      for (std::size_t c = 0; c < 3; ++c) out[c] = all.data() + (static_cast<std::size_t>(y) * 3 + c) * width;
      color.sample_run({{{0, 0.3}, {0, y * 0.07}}, 0.07, 0, width}, {y * 0.01, 0, 0, y * 0.01}, out);
    };
    if (parallel)
      tbb::parallel_for(0, rows, row);
    else
      for (int y = 0; y < rows; ++y) row(y);
    return all;
  };
  CHECK(picture(true) == picture(false));
}

TEST_CASE("slanted footprints keep near what brute force finds", "[pattern]") {
  Scene scene(64);
  const NodeId index = scene.random(4);
  scene.add(PatternsTexture{pattern_source(noise_patterns(4, {16, 16})), scene.grid(), index});
  const auto apart = [&](PatternFilter filter) {
    PatternOptions options, brute;
    options.filter = filter;
    options.coarse_map = 0;
    brute.filter = PatternFilter::supersampled;
    brute.samples = 32;
    const PatternTexture texture(scene.graph, 0, options), wanted(scene.graph, 0, brute);
    double sum = 0;
    for (std::uint64_t k = 0; k < 60; ++k) {
      const TileCoordinate u{0, 64 * chance("u", k)}, v{0, 64 * chance("v", k)};
      const Footprint footprint{0.5, 0.3, -0.02, 0.05};
      std::vector<double> a(3), b(3);
      texture.sample(u, v, footprint, a);
      wanted.sample(u, v, footprint, b);
      sum += std::pow(a[0] - b[0], 2);
    }
    return std::sqrt(sum / 60);
  };
  const double anisotropic = apart(PatternFilter::anisotropic), trilinear = apart(PatternFilter::trilinear);
  INFO(anisotropic << " " << trilinear);
  CHECK(anisotropic < 0.04);
}
