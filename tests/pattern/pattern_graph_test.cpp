#include "pattern/pattern_scenes.h"

#include "tilepack/error/error.h"
#include "tilepack/pattern/animation.h"
#include "tilepack/pattern/transition_tiles.h"

#include <catch2/catch.hpp>
#include <functional>

using namespace tilepack;
using namespace tilepack::test;
using Catch::Contains;

namespace {

std::string fault(const PatternGraph& graph) {
  try {
    check_pattern_graph(graph);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::invalid_content);
    return error.what();
  }
  return "";
}

PatternOptions with(PatternFilter filter) {
  PatternOptions options;
  options.filter = filter;
  return options;
}

} // namespace

TEST_CASE("what is wrong with a graph is said of the node", "[pattern]") {
  const auto source = pattern_source(noise_patterns(4, {8, 8}));
  Scene good(64);
  const NodeId index = good.random(4);
  good.add(PatternsTexture{source, good.grid(), index});
  CHECK(fault(good.graph).empty());

  const auto broken = [&](const std::function<void(PatternGraph&)>& breaking) {
    PatternGraph graph = good.graph;
    breaking(graph);
    return fault(graph);
  };
  const auto patterns = [](PatternGraph& graph) -> PatternsTexture& {
    return std::get<PatternsTexture>(graph.nodes[1].block);
  };
  CHECK_THAT(broken([&](PatternGraph& g) { patterns(g).index = no_node; }),
             Contains("node 'n1'") && Contains("'index' is missing"));
  CHECK_THAT(broken([&](PatternGraph& g) { patterns(g).index = 1; }), Contains("does not stand before"));
  CHECK_THAT(broken([&](PatternGraph& g) { patterns(g).x = 0; }),
             Contains("'x' takes a number") && Contains("'n0' gives an index"));
  CHECK_THAT(broken([&](PatternGraph& g) { patterns(g).grid = {9, 64}; }), Contains("9 x 64"));
  CHECK_THAT(broken([&](PatternGraph& g) { patterns(g).source = nullptr; }), Contains("'source' is missing"));
  CHECK_THAT(broken([&](PatternGraph& g) { g.nodes[1].name = "n0"; }), Contains("two nodes"));
  CHECK_THAT(broken([&](PatternGraph& g) { g.output = 0; }), Contains("no texture"));
  CHECK_THAT(broken([&](PatternGraph& g) { g.output = 7; }), Contains("number 7"));
  CHECK_THAT(broken([&](PatternGraph& g) { g.scene.width = std::int64_t{1} << 40; }), Contains("2^31"));
  CHECK_THAT(broken([&](PatternGraph& g) {
               g.maps.push_back({"height", Role::height, 1});
             }),
             Contains("tells of 1 maps"));
  CHECK_THAT(broken([&](PatternGraph& g) {
               g.nodes[0].block = RandomIndex{{64, 64}, 0};
             }),
             Contains("values is 0"));
  CHECK_THAT(broken([&](PatternGraph& g) {
               g.nodes.push_back({"table", TableIndex{0, {1, 2, 3}}});
             }),
             Contains("node 'table'") && Contains("more often"));
  CHECK_THAT(broken([&](PatternGraph& g) {
               g.nodes.push_back({"dither", DitheredIndex{0, {24, 64}, {64, 64}}});
             }),
             Contains("node 'dither'"));
  CHECK_THAT(broken([&](PatternGraph& g) {
               g.nodes.push_back({"blend", HeightBlendTexture{0, {64, 64}, {1, 1}, -1, 20, 0.5}});
             }),
             Contains("node 'blend'") && Contains("width 20"));
  CHECK_THAT(broken([&](PatternGraph& g) {
               g.nodes.push_back({"transition", TransitionTexture{0, {64, 64}, {1, 1}, source}});
             }),
             Contains("node 'transition'") && Contains("need 16"));
  CHECK_THROWS_AS(PatternTexture(good.graph, 1), Error);
}

