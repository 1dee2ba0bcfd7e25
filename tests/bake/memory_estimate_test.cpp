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

// Peaks of resident memory of `tilepack bake --jobs`, by GNU time (MB of 10^6), of gravel.png of 512² texels at effort 0
// unless said otherwise, of samples that are used as they are.
TEST_CASE("the estimate of memory meets what bakes took") {
  const std::vector<MapShape> rock{{{512, 512}, 3}, {{512, 512}, 3}, {{512, 512}, 1}, {{512, 512}, 1}};
  const std::vector<Measured> table{
      {rgb(512), {}, 2, 41},
      {rgb(512), {}, 1, 32},
      {rgb(512), {{"tile-size", "64", ""}}, 1, 31},
      {rgb(512), {{"tile-size", "32", ""}}, 2, 51},
      {rgb(512), {{"tile-size", "16", ""}}, 2, 52},
      {rgb(512), {{"tile-size", "64", ""}}, 4, 34.5}, // asked for on two cores, where no more than two work
      {rgb(512), {{"colors", "3", ""}}, 2, 92},
      {rgb(512), {{"colors", "4", ""}}, 2, 207},
      {rgb(512), {{"colors", "4", ""}, {"tile-size", "64", ""}}, 2, 81},
      {rgb(1024), {}, 2, 62}, // drawn stones: bench_large_sample
      {rgb(4096), {}, 2, 478},
      {rgb(4096), {{"tile-size", "auto", ""}, {"effort", "5", ""}}, 2, 1398},
      {rgb(8192), {{"tile-size", "auto", ""}, {"effort", "5", ""}}, 2, 5349},
      {rock, {{"colors", "3", ""}}, 2, 152},
      {rgb(512), {{"colors", "3", ""}, {"layout", "rotated", ""}}, 2, 124},
      {rgb(512), {{"colors", "3", ""}, {"layout", "array", ""}, {"border", "16", ""}}, 2, 117},
      {rgb(512), {{"colors", "3x3", ""}, {"corner-pack", "true", ""}}, 2, 118},
      {rgb(512), {{"colors", "3", ""}, {"depth", "f32", ""}}, 2, 225},
  };
  for (const Measured& m : table) {
    std::vector<BakeSetting> settings{{"tile-size", "128", ""},
                                      {"flatten", "0", ""},
                                      {"straighten", "false", ""},
                                      {"wraps", "no", ""}}; // unless the row has another
    settings.insert(settings.end(), m.settings.begin(), m.settings.end());
    const double estimate =
        static_cast<double>(memory_estimate(m.maps, bake_options(settings), m.threads)) / 1e6;
    INFO(m.maps[0].size.width << " texels, " << m.maps.size() << " maps, " << m.settings.size()
                              << " settings, " << m.threads << " threads, measured " << m.megabytes << " MB");
    CHECK(estimate > 0.8 * m.megabytes);
    CHECK(estimate < 1.2 * m.megabytes);
  }
}

TEST_CASE(
    "the estimate counts what flattening takes where the sample decides, and what straightening takes") {
  const auto estimate = [&](std::vector<BakeSetting> settings) {
    settings.insert(settings.begin(), {{"tile-size", "128", ""}, {"wraps", "no", ""}});
    return memory_estimate(rgb(2048), bake_options(settings), 2);
  };
  const std::int64_t as_it_is = estimate({{"flatten", "0", ""}, {"straighten", "false", ""}});
  const std::int64_t copy = std::int64_t{2048} * 2048 * 3 * 4;
  CHECK(estimate({{"flatten", "100", ""}, {"straighten", "false", ""}}) == as_it_is + copy);
  CHECK(estimate({{"flatten", "auto", ""}, {"straighten", "false", ""}}) == as_it_is + copy);
  CHECK(estimate({{"flatten", "0", ""}}) == as_it_is + copy); // straightened, if need be
  CHECK(estimate({}) == as_it_is + copy);                     // one is held at the end, whatever was done
  // Continued by a tile, as channels, features and what goes with each texel.
  const std::int64_t more = std::int64_t{2176} * 2176 - std::int64_t{2048} * 2048;
  CHECK(estimate({{"wraps", "auto", ""}}) == estimate({{"wraps", "yes", ""}}));
  CHECK(estimate({{"wraps", "yes", ""}}) > as_it_is + copy + 3 * 4 * more);
}
