#include "bench_spans.h"
#include "verb.h"

#include <memory>

namespace tilepack::cli {
namespace {

struct BenchArguments {
  bool spans = false;
  SpanBenchArguments of_spans;
};

Action declare_bench(CLI::App& app) {
  auto a = std::make_shared<BenchArguments>();
  app.add_option("PACK", a->of_spans.pack, "folder of a pack, or its pack.json; --spans can do without");
  app.add_flag("--spans", a->spans,
               "the span methods of perspective views: error in pixels and texels against ns a pixel")
      ->required();
  app.add_option("--report", a->of_spans.report, "also write a page with tables and plots")
      ->type_name("FILE.html");
  app.add_option("--format", a->of_spans.format, "text (default) or json")->type_name("NAME");
  app.add_flag("--quick", a->of_spans.quick, "one rough round of timing and a small view, for a first look");
  return [a](Console& console) { return bench_spans(a->of_spans, console); };
}

} // namespace

Verb bench_verb() {
  return {"bench", "measure speed against error",
          "  tilepack bench --spans --report spans.html\n"
          "  tilepack bench gravel.pack --spans --format json\n",
          declare_bench};
}

} // namespace tilepack::cli