TEST_CASE("transition tiles show where materials meet, and pass through elsewhere", "[pattern]") {
  std::vector<Image> tiles;
  for (int i = 0; i < 32; ++i) tiles.push_back(Image(8, 8, 3, static_cast<float>(i) / 32));
  Scene scene(64);
  const NodeId material = scene.random(2);
  const NodeId a = scene.constant(0.9), b = scene.constant(0.7);
  scene.add(TransitionTexture{material, scene.grid(), {a, b}, pattern_source(tiles), 2});
  const PatternTexture texture(scene.graph, 0, with(PatternFilter::nearest));
  int plain = 0;
  std::vector<int> variants(2);
  for (std::int64_t y = 0; y < 64; ++y)
    for (std::int64_t x = 0; x < 64; ++x) {
      const auto at = [&](std::int64_t i, std::int64_t j) {
        return index_at(scene.graph, material, {{i, 0.5}, {j, 0.5}});
      };
      const CornerMaterials corners{at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)};
      const double shown = value_at(texture, {x, 0.3}, {y, 0.6}, 1.0 / 16)[0];
      if (corners.plain()) {
        CHECK(shown == Approx(corners.nw == 0 ? 0.9 : 0.7));
        ++plain;
        continue;
      }
      const auto tile = static_cast<std::int64_t>(std::lround(shown * 32));
      CHECK(tile % 16 == transition_code(corners, 2));
      ++variants[static_cast<std::size_t>(tile / 16)];
    }
  CHECK(plain > 300);
  CHECK(std::abs(variants[0] - variants[1]) < 300);
}

TEST_CASE("a set of several colors a material shows all cells, and corners agree", "[pattern]") {
  std::vector<Image> tiles; // 2 materials of 2 colors: a texel in each corner says its color
  for (int code = 0; code < 256; ++code) {
    Image tile(2, 2, 3);
    for (int corner = 0; corner < 4; ++corner)
      tile.texel(corner % 2, corner / 2)[0] = static_cast<float>(code >> (2 * (3 - corner)) & 3) / 4;
    tiles.push_back(tile);
  }
  Scene scene(64);
  const NodeId material = scene.random(2);
  const NodeId plain = scene.constant(0.9);
  TransitionTexture block{material, scene.grid(), {plain, plain}, pattern_source(tiles)};
  block.colors_of_material = 2;
  block.plain_from_set = true;
  scene.add(block);
  const PatternTexture texture(scene.graph, 0, with(PatternFilter::nearest));
  const auto color = [&](std::int64_t x, std::int64_t y, double in_x, double in_y) {
    return std::lround(4 * value_at(texture, {x, in_x}, {y, in_y}, 1.0 / 2)[0]);
  };
  int seen[4] = {};
  for (std::int64_t y = 0; y < 40; ++y)
    for (std::int64_t x = 0; x < 40; ++x) {
      const auto nw = color(x, y, 0.25, 0.25);
      CHECK(nw / 2 == index_at(scene.graph, material, {{x, 0.5}, {y, 0.5}}));
      CHECK(nw == color(x - 1, y, 0.75, 0.25));
      CHECK(nw == color(x, y - 1, 0.25, 0.75));
      CHECK(nw == color(x - 1, y - 1, 0.75, 0.75));
      ++seen[nw];
    }
  for (const int times : seen) CHECK(times > 300);
}

TEST_CASE("a border on clear ground lies over what is there", "[pattern]") {
  std::vector<Image> tiles;
  for (int code = 0; code < 16; ++code) {
    Image tile(8, 8, 4);
    for (int y = 0; y < 8; ++y) // the family's color in the quarters whose corner it has
      for (int x = 0; x < 8; ++x) {
        const int corner = x / 4 + 2 * (y / 4);
        const auto texel = tile.texel(x, y);
        texel[0] = 1;
        texel[3] = (code >> (3 - corner) & 1) != 0 ? 1.0f : 0.0f;
      }
    tiles.push_back(tile);
  }
  Scene scene(64);
  const NodeId material = scene.random(3);
  const NodeId inside = scene.constant(1), below = scene.constant(0.25);
  scene.add(BorderTexture{material, 2, scene.grid(), pattern_source(tiles), 1, 0, inside, below});
  const PatternTexture texture(scene.graph, 0, with(PatternFilter::nearest));
  for (std::int64_t y = 0; y < 20; ++y)
    for (std::int64_t x = 0; x < 20; ++x)
      for (int corner = 0; corner < 4; ++corner) {
        const PatternPlace at{{x + corner % 2, 0.5}, {y + corner / 2, 0.5}};
        const bool is_it = index_at(scene.graph, material, at) == 2;
        const double shown =
            value_at(texture, {x, 0.25 + 0.5 * (corner % 2)}, {y, 0.25 + 0.5 * (corner / 2)}, 1.0 / 16)[0];
        CHECK(shown == Approx(is_it ? 1 : 0.25));
      }
}

