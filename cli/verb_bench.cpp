#include "bench_lookups.h"
#include "jobs.h"
#include "value_check.h"
#include "verb.h"

#include "tilepack/bake/output_check.h"
#include "tilepack/bench/span_bench.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/staged_outputs.h"
#include "tilepack/report/span_bench_page.h"

#include <memory>
#include <optional>
#include <string>

namespace tilepack::cli {
namespace {

struct BenchArguments {
  bool spans = false;
  bool full = false;
  bool quick = false;
  LookupBenchArguments of_lookups;
};

int bench_spans(const LookupBenchArguments& a, Console& console) {
  check_page_name({"--report", a.report});
  if (!a.report.empty()) check_writable(a.report); // before the measurements
  std::optional<Pack> pack;
  if (!a.pack.empty()) pack = read_pack(a.pack);
  const SpanBench bench = span_bench(pack ? &*pack : nullptr, a.quick, console.progress());
  StagedOutputs outputs;
  if (!a.report.empty()) outputs.add_text(a.report, span_bench_page(bench));
  outputs.commit(console.progress());
  console.print(a.format == "json" ? span_bench_json(bench) : span_bench_text(bench));
  return 0;
}

int run_bench(BenchArguments& a, Console& console) {
  if (a.quick && a.full)
    throw Error(ErrorKind::usage, "--quick", "and --full contradict each other; give one");
  a.of_lookups.quick = !a.full;
  const std::string& format = a.of_lookups.format;
  if (format != "text" && format != "json" && (format != "csv" || a.spans))
    throw Error(ErrorKind::usage, "--format",
                "'" + format + "' is not there; it is text or json, or csv for lookups");
  if (a.spans) return bench_spans(a.of_lookups, console);
  if (a.of_lookups.pack.empty())
    throw Error(ErrorKind::usage, "PACK", "is missing; only --spans can do without");
  return bench_lookups_of(a.of_lookups, console);
}

Action declare_bench(Options& options) {
  auto a = std::make_shared<BenchArguments>();
  LookupBenchArguments& of = a->of_lookups;
  options.option("PACK", of.pack, "folder of a pack, or its pack.json; --spans can do without");
  options.flag(
      "--spans", a->spans,
      "instead, the span methods of perspective views: error in pixels and texels against ns a pixel");
  options.option("--map", of.map, "name of the map for lookups (default: the first)").value("NAME");
  options.option("--report", of.report, "also write a page with tables and plots").value("FILE.html");
  options.option("--format", of.format, "what is printed: text (default), json, or for lookups csv")
      .value("NAME");
  options
      .option("--rounds", of.rounds,
              "lookups, with --full: medians are taken over so many, 1 to 1000 (default 9)")
      .check(whole_number(1, 1000))
      .value("N");
  options
      .option("--lookups", of.lookups,
              "places a zone and level for the errors of mips, 16 to 1000000 (default 4096)")
      .check(whole_number(16, 1000000))
      .value("N");
  options.flag("--full", a->full,
               "measure at length, for figures to go by: nine rounds, also against OpenImageIO; a minute or "
               "two, 2 GB of "
               "memory and 400 MB of temporary files");
  options.flag("--quick", a->quick,
               "a first look, one rough round of timing; so it is unless --full is given");
  options.flag(
      "--targets", of.targets,
      "lookups: also say which ratios tilepack's developers hold it to, and whether they are met here");
  add_jobs_option(options, of.jobs);
  return [a](Console& console) { return run_bench(*a, console); };
}

} // namespace

Verb bench_verb() {
  return {"bench", "measure speed against error, and mips against the truth",
          "  tilepack bench gravel.pack --report gravel.html\n"
          "  tilepack bench gravel.pack --full --format csv\n"
          "  tilepack bench --spans --report spans.html\n"
          "Times of one thread are processor time.\n",
          declare_bench};
}

} // namespace tilepack::cli
