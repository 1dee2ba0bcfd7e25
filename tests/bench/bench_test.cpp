#include "support/small_pack.h"

#include "tilepack/bake/packing.h"
#include "tilepack/bench/bench.h"
#include "tilepack/bench/timing.h"
#include "tilepack/error/error.h"
#include "tilepack/report/bench_page.h"
#include "tilepack/sampler/ground_truth.h"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

namespace {

// No time is tested anywhere here: they are whatever the machine makes them.
Bench small_bench() {
  const Pack pack = small_pack();
  Bench bench;
  bench.pack = "noise & <pack>";
  bench.map = "color";
  bench.target = "none";
  bench.mips = mip_mode_errors(pack, 0, 50, 1);
  bench.corners = corner_pictures(pack, 0, 1);
  bench.coordinates = coordinate_errors(pack, 0, 1);
  const auto cost = [](MappingKind mapping, BenchWeights weights, double nanoseconds, double rms) {
    return LookupCost{BenchSampler::fast, "none", mapping, false, BenchFilter::bilinear, weights,
                      nanoseconds,        0,      rms,     0.02};
  };
  bench.lookups.costs = {cost(MappingKind::mix, BenchWeights::single, 10, 1.0),
                         cost(MappingKind::mix, BenchWeights::fixed_8_8, 5, 1.05),
                         cost(MappingKind::index, BenchWeights::fixed_8_8, 2, 3.0)};
  bench.lookups.ratios = {{"one", 0.5, 0.9}, {"other", 2.0, {}}};
  bench.lookups.sizes = {{16, 10.0, 12.0}, {1 << 20, 11.0, {}}};
  return bench;
}

} // namespace

TEST_CASE("lookups are checked before they are timed, and every configuration is there") {
  BenchOptions options;
  options.rounds = 1;
  options.large = false;
  const LookupBench bench = bench_lookups(small_pack(), 0, options);
  CHECK(bench.costs.size() == 3 * 2 * 2 + 3 * 2 + 3);
  CHECK(bench.memory_bandwidth > 0);
  for (const LookupCost& cost : bench.costs) {
    CAPTURE(name_of(cost.mapping), name_of(cost.filter), name_of(cost.weights));
    CHECK(cost.nanoseconds > 0);
    CHECK(cost.off_reference <= (cost.weights == BenchWeights::fixed_8_8 ? 2.0 : 0.25));
    if (cost.weights != BenchWeights::fixed_8_8) CHECK(cost.off_reference < 0.01);
  }
  CHECK(bench.sizes.size() == 6);
  CHECK(bench.sizes.back().tiles == 1 << 20);
  for (const SizeCost& size : bench.sizes) CHECK_FALSE(size.stored);
}

TEST_CASE("values far above 1 are as exact as floats are") {
  Pack pack = small_pack();
  for (PackedMap& map : pack.maps) {
    map.encoding = Encoding::linear;
    map.depth = Depth::f32;
    for (Image& level : map.levels)
      for (float& value : level.data()) value = 1e6f + 1e6f * value;
  }
  BenchOptions options;
  options.rounds = 1;
  options.large = false;
  const LookupBench bench = bench_lookups(pack, 0, options);
  CHECK(bench.costs.front().off_reference > 1); // of 255: more than could be let pass below 1
}

TEST_CASE("packs with a corner pack are looked up with and without it") {
  Pack pack = small_pack();
  PackingOptions packing;
  packing.corner_pack = true;
  packing.virtual_size = {64, 64};
  pack = packed(tile_set_of(pack), packing, 1);
  BenchOptions options;
  options.rounds = 1;
  options.large = false;
  const LookupBench bench = bench_lookups(pack, 0, options);
  int with = 0;
  for (const LookupCost& cost : bench.costs)
    if (cost.sampler == BenchSampler::fast && !cost.cells) with += cost.corner_pack ? 1 : -1;
  CHECK(with == 0);
  CHECK(bench.costs.size() == 2 * 3 * 2 * 2 + 3 * 2 + 3);
}

TEST_CASE("mips are summed up, and the best mode advised") {
  const Bench bench = small_bench();
  const auto mips = mip_summaries(bench);
  REQUIRE(mips.size() == 5);
  CHECK(mips[1].mips == "box");
  for (const MipSummary& m : mips) {
    CHECK(m.together * m.together == Approx(m.interior * m.interior + m.border * m.border + m.jump * m.jump));
    if (m.mips == "corners") CHECK(m.jump < 0.5); // rounding alone
  }
  const auto best = std::min_element(mips.begin() + 1, mips.end(),
                                     [](const auto& a, const auto& b) { return a.together < b.together; });
  const auto standard =
      std::find_if(mips.begin(), mips.end(), [](const MipSummary& m) { return m.mode == MipOptions{}.mode; });
  REQUIRE(standard != mips.end());
  CHECK(standard->mips == "least-squares");
  const bool tie = standard->together <= best->together + std::max(0.1, 0.1 * best->together);
  CHECK(advice(bench).front().find(tie ? "keep 'least-squares', the default"
                                       : "choose '" + best->mips + "'") != std::string::npos);
  CHECK(bench_page(bench).find("class=\"best\"") != std::string::npos);
}

