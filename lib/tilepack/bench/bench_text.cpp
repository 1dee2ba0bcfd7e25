#include "tilepack/bench/bench.h"
#include "tilepack/json/json_value.h"

#include <fmt/format.h>

namespace tilepack {
namespace {

std::vector<BenchRatio> all_ratios(const Bench& bench) {
  std::vector<BenchRatio> ratios = bench.stored;
  ratios.insert(ratios.end(), bench.lookups.ratios.begin(), bench.lookups.ratios.end());
  return ratios;
}

} // namespace

std::string bench_text(const Bench& bench, bool with_targets) {
  std::string text =
      fmt::format("{}, map {}: {} on this machine\n\nWhat to choose\n", bench.pack, bench.map, bench.target);
  for (const std::string& line : advice(bench)) text += "  " + line + '\n';
  if (bench.mips.size() > 1) {
    text += "\nMips in short: RMS over levels 1 and up, 8-bit units\n"
            "  mips             interior   border     jump  together\n";
    for (const MipSummary& m : mip_summaries(bench))
      text += fmt::format("  {:<15} {:>9.2f} {:>8.2f} {:>8.2f} {:>9.2f}\n", m.mips, m.interior, m.border,
                          m.jump, m.together);
  }
  text += "\nSpeed against error (one thread; off: largest difference from the reference, of 255 linear;\n"
          "rms: against the ground truth, 8-bit units)\n"
          "  sampler    mapping      corners      filter     weights  ns/sample   M/s       off      rms\n";
  for (const LookupCost& c : bench.lookups.costs)
    text +=
        fmt::format("  {:<10} {:<12} {:<12} {:<10} {:<7} {:>10.2f} {:>6.1f} {:>9.5f} {:>8.3f}\n",
                    name_of(c.sampler), name_of(c.mapping), corners_of(c), name_of(c.filter),
                    name_of(c.weights), c.nanoseconds, 1000 / c.nanoseconds, c.off_reference, c.rms_truth);
  text += "\nRatios (medians of rounds run in turn)\n";
  for (const BenchRatio& r : all_ratios(bench))
    text += fmt::format("  {:>8.2f}  {}{}\n", r.value, r.name,
                        with_targets && r.at_least
                            ? fmt::format(" (at least {:g}: {})", *r.at_least, r.met() ? "met" : "MISSED")
                            : "");
  text += "\nCost against size of the virtual texture, ns a sample\n  tiles a side    tiled   stored\n";
  for (const SizeCost& s : bench.lookups.sizes)
    text += fmt::format("  {:>12} {:>8.2f} {:>8}\n", s.tiles, s.tiled,
                        s.stored ? fmt::format("{:.2f}", *s.stored) : "-");
  text += "\nFar coordinates, RMS in 8-bit units\n  texels      float    double  tile + float\n";
  for (const CoordinateError& e : bench.coordinates)
    text += fmt::format("  2^{:<4} {:>10.4f} {:>9.5f} {:>13.6f}\n", e.log2_texels, e.as_float, e.as_double,
                        e.as_tile_and_float);
  text += "\nHard cases: largest difference from what is promised, 8-bit units of linear light\n" +
          hard_lookups_text(bench.stress_lookups);
  return text + "\nMips\n" + reference_errors_text(bench.mips);
}

std::string bench_json(const Bench& bench) {
  JsonValue costs = JsonValue::array();
  for (const LookupCost& c : bench.lookups.costs)
    costs.push_back({{"sampler", name_of(c.sampler)},
                     {"target", c.target},
                     {"mapping", name_of(c.mapping)},
                     {"corners", corners_of(c)},
                     {"filter", name_of(c.filter)},
                     {"weights", name_of(c.weights)},
                     {"nanoseconds", c.nanoseconds},
                     {"off_reference", c.off_reference},
                     {"rms_truth", c.rms_truth}});
  JsonValue ratios = JsonValue::array();
  for (const BenchRatio& r : all_ratios(bench))
    ratios.push_back({{"name", r.name}, {"value", r.value}, {"at_least", r.at_least}, {"met", r.met()}});
  JsonValue sizes = JsonValue::array();
  for (const SizeCost& s : bench.lookups.sizes)
    sizes.push_back({{"tiles", s.tiles}, {"tiled", s.tiled}, {"stored", s.stored}});
  JsonValue coordinates = JsonValue::array();
  for (const CoordinateError& e : bench.coordinates)
    coordinates.push_back({{"log2_texels", e.log2_texels},
                           {"float", e.as_float},
                           {"double", e.as_double},
                           {"tile_and_float", e.as_tile_and_float}});
  JsonValue summaries = JsonValue::array();
  for (const MipSummary& m : mip_summaries(bench))
    summaries.push_back({{"mips", m.mips},
                         {"interior", m.interior},
                         {"border", m.border},
                         {"jump", m.jump},
                         {"together", m.together}});
  JsonValue hard = JsonValue::array();
  for (const HardLookup& c : bench.stress_lookups)
    hard.push_back({{"input", c.input},
                    {"promise", c.promise},
                    {"reference", c.reference},
                    {"fast", c.fast},
                    {"kept", c.kept()}});
  const JsonValue json = {{"pack", bench.pack},
                          {"map", bench.map},
                          {"target", bench.target},
                          {"threads", bench.lookups.threads},
                          {"memory_gigabytes_a_second", bench.lookups.memory_bandwidth},
                          {"advice", advice(bench)},
                          {"lookups", std::move(costs)},
                          {"ratios", std::move(ratios)},
                          {"sizes", std::move(sizes)},
                          {"coordinates", std::move(coordinates)},
                          {"hard_lookups", std::move(hard)},
                          {"mips_in_short", std::move(summaries)},
                          {"mips", reference_errors_value(bench.mips)}};
  return json_text(json);
}

std::string bench_csv(const Bench& bench) {
  std::string text = "section,name,value\n";
  const auto line = [&](const std::string& section, const std::string& name, double value) {
    text += fmt::format("{},\"{}\",{:.6g}\n", section, name, value);
  };
  for (const LookupCost& c : bench.lookups.costs) {
    const std::string name = fmt::format("{} {} {} {} {}", name_of(c.sampler), name_of(c.mapping),
                                         corners_of(c), name_of(c.filter), name_of(c.weights));
    line("nanoseconds", name, c.nanoseconds);
    line("off_reference", name, c.off_reference);
    line("rms_truth", name, c.rms_truth);
  }
  for (const BenchRatio& r : all_ratios(bench)) line("ratio", r.name, r.value);
  for (const SizeCost& s : bench.lookups.sizes) {
    line("size_tiled", fmt::format("{}", s.tiles), s.tiled);
    if (s.stored) line("size_stored", fmt::format("{}", s.tiles), *s.stored);
  }
  for (const CoordinateError& e : bench.coordinates) {
    line("coordinate_float", fmt::format("2^{}", e.log2_texels), e.as_float);
    line("coordinate_double", fmt::format("2^{}", e.log2_texels), e.as_double);
    line("coordinate_tile_and_float", fmt::format("2^{}", e.log2_texels), e.as_tile_and_float);
  }
  for (const HardLookup& c : bench.stress_lookups) {
    line("hard_reference", c.input, c.reference);
    if (c.fast) line("hard_fast", c.input, *c.fast);
  }
  for (const ReferenceErrors& errors : bench.mips)
    for (const LevelError& level : errors.levels) {
      for (const ZoneError& zone : level.zones)
        if (zone.lookups > 0)
          line("mip_rms", fmt::format("{} level {} {}", errors.mips, level.level, name_of(zone.zone)),
               zone.rms);
      line("mip_jump", fmt::format("{} level {}", errors.mips, level.level), level.jump);
    }
  return text;
}

} // namespace tilepack
