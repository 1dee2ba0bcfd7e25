#include "support/samples.h"

#include "tilepack/image/image.h"
#include "tilepack/synth/border_step.h"
#include "tilepack/synth/framed_set.h"
#include "tilepack/synth/synthesize.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>

using namespace tilepack;
using testing::blobs;

namespace {

SynthOptions framing(Size tile, Coloring coloring, ColorCounts colors, int guard = 0) {
  SynthOptions options;
  options.tile_size = tile;
  options.coloring = coloring;
  options.colors = colors;
  options.guard = guard;
  options.effort = 2;
  return options;
}

SourceMap made(const SynthOptions& options, Size sample = {96, 80}) {
  const SampleMap map = testing::color_map(blobs(sample.width, sample.height));
  return synthesize(std::span(&map, 1), options);
}

// What lies along the four sides of a tile, as numbers: equal numbers, equal edges.
struct Sides {
  int north, east, south, west;
};

Sides sides_of(const SourceMap& map, std::size_t id) {
  if (const auto* edges = std::get_if<std::vector<EdgeTile>>(&map.tiles)) {
    const EdgeTile& t = (*edges)[id];
    return {t.north, t.east, t.south, t.west};
  }
  const CornerTile& t = std::get<std::vector<CornerTile>>(map.tiles)[id];
  const int k = map.colors.corner;
  return {t.nw * k + t.ne, t.ne * k + t.se, t.sw * k + t.se, t.nw * k + t.sw};
}

// Texels within `depth` of an edge, its whole length, are the same in all tiles of its color, and run on in
// the sample across the edge wherever the strip is one piece there.
void check_borders(const SourceMap& map, int depth) {
  const int w = map.tile_size.width;
  const int h = map.tile_size.height;
  const auto at = [&](std::size_t id, int x, int y) {
    return map.texels[id][static_cast<std::size_t>(y * w + x)];
  };
  int differing = 0;
  for (std::size_t a = 0; a < map.texels.size(); ++a)
    for (std::size_t b = 0; b < map.texels.size(); ++b) {
      const Sides s = sides_of(map, a);
      const Sides t = sides_of(map, b);
      for (int d = 0; d < depth; ++d) {
        for (int x = 0; x < w; ++x) {
          if (s.north == t.north) differing += at(a, x, d) != at(b, x, d);
          if (s.south == t.south) differing += at(a, x, h - 1 - d) != at(b, x, h - 1 - d);
        }
        for (int y = 0; y < h; ++y) {
          if (s.west == t.west) differing += at(a, d, y) != at(b, d, y);
          if (s.east == t.east) differing += at(a, w - 1 - d, y) != at(b, w - 1 - d, y);
        }
      }
    }
  CHECK(differing == 0);
}

} // namespace

TEST_CASE("framed tiles share their borders, corners included, in both colorings") {
  struct Case {
    Size tile;
    Coloring coloring;
    ColorCounts colors;
    int guard;
  };
  for (const Case& c :
       {Case{{32, 32}, Coloring::corner, {0, 0, 2}, 0}, Case{{32, 32}, Coloring::corner, {0, 0, 2}, 4},
        Case{{33, 27}, Coloring::corner, {0, 0, 1}, 3}, Case{{24, 24}, Coloring::corner, {0, 0, 3}, 2},
        Case{{32, 32}, Coloring::edge, {2, 2, 0}, 0}, Case{{40, 24}, Coloring::edge, {3, 2, 0}, 3},
        Case{{4, 4}, Coloring::edge, {1, 1, 0}, 0}, Case{{5, 4}, Coloring::corner, {0, 0, 2}, 0},
        Case{{9, 64}, Coloring::edge, {1, 4, 0}, 1}}) {
    const SourceMap map = made(framing(c.tile, c.coloring, c.colors, c.guard));
    CHECK(map.texels.size() == static_cast<std::size_t>(tile_count(map.tiles)));
    check_borders(map, std::max(1, c.guard));
    bool inside = true;
    for (const auto& tile : map.texels) {
      REQUIRE(tile.size() == static_cast<std::size_t>(c.tile.width * c.tile.height));
      for (const SourceTexel& t : tile) inside = inside && t.x >= 0 && t.y >= 0 && t.x < 96 && t.y < 80;
    }
    CHECK(inside);
  }
}

TEST_CASE("a framed set can be made of a sample no larger than a tile") {
  CHECK(made(framing({40, 30}, Coloring::corner, {0, 0, 2}), {40, 30}).texels.size() == 16);
  CHECK(made(framing({4, 4}, Coloring::edge, {2, 2, 0}), {4, 4}).texels.size() == 16);
}

