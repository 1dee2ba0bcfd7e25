#include "pattern/pattern_scenes.h"

#include <catch2/catch.hpp>

using namespace tilepack;
using namespace tilepack::test;

namespace {

PatternOptions with(PatternFilter filter, int coarse_map = 0, int samples = 24) {
  PatternOptions options;
  options.filter = filter;
  options.coarse_map = coarse_map;
  options.samples = samples;
  return options;
}

/// Root mean square of the differences of two textures over places of the scene.
double apart(const PatternTexture& a, const PatternTexture& b, double width, std::int64_t units,
             int places = 60) {
  double sum = 0;
  std::size_t count = 0;
  for (int k = 0; k < places; ++k) {
    const auto n = static_cast<std::uint64_t>(k);
    const TileCoordinate u{0, static_cast<double>(units) * chance("fu", n)},
        v{0, static_cast<double>(units) * chance("fv", n)};
    const std::vector<double> x = value_at(a, u, v, width), y = value_at(b, u, v, width);
    for (std::size_t c = 0; c < x.size(); ++c, ++count) sum += (x[c] - y[c]) * (x[c] - y[c]);
  }
  return std::sqrt(sum / static_cast<double>(count));
}

/// Two materials of eight patterns each, dithered, over areas painted in a map.
Scene dithered_scene(std::int64_t units, int side = 16) {
  Scene scene(units, {side, side});
  Grid<float> areas(8, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) areas.at(x, y) = static_cast<float>((x * 5 + y * 3) % 7 < 3);
  const NodeId area = scene.add(StoredIndex{std::make_shared<StoredMap>(areas)});
  const NodeId material = scene.add(DitheredIndex{area, {8, 8}, scene.grid(), 7});
  const NodeId random = scene.random(8);
  const NodeId index = scene.add(MaterialIndex{material, random, {{{0, 1, 2, 3}, {4, 5, 6, 7, 4, 5, 6, 6}}}});
  std::vector<Image> images = noise_patterns(8, {side, side});
  for (int i = 0; i < 8; ++i) // materials of different brightness
    for (float& value : images[static_cast<std::size_t>(i)].data())
      value = (i < 4 ? 0.1f : 0.5f) + 0.4f * value;
  scene.add(PatternsTexture{pattern_source(images), scene.grid(), index});
  return scene;
}

} // namespace

TEST_CASE("across borders of cells, each texel is read from the tile that it lies in", "[pattern]") {
  constexpr int side = 16;
  Scene scene(64, {side, side});
  const NodeId index = scene.random(4);
  const std::vector<Image> images = noise_patterns(4, {side, side});
  const auto source = pattern_source(images);
  scene.add(PatternsTexture{source, scene.grid(), index});
  // Level 0 against texels gathered by hand.
  const PatternTexture bilinear(scene.graph, 0, with(PatternFilter::bilinear));
  const auto texel = [&](std::int64_t x, std::int64_t y) {
    const PatternPlace place{{x / side, 0.5}, {y / side, 0.5}};
    return images[static_cast<std::size_t>(index_at(scene.graph, index, place))].texel(
        static_cast<int>(x % side), static_cast<int>(y % side));
  };
  for (std::uint64_t k = 0; k < 400; ++k) {
    double x = 100 + 700 * chance("bx", k), y = 100 + 700 * chance("by", k);
    if (k % 2 == 0)
      x = std::round(x / side) * side + 0.8 * (chance("near", k) - 0.5); // half of them at a border
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5), a = x - 0.5 - left, b = y - 0.5 - top;
    const auto i = static_cast<std::int64_t>(left), j = static_cast<std::int64_t>(top);
    std::vector<double> expected;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto at = [&](int dx, int dy) { return static_cast<double>(texel(i + dx, j + dy)[c]); };
      expected.push_back((1 - b) * ((1 - a) * at(0, 0) + a * at(1, 0)) +
                         b * ((1 - a) * at(0, 1) + a * at(1, 1)));
    }
    CHECK(difference(value_at(bilinear, {0, x / side}, {0, y / side}, 1.0 / side), expected) < 1e-4);
  }
}

