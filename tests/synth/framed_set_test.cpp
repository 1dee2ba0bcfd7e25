#include "support/samples.h"

#include "tilepack/image/image.h"
#include "tilepack/numeric/random.h"
#include "tilepack/synth/framed_set.h"
#include "tilepack/synth/set_report.h"
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

// Texels within `depth` of an edge, its whole length, are the same in all tiles of its color.
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
        Case{{9, 64}, Coloring::edge, {1, 4, 0}, 1}, Case{{32, 32}, Coloring::corner, {0, 0, 2, 3}, 2},
        Case{{24, 32}, Coloring::edge, {1, 2, 0, 2}, 0}}) {
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

TEST_CASE("a set that is searched at a sixteenth of its size comes down scale by scale, the same on one "
          "thread") {
  const SampleMap map = testing::color_map(blobs(300, 280));
  const SampleAnalysis sample = analysed(std::span(&map, 1), Periodicity{});
  FramedSetSettings settings = settings_for(2, 5);
  settings.smallest_search_tile = 8; // as of tiles of 512 texels
  const SynthOptions options = framing({128, 128}, Coloring::corner, {0, 0, 2}, 1);
  const SourceMap made_so = framed_set(sample, options, settings, {});
  check_borders(made_so, 1);
  bool inside = true;
  for (const auto& tile : made_so.texels)
    for (const SourceTexel& t : tile) inside = inside && t.x >= 0 && t.y >= 0 && t.x < 300 && t.y < 280;
  CHECK(inside);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(framed_set(sample, options, settings, {}).texels == made_so.texels);
}

TEST_CASE("each tile's inside is its own") {
  const SourceMap map = made(framing({32, 32}, Coloring::corner, {0, 0, 2, 2}), {160, 160});
  CHECK(map.texels.size() == 32);
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

TEST_CASE(
    "what lies at a border runs on in the sample across it, but for where cuts of the strip cross the edge") {
  // Joined by cuts alone, a strip is of three pieces: few of its texels at the edge have a neighbour across it
  // that is not their neighbour in the sample.
  for (const Coloring coloring : {Coloring::corner, Coloring::edge}) {
    SynthOptions options = testing::two_colors({32, 32}, coloring, 0);
    const SourceMap map = made(options);
    const int side = options.tile_size.width;
    int pairs = 0, apart = 0;
    for (std::size_t a = 0; a < map.texels.size(); ++a)
      for (std::size_t b = 0; b < map.texels.size(); ++b) {
        const auto at = [&](std::size_t id, int x, int y) {
          return map.texels[id][static_cast<std::size_t>(y * side + x)];
        };
        for (int i = 0; i < side; ++i) {
          if (sides_of(map, a).south == sides_of(map, b).north) {
            const SourceTexel above = at(a, i, side - 1);
            ++pairs;
            apart += at(b, i, 0) != SourceTexel{above.x, above.y + 1};
          }
          if (sides_of(map, a).east == sides_of(map, b).west) {
            const SourceTexel before = at(a, side - 1, i);
            ++pairs;
            apart += at(b, 0, i) != SourceTexel{before.x + 1, before.y};
          }
        }
      }
    INFO(apart << " of " << pairs);
    CHECK(pairs > 0);
    CHECK(apart * 20 < pairs);
  }
}

TEST_CASE("a set made of a large sample is varied") {
  // Large blobs cost little to draw: each texel of a small picture, four times along each axis.
  const Image small = blobs(400, 400, 8, 1);
  Image large(1600, 1600, 1);
  for (int y = 0; y < 1600; ++y)
    for (int x = 0; x < 1600; ++x) large.texel(x, y)[0] = small.texel(x / 4, y / 4)[0];
  const SampleAnalysis sample = analysed(testing::features(large), {});
  const SourceMap set =
      framed_set(sample, testing::two_colors({64, 64}, Coloring::corner, 2), settings_for(2, 0));
  const double varied = set_report(sample, set).figures.distinct_tiles;
  INFO("as varied as " << varied << " tiles");
  CHECK(varied > 6.0);
}

TEST_CASE("bricks of different tones are not cut in two") {
  constexpr int brick = 32, course = 16, joint = 4;
  constexpr float mortar = 0.58f;
  Image wall(256, 256, 3);
  for (int y = 0; y < wall.height(); ++y)
    for (int x = 0; x < wall.width(); ++x) {
      const int row = y / course;
      const int shifted = x + (row % 2) * brick / 2;
      const bool in_joint = y % course < joint || shifted % brick < joint;
      const auto tone = static_cast<float>(random_below(
          1, "tone", static_cast<std::uint64_t>(100 * row + shifted / brick), 50)); // of 255, from 20 to 69
      std::ranges::fill(wall.texel(x, y), in_joint ? mortar : (20 + tone) / 255);
    }
  const SampleMap map = testing::color_map(wall);
  int cut = 0, texels = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    SynthOptions options = framing({64, 64}, Coloring::corner, {2, 2, 2});
    options.seed = seed;
    const SourceMap set = synthesize(std::span(&map, 1), options);
    // In the wall two bricks never lie side by side without a joint.
    for (const auto& tile : set.texels) {
      const auto value = [&](int x, int y) {
        const SourceTexel from = tile[static_cast<std::size_t>(y * 64 + x)];
        return wall.texel(from.x, from.y)[0];
      };
      const auto cuts = [&](float a, float b) {
        return a != mortar && b != mortar && std::abs(a - b) > 10.0f / 255;
      };
      for (int y = 0; y + 1 < 64; ++y)
        for (int x = 0; x + 1 < 64; ++x) {
          cut += cuts(value(x, y), value(x + 1, y)) + cuts(value(x, y), value(x, y + 1));
          ++texels;
        }
    }
  }
  CAPTURE(cut, texels);
  CHECK(cut * 150 <
        texels); // twice as many where strips are shorter than half a brick and borders lie anywhere
}