TEST_CASE("a limit that something else stands in for counts as met") {
  BenchRatio ratio{"threads", 1.0, 3.4};
  CHECK_FALSE(ratio.met());
  ratio.excused = true;
  CHECK(ratio.met());
}

TEST_CASE("a set that is not complete can't be benched") {
  Pack pack = small_pack();
  std::get<0>(pack.tiles).pop_back();
  CHECK_THROWS_AS(bench_lookups(pack, 0, {}), Error);
}

TEST_CASE("floats lose their places far out, tile + fraction doesn't") {
  const auto errors = coordinate_errors(small_pack(), 0, 1);
  REQUIRE(errors.size() == 9);
  CHECK(errors.front().log2_texels == 8);
  CHECK(errors.back().log2_texels == 40);
  CHECK(errors.back().as_float > 1.0);
  CHECK(errors.front().as_float < 0.1);
  for (const CoordinateError& error : errors) {
    CHECK(error.as_tile_and_float < 0.001);
    CHECK(error.as_double <= error.as_float);
  }
}

TEST_CASE("every mip mode is held against the truth, and its corner is drawn") {
  const Bench bench = small_bench();
  REQUIRE(bench.mips.size() == 5);
  CHECK(bench.mips[0].mips == "as stored");
  CHECK(bench.mips[1].mips == "box");
  // Noise is stored in place of mips; made anew they are near the truth inside tiles.
  CHECK(bench.mips[0].levels[1].zones[0].rms > 10);
  CHECK(bench.mips[1].levels[1].zones[0].rms < 0.5);
  REQUIRE(bench.corners.size() == 4);
  for (const CornerPicture& picture : bench.corners)
    CHECK(picture.error.size() == static_cast<std::size_t>(picture.side * picture.side));
}

TEST_CASE("advice is the fastest of what is as good as the best") {
  const auto lines = advice(small_bench());
  REQUIRE(lines.size() >= 2);
  CHECK(lines[2].find("'mix' mapping with 8.8 weights") != std::string::npos);
}

TEST_CASE("what wins within the noise is a tie, and a tie goes to what the pack has") {
  Bench bench = small_bench();
  const auto keeps = [&] {
    return advice(bench)[2].find("keep the pack's 'mix' mapping with float weights") != std::string::npos;
  };
  bench.lookups.costs[1].nanoseconds = 8.2; // 18 % less
  CHECK(keeps());
  bench.lookups.costs[1].nanoseconds = 7.8;
  CHECK_FALSE(keeps());
  bench.lookups.costs[0].noise = 0.3; // rounds of one thing differ by more than the two
  CHECK(keeps());
  bench.lookups.costs[0].rms_truth = 1.2; // not as exact: speed is no longer asked
  CHECK_FALSE(keeps());
}

TEST_CASE("mips that are better by what nobody sees are no reason to leave the default") {
  Bench bench = small_bench();
  const auto set = [&](std::size_t mode, double rms) {
    for (LevelError& level : bench.mips[mode].levels) {
      level.jump = 0;
      for (ZoneError& zone : level.zones) zone.rms = rms;
    }
  };
  for (std::size_t mode = 1; mode < bench.mips.size(); ++mode) set(mode, 3);
  set(2, 2.95);
  CHECK(advice(bench).front().find("keep 'least-squares', the default") != std::string::npos);
  set(2, 2);
  CHECK(advice(bench).front().find("choose 'edges'") != std::string::npos);
}

TEST_CASE("the reports of a bench tell the same figures") {
  const Bench bench = small_bench();
  const auto json = nlohmann::json::parse(bench_json(bench));
  CHECK(json["ratios"][0]["met"] == false);
  CHECK(json["ratios"][1]["at_least"].is_null());
  CHECK(json["sizes"][1]["stored"].is_null());
  CHECK(json["coordinates"].size() == 9);
  CHECK(json["mips"].size() == 5);
  CHECK(bench_csv(bench).find("ratio,\"one\",0.5\n") != std::string::npos);
  CHECK(bench_text(bench, true).find("at least 0.9: MISSED") != std::string::npos);
  CHECK(bench_text(bench, false).find("at least") == std::string::npos);
}

TEST_CASE("lookups run in turn, one round unmeasured, and the median is the middle") {
  std::string order;
  const auto times = in_turn({[&] { order += 'a'; }, [&] { order += 'b'; }}, {2}, 1.0);
  CHECK(order == "ababab");
  CHECK(times.size() == 2);
  CHECK(times[1].size() == 2);
  CHECK(median({5, 1, 9}) == 5);
  CHECK(spread({5, 1, 9}) == Approx(8.0 / 5));
  CHECK(quartile_spread({1, 10, 11, 10, 500, 10, 12, 9}) == Approx(1.0 / 10));
}

TEST_CASE("the page stands alone and escapes names") {
  const std::string page = bench_page(small_bench());
  CHECK(page.find("noise &amp; &lt;pack&gt;") != std::string::npos);
  CHECK(page.find("http") == std::string::npos);
  CHECK(page.find("<script") == std::string::npos);
  CHECK(page.find("nan") == std::string::npos);
  CHECK(page.size() < 2'000'000);
}