TEST_CASE("a framed set depends on the seed, not on the number of threads") {
  SynthOptions options = framing({32, 32}, Coloring::corner, {0, 0, 2});
  const SourceMap many = made(options);
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(made(options).texels == many.texels);
  }
  options.seed = 7;
  CHECK(made(options).texels != many.texels);
}

TEST_CASE("each tile's inside is its own") {
  const SourceMap map = made(framing({32, 32}, Coloring::corner, {0, 0, 2}), {160, 160});
  std::vector<SourceTexel> middles;
  for (const auto& tile : map.texels) middles.push_back(tile[16 * 32 + 16]);
  for (std::size_t a = 0; a < middles.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) CHECK(middles[a] != middles[b]);
}

TEST_CASE("maps of a material stay in register to the texel") {
  // The second map carries the coordinates of each texel, the third their product.
  std::vector<SampleMap> maps(3, testing::color_map(blobs(80, 72)));
  maps[1].name = "place";
  maps[1].image = Image(80, 72, 2);
  maps[2].name = "product";
  maps[2].image = Image(80, 72, 1);
  for (const std::size_t m : {std::size_t{1}, std::size_t{2}}) {
    maps[m].role = m == 1 ? Role::data : Role::height;
    maps[m].encoding = Encoding::linear;
  }
  for (int y = 0; y < 72; ++y)
    for (int x = 0; x < 80; ++x) {
      maps[1].image.texel(x, y)[0] = static_cast<float>(x);
      maps[1].image.texel(x, y)[1] = static_cast<float>(y);
      maps[2].image.texel(x, y)[0] = static_cast<float>(x * y);
    }
  for (const Coloring coloring : {Coloring::corner, Coloring::edge}) {
    const TileSet set = assembled(
        synthesize(maps, framing({24, 24}, coloring,
                                 coloring == Coloring::corner ? ColorCounts{0, 0, 2} : ColorCounts{2, 2, 0})),
        maps);
    int shifted = 0;
    for (std::size_t id = 0; id < set.maps[0].tiles.size(); ++id)
      for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
          const auto place = set.maps[1].tiles[id].texel(x, y);
          const auto color = set.maps[0].tiles[id].texel(x, y);
          const auto original = maps[0].image.texel(static_cast<int>(place[0]), static_cast<int>(place[1]));
          shifted += !std::equal(color.begin(), color.end(), original.begin());
          shifted += set.maps[2].tiles[id].texel(x, y)[0] != place[0] * place[1];
        }
    CHECK(shifted == 0);
  }
}

// 128 × 128 texels of four equal quarters: what is missing in one place stands in three more.
Image four_quarters() {
  const Image quarter = blobs(64, 64);
  Image image(128, 128, quarter.channels());
  for (int y = 0; y < 128; y += 64)
    for (int x = 0; x < 128; x += 64) paste(image, quarter, x, y);
  return image;
}

// 48 × 40 texels of the sample's north-west, the eastern half from `shift` further on.
SourceCanvas with_seam(SourceTexel shift) {
  SourceCanvas canvas(48, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 48; ++x)
      canvas.at(x, y) = x < 24 ? SourceTexel{x, y} : SourceTexel{x + shift.x, y + shift.y};
  return canvas;
}

UseCounts unused(const FeatureImage& image) {
  UseCounts usage(image.width, image.height);
  usage.prepare();
  return usage;
}

TEST_CASE("mending never raises the seam energy, and both mending and polishing leave fixed texels alone") {
  const SampleMap map = testing::color_map(blobs(96, 96));
  const FeatureImage image = feature_image(std::span(&map, 1));
  FeaturePyramid pyramid(image);
  pyramid.add_half();
  const PatchSearch search(pyramid.back());
  const SourceCanvas start = with_seam({40, 50});
  std::vector<std::uint8_t> fixed(start.texels.size());
  for (std::size_t i = 0; i < fixed.size(); ++i) fixed[i] = i % 48 < 22 || i % 7 == 0;
  SourceCanvas mended = start;
  replace_worst_patches(pyramid, search, unused(pyramid.back()), {}, fixed, {}, mended);
  CHECK(seam_energy(pyramid[0], mended) < seam_energy(pyramid[0], start));
  std::vector<SourceCanvas> polished{start};
  match_and_vote(pyramid[0], contrast_ranks(pyramid[0]), 1, fixed, {0, 0, 48, 40}, {}, polished);
  CHECK(polished[0].texels != start.texels);
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (fixed[i]) CHECK((mended.texels[i] == start.texels[i] && polished[0].texels[i] == start.texels[i]));
}

