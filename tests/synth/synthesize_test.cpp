#include "support/samples.h"

#include "tilepack/error/error.h"
#include "tilepack/synth/synthesize.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>

using namespace tilepack;
using testing::blobs;

namespace {

SourceMap made(const SynthOptions& options, int width = 96, int height = 80) {
  const SampleMap map = testing::color_map(blobs(width, height));
  return synthesize(std::span(&map, 1), options);
}

SynthOptions quilting(Size tile, int horizontal, int vertical) {
  SynthOptions options;
  options.tile_size = tile;
  options.colors = {horizontal, vertical, 0};
  options.interior = Construction::quilt;
  options.effort = 1;
  return options;
}

ErrorKind kind_of_failure(const SynthOptions& options, Size sample = {96, 80}) {
  try {
    made(options, sample.width, sample.height);
  } catch (const Error& error) {
    return error.kind();
  }
  return ErrorKind::internal;
}

SourceTexel at(const SourceMap& map, std::size_t id, int x, int y) {
  return map.texels[id][static_cast<std::size_t>(y * map.tile_size.width + x)];
}

// For every edge color, texels `depth` deep on either side of the edge, `corner` off its ends, are the same
// in all tiles, and run on in the sample across the edge.
void check_borders(const SourceMap& map, int depth, int corner) {
  const auto& tiles = std::get<std::vector<EdgeTile>>(map.tiles);
  const auto [w, h] = map.tile_size;
  int differing = 0;
  int broken = 0;
  for (std::size_t a = 0; a < tiles.size(); ++a)
    for (std::size_t b = 0; b < tiles.size(); ++b) {
      for (int x = corner; x < w - corner; ++x)
        for (int d = 0; d < depth; ++d) {
          if (tiles[a].north == tiles[b].north) differing += at(map, a, x, d) != at(map, b, x, d);
          if (tiles[a].south == tiles[b].south)
            differing += at(map, a, x, h - 1 - d) != at(map, b, x, h - 1 - d);
          if (tiles[a].south == tiles[b].north) {
            const SourceTexel above = at(map, a, x, h - 1);
            broken += at(map, b, x, 0) != SourceTexel{above.x, above.y + 1};
          }
        }
      for (int y = corner; y < h - corner; ++y)
        for (int d = 0; d < depth; ++d) {
          if (tiles[a].west == tiles[b].west) differing += at(map, a, d, y) != at(map, b, d, y);
          if (tiles[a].east == tiles[b].east)
            differing += at(map, a, w - 1 - d, y) != at(map, b, w - 1 - d, y);
          if (tiles[a].east == tiles[b].west) {
            const SourceTexel left = at(map, a, w - 1, y);
            broken += at(map, b, 0, y) != SourceTexel{left.x + 1, left.y};
          }
        }
    }
  CHECK(differing == 0);
  CHECK(broken == 0);
}

void check_inside(const SourceMap& map, Size sample) {
  bool inside = true;
  for (const auto& tile : map.texels) {
    CHECK(tile.size() == static_cast<std::size_t>(map.tile_size.width * map.tile_size.height));
    for (const SourceTexel& t : tile)
      inside = inside && t.x >= 0 && t.y >= 0 && t.x < sample.width && t.y < sample.height;
  }
  CHECK(inside);
}

} // namespace

TEST_CASE("quilted tiles of one edge color share their border, and it runs on across the edge") {
  struct Case {
    Size tile;
    int horizontal, vertical, guard;
  };
  for (const Case& c :
       {Case{{32, 32}, 2, 2, 0}, Case{{32, 32}, 2, 2, 4}, Case{{33, 25}, 2, 3, 2}, Case{{4, 4}, 1, 1, 0},
        Case{{5, 7}, 3, 2, 0}, Case{{80, 16}, 1, 4, 2}, Case{{16, 80}, 4, 1, 2}, Case{{12, 12}, 8, 8, 1}}) {
    SynthOptions options = quilting(c.tile, c.horizontal, c.vertical);
    options.guard = c.guard;
    const SourceMap map = made(options);
    REQUIRE(map.texels.size() ==
            static_cast<std::size_t>(c.horizontal * c.horizontal * c.vertical * c.vertical));
    CHECK(map.guard == c.guard);
    check_inside(map, {96, 80});
    if (map.texels.size() <= 81) check_borders(map, std::max(1, c.guard), std::max(1, c.guard));
  }
}

TEST_CASE("a sample of exactly one tile's size is enough") {
  const SourceMap map = made(quilting({40, 30}, 2, 2), 40, 30);
  check_inside(map, {40, 30});
}

TEST_CASE("synthesis does not depend on the number of threads, but on the seed") {
  SynthOptions options = quilting({32, 32}, 2, 2);
  const SourceMap many = made(options);
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(made(options).texels == many.texels);
  }
  options.seed = 1;
  CHECK(made(options).texels != many.texels);
}

TEST_CASE("options out of range are usage errors") {
  const SynthOptions good = quilting({32, 32}, 2, 2);
  const auto usage = [&](auto&& change) {
    SynthOptions options = good;
    change(options);
    CHECK(kind_of_failure(options) == ErrorKind::usage);
  };
  usage([](SynthOptions& o) { o.tile_size = {3, 32}; });
  usage([](SynthOptions& o) { o.tile_size = {32, 0}; });
  usage([](SynthOptions& o) { o.tile_size = {32, -7}; });
  usage([](SynthOptions& o) { o.tile_size = {1 << 30, 1 << 30}; });
  usage([](SynthOptions& o) { o.colors.horizontal = 0; });
  usage([](SynthOptions& o) { o.colors.vertical = 9; });
  usage([](SynthOptions& o) { o.guard = 5; });
  usage([](SynthOptions& o) { o.guard = -1; });
  usage([](SynthOptions& o) { o.effort = 10; });
  usage([](SynthOptions& o) { o.effort = -1; });
  usage([](SynthOptions& o) { o.coloring = Coloring::corner, o.colors.corner = 2; });
  usage([](SynthOptions& o) {
    o.coloring = Coloring::corner, o.colors.corner = 5, o.interior = Construction::framed;
  });
}

TEST_CASE("a sample too small says what would fit, and maps must have one size") {
  CHECK(kind_of_failure(quilting({97, 32}, 2, 2)) == ErrorKind::invalid_content);
  CHECK(kind_of_failure(quilting({32, 32}, 2, 2), {1, 1}) == ErrorKind::invalid_content);
  CHECK_THROWS_WITH(made(quilting({97, 32}, 2, 2)), Catch::Matchers::Contains("fits is 80"));
  std::vector<SampleMap> maps{testing::color_map(blobs(64, 64)), testing::color_map(blobs(64, 65))};
  CHECK_THROWS_AS(synthesize(maps, quilting({32, 32}, 2, 2)), Error);
  CHECK_THROWS_AS(synthesize(std::span<const SampleMap>{}, quilting({32, 32}, 2, 2)), Error);
}

TEST_CASE("progress is told, and may cancel") {
  const SampleMap map = testing::color_map(blobs(64, 64));
  int calls = 0;
  synthesize(std::span(&map, 1), quilting({32, 32}, 2, 2), [&](std::string_view, double) { ++calls; });
  CHECK(calls > 0);
  CHECK_THROWS_AS(synthesize(std::span(&map, 1), quilting({32, 32}, 2, 2),
                             [](std::string_view, double) { throw std::runtime_error("enough"); }),
                  std::runtime_error);
}
