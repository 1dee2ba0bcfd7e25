#include "samples.h"

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

TEST_CASE("mending never raises the seam energy, and both mending and polishing leave fixed texels alone") {
  const SampleMap map = testing::color_map(blobs(96, 96));
  const std::vector<FeatureImage> pyramid{feature_image(std::span(&map, 1)),
                                          halved(feature_image(std::span(&map, 1)))};
  const PatchSearch search(pyramid.back());
  SourceCanvas start(48, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 48; ++x) start.at(x, y) = x < 24 ? SourceTexel{x, y} : SourceTexel{x + 40, y + 50};
  std::vector<std::uint8_t> fixed(start.texels.size());
  for (std::size_t i = 0; i < fixed.size(); ++i) fixed[i] = i % 48 < 22 || i % 7 == 0;
  SourceCanvas mended = start;
  mend_spots(pyramid, search, fixed, {}, mended);
  CHECK(seam_energy(pyramid[0], mended) < seam_energy(pyramid[0], start));
  SourceCanvas polished = start;
  polish(pyramid[0], fixed, {}, polished);
  CHECK(polished.texels != start.texels);
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (fixed[i]) CHECK((mended.texels[i] == start.texels[i] && polished.texels[i] == start.texels[i]));
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
  SourceCanvas polished = start;
  polish_at_half_size(halved(image), fixed, {}, polished);
  CHECK(polished.texels != start.texels);
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    const SourceTexel s = polished.texels[i];
    CHECK((s.x >= 0 && s.y >= 0 && s.x < image.width && s.y < image.height));
    if (fixed[i] || i % 96 > 60) CHECK(s == start.texels[i]); // the last are out of reach
  }
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