TEST_CASE("from fine to far, filtering keeps near what brute force finds", "[pattern]") {
  const Scene scene = dithered_scene(64);
  const PatternTexture brute(scene.graph, 0, with(PatternFilter::supersampled));
  const PatternTexture mean(scene.graph, 0, with(PatternFilter::trilinear)),
      stored(scene.graph, 0, with(PatternFilter::trilinear, 64));
  // The brute force is a box, levels and coarse maps are wider bells: where areas are a pixel's size, that is what is left,
  // for the root mean square of the texture itself is some 0.2.
  constexpr double allowed = 0.055;
  for (const double width : {1.0 / 16, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
    const double of_mean = apart(mean, brute, width, 64), of_stored = apart(stored, brute, width, 64);
    INFO(width << " units: mean " << of_mean << ", coarse map " << of_stored);
    CHECK(of_mean < allowed);
    CHECK(of_stored < allowed);
  }
}

TEST_CASE("without levels beyond one texel a tile, pixels would flicker: the bound above means something",
          "[pattern]") {
  const Scene scene = dithered_scene(64);
  const PatternTexture brute(scene.graph, 0, with(PatternFilter::supersampled));
  const PatternTexture naive(scene.graph, 0, with(PatternFilter::bilinear)); // the level limit alone
  CHECK(apart(naive, brute, 8, 64) > 0.1);
}

TEST_CASE("the mean color is off by no more than is said", "[pattern]") {
  // The law of large numbers: deviation of one tile over the root of how many a pixel covers.
  Scene scene(4096, {16, 16});
  const NodeId random = scene.random(16);
  scene.add(PatternsTexture{pattern_source(noise_patterns(16, {16, 16})), scene.grid(), random});
  // Patterns of very different brightness, or there is nothing to see.
  std::vector<Image> images;
  for (int i = 0; i < 16; ++i) images.push_back(Image(4, 4, 3, static_cast<float>(i) / 15.0f));
  std::get<PatternsTexture>(scene.graph.nodes[1].block).source = pattern_source(images);
  const PatternTexture texture(scene.graph, 0),
      brute(scene.graph, 0, with(PatternFilter::supersampled, 0, 64));
  for (const double width : {8.0, 16.0, 32.0}) {
    const PatternTexture::Mean mean = texture.mean_error({}, {width, 0, 0, width});
    CHECK(mean.error == Approx(0.3073 / width).epsilon(0.01)); // of 0, 1/15, …, 1
    double sum = 0;
    constexpr int places = 100;
    for (int k = 0; k < places; ++k) {
      const auto n = static_cast<std::uint64_t>(k);
      const TileCoordinate u{0, 4096 * chance("mu", n)}, v{0, 4096 * chance("mv", n)};
      const double off = value_at(brute, u, v, width)[0] - value_at(texture, u, v, width)[0];
      sum += off * off;
    }
    const double found = std::sqrt(sum / places);
    INFO(width << ": " << found << " against " << mean.error);
    CHECK(found < 1.3 * mean.error);
    CHECK(found > 0.7 * mean.error);
  }
}

TEST_CASE("no step shows from one way of filtering to the next", "[pattern]") {
  const Scene scene = dithered_scene(64);
  for (const int coarse_map : {0, 64}) {
    const PatternTexture texture(scene.graph, 0, with(PatternFilter::trilinear, coarse_map));
    double largest = 0;
    for (std::uint64_t k = 0; k < 20; ++k) {
      const TileCoordinate u{0, 64 * chance("su", k)}, v{0, 64 * chance("sv", k)};
      std::vector<double> before;
      for (int step = -6 * 256; step <= 5 * 256; ++step) {
        const std::vector<double> value = value_at(texture, u, v, std::exp2(step / 256.0));
        if (!before.empty()) largest = std::max(largest, difference(before, value));
        before = value;
      }
    }
    INFO(coarse_map);
    CHECK(largest < 0.02);
  }
}

TEST_CASE("a sparse convolution thins out to its mean", "[pattern]") {
  const TransformFit fit = GENERATE(TransformFit::shrink, TransformFit::overflow);
  Scene scene(1024, {16, 16}, 4);
  const NodeId x = scene.number(0, 1, 1), y = scene.number(0, 1, 2), scale = scene.number(0.4, 1, 4),
               turn = scene.number(0, 1, 3);
  const NodeId index = scene.random(3);
  scene.add(PatternsTexture{pattern_source(spots(3, 32)), scene.grid(), index, true, fit, x, y, scale, turn});
  const PatternTexture texture(scene.graph, 0, with(PatternFilter::trilinear)),
      brute(scene.graph, 0, with(PatternFilter::supersampled, 0, 64));
  const std::vector<double> mean = value_at(texture, {0, 0.5}, {0, 0.5}, 16);
  double cover = 0;
  for (std::uint64_t k = 0; k < 40; ++k)
    cover += value_at(brute, {0, 1024 * chance("cu", k)}, {0, 1024 * chance("cv", k)}, 16)[3] / 40;
  INFO(mean[3] << " against " << cover);
  CHECK(std::fabs(mean[3] - cover) < 0.01);
}

TEST_CASE("dithered areas have the interpolated mean everywhere, and materials their shares", "[pattern]") {
  const Scene scene = dithered_scene(1 << 20);
  const auto material = [&](std::int64_t x, std::int64_t y) {
    return index_at(scene.graph, 1, {{x, 0.5}, {y, 0.5}});
  };
  const auto area = [](int x, int y) { return (x % 8 * 5 + y % 8 * 3) % 7 < 3 ? 1.0 : 0.0; };
  for (const auto& [cx, cy, bx, by] : std::vector<std::tuple<int, int, double, double>>{
           {0, 0, 0.5, 0.5}, {1, 2, 0.25, 0.125}, {4, 3, 0.875, 0.5}, {7, 7, 0.5, 0.25}}) {
    const std::int64_t cell = (1 << 20) / 8;
    const auto centre_x = static_cast<std::int64_t>((cx + 0.5 + bx) * static_cast<double>(cell));
    const auto centre_y = static_cast<std::int64_t>((cy + 0.5 + by) * static_cast<double>(cell));
    double sum = 0;
    constexpr int side = 60; // small against an area
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i)
        sum += static_cast<double>(material((centre_x + i) % (8 * cell), (centre_y + j) % (8 * cell)));
    const double wanted = (1 - by) * ((1 - bx) * area(cx, cy) + bx * area(cx + 1, cy)) +
                          by * ((1 - bx) * area(cx, cy + 1) + bx * area(cx + 1, cy + 1));
    CHECK(sum / (side * side) == Approx(wanted).margin(5 * 0.5 / side));
  }
  // Patterns of the second material: 4, 5, 6, 7 with shares 2 2 3 1 of 8, by chi-square.
  double counts[4] = {};
  int of_material = 0;
  for (std::int64_t k = 0; k < 40000; ++k) {
    const PatternPlace place{{(k * 7919) % (1 << 20), 0.5}, {(k * 104729) % (1 << 20), 0.5}};
    if (index_at(scene.graph, 1, place) != 1) continue;
    ++counts[index_at(scene.graph, 3, place) - 4];
    ++of_material;
  }
  double chi = 0;
  const double shares[4] = {0.25, 0.25, 0.375, 0.125};
  for (int i = 0; i < 4; ++i)
    chi += std::pow(counts[i] - shares[i] * of_material, 2) / (shares[i] * of_material);
  CHECK(chi < 16.3); // 1 in 1000 for three degrees of freedom
}