TEST_CASE("a pixel map is sharp to the pixel, and a height blend is not", "[pattern]") {
  Grid<std::uint8_t> pixels(1024, 1024);
  for (int y = 0; y < 1024; ++y)
    for (int x = 0; x < 1024; ++x) pixels.at(x, y) = x + y / 3 > 600;
  Scene scene(64);
  const NodeId material = scene.add(PixelIndex{std::make_shared<PixelMap>(pixels, 2)});
  const NodeId a = scene.constant(0), b = scene.constant(1);
  scene.add(SelectTexture{material, {a, b}});
  const PatternTexture texture(scene.graph, 0, with(PatternFilter::nearest));
  std::vector<float> red(1024), green(1024), blue(1024);
  float* out[3] = {red.data(), green.data(), blue.data()};
  texture.sample_run({{{0, 0.5 / 16}, {20, 0.5}}, 1.0 / 16, 0, 1024}, {1.0 / 16, 0, 0, 1.0 / 16}, out);
  for (int x = 0; x < 1024; ++x)
    CHECK(static_cast<int>(red[static_cast<std::size_t>(x)]) == pixels.at(x, 20 * 16 + 8));

  Scene blend(64);
  const NodeId area = blend.add(RandomIndex{{8, 8}, 2, 7});
  const NodeId c = blend.constant(0), d = blend.constant(1);
  blend.add(HeightBlendTexture{area, {8, 8}, {c, d}, -1, 16, 0.5});
  const PatternTexture smooth(blend.graph, 0);
  double largest = 0, least = 1, most = 0, before = -1;
  for (int i = 0; i < 64 * 64; ++i) {
    const double shown = value_at(smooth, {0, i / 64.0}, {0, 5.3}, 1.0 / 16)[0];
    if (before >= 0) largest = std::max(largest, std::fabs(shown - before));
    before = shown;
    least = std::min(least, shown);
    most = std::max(most, shown);
  }
  CHECK(largest < 0.05); // a quarter texel a step, 16 texels from one to the other
  CHECK(least == 0);
  CHECK(most == 1);
}

TEST_CASE("an animation map plays in each cell, and moved textures move", "[pattern]") {
  Scene scene(64);
  const NodeId phase = scene.number(0, 100, 1), rest = scene.number(0, 20, 2);
  const NodeId frame = scene.add(AnimationIndex{scene.grid(), 6, phase, rest});
  scene.constant(0);
  int changed = 0;
  for (std::int64_t x = 0; x < 64; ++x) {
    const PatternPlace place{{x, 0.5}, {3, 0.5}};
    const double z = number_at(scene.graph, rest, place), offset = number_at(scene.graph, phase, place);
    for (int t = 0; t < 40; ++t) {
      const AnimationCycle cycle{6, static_cast<std::int64_t>(z), static_cast<std::int64_t>(offset)};
      const std::int64_t shown = index_at(scene.graph, frame, place, t + 0.5);
      CHECK(shown == cycle.frame(t));
      changed += shown != 0;
    }
  }
  CHECK(changed > 100);

  Scene moving(64);
  const NodeId time = moving.add(TimeNumber{});
  const NodeId index = moving.random(4);
  const NodeId patterns =
      moving.add(PatternsTexture{pattern_source(noise_patterns(4, {16, 16})), moving.grid(), index});
  moving.add(MovedTexture{patterns, time, no_node});
  PatternOptions later;
  later.time = 63.25;
  const PatternTexture moved(moving.graph, 0, later);
  moving.graph.output = patterns;
  const PatternTexture still(moving.graph, 0);
  CHECK(difference(value_at(moved, {5, 0.5}, {3, 0.3}, 0.1), value_at(still, {6, 0.25}, {3, 0.3}, 0.1)) <
        1e-5);
}
