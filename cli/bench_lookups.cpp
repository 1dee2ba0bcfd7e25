#include "bench_lookups.h"

#include "jobs.h"

#include "tilepack/bake/output_check.h"
#include "tilepack/bench/bench.h"
#include "tilepack/pack/pack_maps.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/staged_outputs.h"
#include "tilepack/report/bench_page.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <random>
#include <string>

namespace tilepack::cli {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for stored textures, gone when this is.
class ScratchFolder {
public:
  ScratchFolder() {
    std::random_device random;
    for (int attempt = 0; attempt < 16; ++attempt) {
      path = fs::temp_directory_path() / fmt::format("tilepack-bench-{:08x}", random());
      std::error_code fault;
      const StepOnDisk step;
      if (!fs::create_directory(path, fault)) continue;
      unfinished = UnfinishedOutput(path);
      return;
    }
    throw Error(ErrorKind::cannot_write, fs::temp_directory_path().string(),
                "no temporary folder can be made there; set TMPDIR, or leave --full out");
  }
  ~ScratchFolder() {
    std::error_code fault;
    fs::remove_all(path, fault);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  fs::path path;

private:
  UnfinishedOutput unfinished;
};

} // namespace

int bench_lookups_of(const LookupBenchArguments& a, Console& console) {
  const JobLimit limit(a.jobs);
  check_page_name({"--report", a.report});
  if (!a.report.empty()) check_writable(a.report); // before minutes are spent
  const Pack pack = read_pack(a.pack);
  const int map = map_called(pack, a.map);
  BenchOptions options;
  options.rounds = a.quick ? 1 : a.rounds;
  options.large = !a.quick;
  std::optional<ScratchFolder> scratch;
  if (options.large) scratch.emplace();
  const Bench bench = measured_bench(pack, map, fs::path(a.pack).filename().string(), a.lookups, options,
                                     scratch ? scratch->path : fs::path(), console.progress());
  StagedOutputs outputs;
  if (!a.report.empty()) outputs.add_text(a.report, bench_page(bench));
  outputs.commit(console.progress());
  console.print(a.format == "json"  ? bench_json(bench)
                : a.format == "csv" ? bench_csv(bench)
                                    : bench_text(bench, a.targets));
  return 0;
}

} // namespace tilepack::cli
