#pragma once

#include "tilepack/bench/lookup_bench.h"
#include "tilepack/bench/stress_lookups.h"
#include "tilepack/measure/against_reference.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tilepack {

/// What coordinates far from the origin cost: RMS of bilinear lookups of level 0 against exact places, in
/// 8-bit units of linear light.
struct CoordinateError {
  int log2_texels = 0; ///< places lie between 2^n and 2^(n+1) texels from the origin
  double as_float = 0;
  double as_double = 0;
  double as_tile_and_float = 0;
};

/// For n = 8, 12, … 40, on the pack's tiles mapped over 2^31 tiles a side. Deterministic.
std::vector<CoordinateError> coordinate_errors(const Pack& pack, int map, std::uint64_t seed);

/// The error of bilinear lookups round one corner of tiles, to be looked at: 8-bit units of the encoded
/// value, the largest over channels.
struct CornerPicture {
  std::string mips;
  int level = 0;
  int side = 0;              ///< pixels, 8 a texel
  std::vector<double> error; ///< side * side
};

/// Everything that `tilepack bench` tells about one map of a pack.
struct Bench {
  std::string pack; ///< as the user named it
  std::string map;
  MappingKind mapping = MappingKind::mix; ///< the pack's own
  std::string target;                     ///< best instruction set here
  std::vector<ReferenceErrors> mips;      ///< the pack as it is, then with its levels made anew in each mode
  std::vector<CornerPicture> corners;
  LookupBench lookups;
  std::vector<BenchRatio> stored; ///< against OpenImageIO; empty if not asked for
  std::vector<CoordinateError> coordinates;
  std::vector<HardLookup> stress_lookups;
};

/// The pack as it is ("as stored"), then, for grid layouts, with each mip mode (in memory).
std::vector<ReferenceErrors> mip_mode_errors(const Pack& pack, int map, int lookups, std::uint64_t seed,
                                             const Progress& progress = {});
std::vector<CornerPicture> corner_pictures(const Pack& pack, int map, int level);

/// A mip mode in one line: RMS over levels 1 and up, 8-bit units of the encoded value.
struct MipSummary {
  std::string mips;
  std::optional<MipMode> mode; ///< absent: as stored
  double interior = 0;         ///< error inside tiles
  double border = 0;           ///< error at edges and corners
  double jump = 0;             ///< across borders
  /// What to go by where nothing else decides: the root of the sum of the three squares.
  double together = 0;
};
std::vector<MipSummary> mip_summaries(const Bench& bench);

/// What to choose, one sentence a line: from the figures, by fixed rules. What wins by less than the noise is
/// a tie, and a tie goes to the default (mips) or to what the pack has (lookups), so that two runs advise the
/// same.
std::vector<std::string> advice(const Bench& bench);

/// Measures all of one map of a pack. `name` is how the pack is called; `lookups` places a zone and level give
/// the errors of mips. Textures to compare with are stored in `folder`, about 400 MB, which must exist and is
/// left to the caller to remove; they are left out where options.large is false.
Bench measured_bench(const Pack& pack, int map, const std::string& name, int lookups,
                     const BenchOptions& options, const std::filesystem::path& folder,
                     const Progress& progress = {});

/// `with_targets`: also which ratios this project holds itself to, and whether they are met.
std::string bench_text(const Bench& bench, bool with_targets);
std::string bench_json(const Bench& bench);
std::string bench_csv(const Bench& bench); ///< section,name,value: one line a figure

} // namespace tilepack