TEST_CASE("mending takes windows that are not shown yet, where they are as like") {
  const SampleMap map = testing::color_map(four_quarters());
  const FeatureImage image = feature_image(std::span(&map, 1));
  const FeaturePyramid pyramid(image);
  const PatchSearch search(pyramid.back());
  UseCounts usage(128, 128);
  usage.add({0, 0, 128, 64}, 3.0);
  usage.add({0, 64, 64, 64}, 3.0);
  usage.prepare();
  SourceCanvas canvas(56, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 56; ++x) canvas.at(x, y) = x < 28 ? SourceTexel{x, y} : SourceTexel{x - 28, y + 12};
  const std::vector<std::uint8_t> fixed(canvas.texels.size(), 0);
  SeamRepairOptions options;
  options.spots = 2;
  options.window = 24;
  replace_worst_patches(pyramid, search, usage, {}, fixed, options, canvas);
  std::size_t shown_before = 0;
  std::size_t fresh = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 56; ++x) {
      const SourceTexel s = canvas.at(x, y);
      if (s == (x < 28 ? SourceTexel{x, y} : SourceTexel{x - 28, y + 12})) continue;
      ++(s.x >= 64 && s.y >= 64 ? fresh : shown_before);
    }
  CHECK(fresh > 100);
  CHECK(fresh > 4 * shown_before);
}

TEST_CASE("polishing at half size changes texels near a seam to others of the sample, fixed ones never") {
  const SampleMap map = testing::color_map(blobs(256, 256));
  const FeatureImage image = feature_image(std::span(&map, 1));
  SourceCanvas start(96, 80);
  std::vector<std::uint8_t> fixed(start.texels.size());
  for (int y = 0; y < start.height; ++y)
    for (int x = 0; x < start.width; ++x) {
      start.at(x, y) = x < 48 ? SourceTexel{x, y} : SourceTexel{x + 91, y + 120};
      fixed[start.index(x, y)] = x < 46;
    }
  std::vector<SourceCanvas> polished{start};
  match_and_vote(halved(image), contrast_ranks(halved(image)), 2, fixed, {0, 0, 96, 80}, {}, polished);
  CHECK(polished[0].texels != start.texels);
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const SourceTexel s = polished[0].texels[i];
    CHECK((s.x >= 0 && s.y >= 0 && s.x < image.width && s.y < image.height));
    if (fixed[i] || i % 96 > 60) CHECK(s == start.texels[i]); // the last are out of reach
  }
}

// The mean over a few squares of 7 × 7 texels of the least squared difference to any square of the sample.
double unlikeness(const FeatureImage& image, const SourceCanvas& canvas) {
  constexpr int side = 7;
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y + side <= canvas.height; y += 5)
    for (int x = 18; x < 24; x += 2, ++count) {
      int least = std::numeric_limits<int>::max();
      for (int v = 0; v + side <= image.height; ++v)
        for (int u = 0; u + side <= image.width; ++u) {
          int d = 0;
          for (int j = 0; j < side && d < least; ++j)
            for (int i = 0; i < side; ++i) {
              const SourceTexel s = canvas.at(x + i, y + j);
              d += squared_difference(image.texel(s.x, s.y), image.texel(u + i, v + j), image.channels);
            }
          least = std::min(least, d);
        }
      sum += least;
    }
  return sum / count;
}

TEST_CASE("passes of polishing make squares more like the sample's, and leave alone what has no seam") {
  const SampleMap map = testing::color_map(blobs(96, 96));
  const FeatureImage image = feature_image(std::span(&map, 1));
  const SourceCanvas start = with_seam({40, 50});
  const std::vector<std::uint8_t> fixed(start.texels.size(), 0);
  const Rect all{0, 0, 48, 40};
  const auto polished = [&](int passes) {
    PatchMatchOptions options;
    options.passes = passes;
    std::vector<SourceCanvas> canvases{start};
    match_and_vote(image, contrast_ranks(image), 1, fixed, all, options, canvases);
    return unlikeness(image, canvases[0]);
  };
  const double once = polished(1);
  CHECK(once < 0.9 * unlikeness(image, start));
  CHECK(polished(4) < 0.97 * once);

  std::vector<SourceCanvas> whole{SourceCanvas(48, 40)};
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 48; ++x) whole[0].at(x, y) = {x + 5, y + 7};
  const auto before = whole[0].texels;
  match_and_vote(image, contrast_ranks(image), 1, fixed, all, {}, whole);
  CHECK(whole[0].texels == before);
}