TEST_CASE("distances of a sparse convolution are those of a jittered grid", "[pattern]") {
  Scene scene(1 << 20);
  const NodeId x = scene.number(0, 1, 1), y = scene.number(0, 1, 2);
  scene.constant(0);
  const auto place = [&](NodeId node, std::int64_t i, std::int64_t j) {
    return number_at(scene.graph, node, {{i, 0.5}, {j, 0.5}});
  };
  // Between neighbours along x: 1 + X' - X, a triangle of probability over 0..2; across: Y' - Y over -1..1.
  constexpr int bins = 20, samples = 20000;
  double along[bins] = {}, across[bins] = {};
  for (std::int64_t k = 0; k < samples; ++k) {
    const std::int64_t i = (k * 7919) % (1 << 20) - (k * 7919 % (1 << 20) == (1 << 20) - 1),
                       j = (k * 104729) % (1 << 20);
    const double dx = 1 + place(x, i + 1, j) - place(x, i, j), dy = place(y, i + 1, j) - place(y, i, j);
    ++along[static_cast<int>(dx / 2 * bins)];
    ++across[static_cast<int>((dy + 1) / 2 * bins)];
  }
  double chi_along = 0, chi_across = 0;
  for (int bin = 0; bin < bins; ++bin) {
    const auto below = [](double t) { return t < 0.5 ? 2 * t * t : 1 - 2 * (1 - t) * (1 - t); };
    const double expected = samples * (below((bin + 1.0) / bins) - below(static_cast<double>(bin) / bins));
    chi_along += std::pow(along[bin] - expected, 2) / expected;
    chi_across += std::pow(across[bin] - expected, 2) / expected;
  }
  CHECK(chi_along < 43.8); // 1 in 1000 for 19 degrees of freedom
  CHECK(chi_across < 43.8);
}
