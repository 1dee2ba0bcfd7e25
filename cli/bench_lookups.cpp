#include "bench_lookups.h"

#include "jobs.h"
#include "output_file.h"

#include "tilepack/bench/bench.h"
#include "tilepack/bench/stored_texture_bench.h"
#include "tilepack/pack/pack_read.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
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
      if (fs::create_directory(path, fault)) return;
    }
    throw Error(ErrorKind::cannot_write, fs::temp_directory_path().string(),
                "no temporary folder can be made there; set TMPDIR, or use --quick, which needs none");
  }
  ~ScratchFolder() {
    std::error_code fault;
    fs::remove_all(path, fault);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  fs::path path;
};

int map_number(const Pack& pack, const std::string& name) {
  std::string names;
  for (std::size_t i = 0; i < pack.maps.size(); ++i) {
    if (name.empty() || pack.maps[i].name == name) return static_cast<int>(i);
    names += (i == 0 ? "" : ", ") + pack.maps[i].name;
  }
  throw Error(ErrorKind::usage, "--map", fmt::format("the pack has no map '{}'; it has {}", name, names));
}

} // namespace

int bench_lookups_of(const LookupBenchArguments& a, Console& console) {
  const JobLimit limit(a.jobs);
  check_page_name({"--report", a.report});
  if (!a.report.empty()) check_writable(a.report); // before minutes are spent
  const Pack pack = read_pack(a.pack);
  const int map = map_number(pack, a.map);
  const Progress progress = console.progress();
  BenchOptions options;
  options.rounds = a.quick ? 1 : a.rounds;
  options.large = !a.quick;

  Bench bench;
  bench.pack = fs::path(a.pack).filename().string();
  bench.map = pack.maps[static_cast<std::size_t>(map)].name;
  bench.target = fast_sampler_targets().front();
  bench.mips = mip_mode_errors(pack, map, a.lookups, options.seed, progress);
  bench.corners = corner_pictures(pack, map, std::min(2, pack.tile_levels - 1));
  bench.coordinates = coordinate_errors(pack, map, options.seed);
  bench.stress_lookups = stress_lookups();
  bench.lookups = bench_lookups(pack, map, options, progress);
  if (options.large) {
    const ScratchFolder scratch;
    bench.stored = bench_stored_texture(pack, map, scratch.path, options, progress);
  }
  if (!a.report.empty()) write_text_file(a.report, bench_page(bench));
  console.print(a.format == "json"  ? bench_json(bench)
                : a.format == "csv" ? bench_csv(bench)
                                    : bench_text(bench));
  return 0;
}

} // namespace tilepack::cli