TEST_CASE("polishing with freshness turns to parts of the sample that no canvas shows") {
  const SampleMap map = testing::color_map(four_quarters());
  const FeatureImage image = feature_image(std::span(&map, 1));
  const SourceCanvas start = with_seam({14, 20}); // shows the north-west quarter only
  const std::vector<std::uint8_t> fixed(start.texels.size(), 0);
  const auto fresh = [&](double freshness) {
    PatchMatchOptions options;
    options.freshness = freshness;
    std::vector<SourceCanvas> canvases{start, start};
    match_and_vote(image, contrast_ranks(image), 1, fixed, {0, 0, 48, 40}, options, canvases);
    return std::count_if(canvases[0].texels.begin(), canvases[0].texels.end(),
                         [](SourceTexel s) { return s.x >= 64 || s.y >= 64; });
  };
  CHECK(fresh(2.0) > fresh(0.0) + 20);
}

TEST_CASE("usage is the mean over areas, those partly outside too") {
  UseCounts usage(10, 6, 2);
  usage.prepare();
  CHECK(usage.mean() == 0.0);
  usage.add({0, 0, 4, 4}, 3.0);
  usage.add({2, 2, 2, 2}, -1.0);
  usage.add({-5, -5, 7, 7}, 1.0);
  usage.prepare();
  CHECK(usage.mean({0, 0, 2, 2}) == 4.0);
  CHECK(usage.mean({2, 2, 2, 2}) == 2.0);
  CHECK(usage.mean({0, 0, 4, 4}) == Approx((4.0 + 3.0 + 3.0 + 2.0) / 4.0));
  CHECK(usage.mean({8, 4, 50, 50}) == 0.0);
  CHECK(usage.mean() == Approx(12.0 / 15.0));
  UseCounts priced(10, 6, 2);
  priced.set_reuse_weight({2, 0, 2, 2}, 7);
  priced.add({0, 0, 4, 2}, 2.0);
  priced.add({0, 0, 4, 2}, -1.0);
  priced.prepare();
  CHECK(priced.mean({0, 0, 2, 2}) == 1.0);
  CHECK(priced.mean({2, 0, 2, 2}) == 7.0);
}

TEST_CASE("the step across a strip is that of the corner patches near its ends and its own between") {
  // Rows of 0 and 90 in turn in the west, flat in the east.
  Image image(64, 64, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) image.texel(x, y)[0] = x < 40 && y % 2 == 1 ? 90.0F / 255.0F : 0.0F;
  const SampleMap map{"height.png", Role::data, Encoding::linear, Depth::u8, std::move(image)};
  const FeatureImage features = feature_image(std::span(&map, 1));
  const int high = features.texel(0, 1)[0];
  CHECK(mean_step(features, Direction::horizontal) == Approx(high * 40.0 / 64.0));
  CHECK(mean_step(features, Direction::vertical) == Approx(high * 0.5 / 63.0));
  FrameShape shape;
  shape.tile = {16, 16};
  shape.reach = 2;
  shape.corner_reach = 4;
  const StripAxes space = space_of(shape, Direction::horizontal);
  const SourceTexel flat{56, 32};
  const SourceTexel striped{20, 32};
  CHECK(step_across(features, space, {0, 30}) == Approx(high));
  CHECK(step_across(features, space, {44, 30}) == 0.0);
  CHECK(step_across(features, shape, space, {0, 30}, striped, striped) == Approx(high));
  CHECK(step_across(features, shape, space, {0, 30}, flat, striped) == Approx(high * 14.0 / 16.0));
  CHECK(step_across(features, shape, space, {44, 30}, flat, striped) == Approx(high * 2.0 / 16.0));
}

TEST_CASE("the sample's own statistics are at distance nought, a part's are not") {
  const SampleMap map = testing::color_map(blobs(64, 64));
  const SampleStatistics statistics(feature_image(std::span(&map, 1)));
  auto tally = statistics.empty();
  statistics.add(tally, {0, 0, 64, 64}, 2.0);
  CHECK(statistics.distance(tally) == Approx(0.0).margin(1e-12));
  auto part = statistics.empty();
  statistics.add(part, {8, 8, 9, 9}, 1.0);
  CHECK(statistics.distance(part) > 0.0);
  CHECK(statistics.distance_with(statistics.empty(), {8, 8, 9, 9}, 1.0) == Approx(statistics.distance(part)));
  statistics.add(part, {8, 8, 9, 9}, -1.0);
  CHECK(part.texels == 0.0);
}
