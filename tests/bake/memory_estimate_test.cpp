#include "tilepack/bake/bake_fields.h"
#include "tilepack/bake/memory_estimate.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

struct Measured {
  std::vector<MapShape> maps;
  std::vector<BakeSetting> settings;
  int threads;
  double megabytes;
};

std::vector<MapShape> rgb(int side) {
  return {{{side, side}, 3}};
}

} // namespace

// Peaks of resident memory of `tilepack bake`, by GNU time: the table of lib/tilepack/bake/COSTS.md on 4 threads (MB of 10^6), and
// bakes on 2 threads at effort 0.
TEST_CASE("the estimate of memory meets what bakes took") {
  const std::vector<MapShape> rock{{{512, 512}, 3}, {{512, 512}, 3}, {{512, 512}, 1}, {{512, 512}, 1}};
  const std::vector<Measured> table{
      {rgb(512), {}, 4, 47},
      {rgb(512), {{"colors", "3", ""}}, 4, 98},
      {rgb(512), {{"colors", "4", ""}}, 4, 271},
      {rgb(1024), {}, 4, 67},
      {rgb(2048), {}, 4, 145},
      {rgb(4096), {}, 4, 437},
      {rgb(512), {{"coloring", "edge", ""}}, 4, 40},
      {rgb(512), {}, 2, 40},
      {rgb(512), {{"colors", "3", ""}}, 2, 95},
      {rgb(512), {{"colors", "4", ""}}, 2, 245},
      {rgb(512), {{"colors", "4", ""}, {"tile-size", "64", ""}}, 2, 84},
      {rgb(1024), {}, 2, 59},
      {rgb(2048), {}, 2, 132},
      {{{{2048, 2048}, 1}}, {}, 2, 83},
      {rock, {}, 2, 57},
      {rock, {{"colors", "3", ""}}, 2, 160},
      {rgb(512), {{"colors", "3", ""}, {"layout", "rotated", ""}}, 2, 122},
      {rgb(512), {{"colors", "3", ""}, {"layout", "array", ""}, {"border", "16", ""}}, 2, 117},
      {rgb(512), {{"colors", "3x3", ""}, {"corner-pack", "true", ""}}, 2, 120},
      {rgb(512), {{"colors", "3", ""}, {"depth", "f32", ""}}, 2, 223},
      {rgb(512), {{"mapping", "index", ""}, {"virtual-size", "4096", ""}}, 2, 196},
      {rgb(2048), {{"flatten", "100", ""}}, 2, 183},
      {rgb(512), {}, 1, 36},
  };
  for (const Measured& m : table) {
    std::vector<BakeSetting> settings{{"tile-size", "128", ""}}; // unless the row has another
    settings.insert(settings.end(), m.settings.begin(), m.settings.end());
    const double estimate =
        static_cast<double>(memory_estimate(m.maps, bake_options(settings), m.threads)) / 1e6;
    INFO(m.maps[0].size.width << " texels, " << m.maps.size() << " maps, " << m.settings.size()
                              << " settings, " << m.threads << " threads, measured " << m.megabytes << " MB");
    CHECK(estimate > 0.8 * m.megabytes);
    CHECK(estimate < 1.2 * m.megabytes);
  }
}
