#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/numeric/enum_names.h"
#include "tilepack/pack/pack.h"
#include "tilepack/sampler/fast_sampler.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A frame of coherent lookups, as a renderer makes them: a square of 512 x 512 pixels, turned by 0.3
/// rad, 1.3 texels a pixel, in buckets of 64 x 64. Positions in tiles, structure of arrays.
struct LookupFrame {
  static constexpr int side = 512;
  static constexpr std::size_t bucket = 64 * 64;
  std::vector<std::int32_t> tile_x, tile_y; ///< of the frame's corner, the same for all
  std::vector<float> x, y;                  ///< tiles from there
  std::vector<float> level;                 ///< log2 1.3 everywhere
  double texels_a_pixel = 1.3;
  double angle = 0.3;
};

/// Starting at a tile; `tile_side` texels a tile at level 0.
LookupFrame coherent_frame(std::int32_t tile_x, std::int32_t tile_y, int tile_side);

enum class BenchSampler { fast, reference };
enum class BenchFilter { bilinear, trilinear, elliptical }; ///< elliptical: reference sampler only
/// What filter weights are held in.
enum class BenchWeights {
  single,    ///< float
  fixed_8_8, ///< 8 bits, as graphics hardware has them
  wide,      ///< double: the reference sampler
};
template <>
inline constexpr auto enum_names<BenchSampler> =
    std::array{EnumName{BenchSampler::fast, "fast"}, EnumName{BenchSampler::reference, "reference"}};
template <>
inline constexpr auto enum_names<BenchFilter> =
    std::array{EnumName{BenchFilter::bilinear, "bilinear"}, EnumName{BenchFilter::trilinear, "trilinear"},
               EnumName{BenchFilter::elliptical, "elliptical"}};
template <>
inline constexpr auto enum_names<BenchWeights> =
    std::array{EnumName{BenchWeights::single, "float"}, EnumName{BenchWeights::fixed_8_8, "8.8"},
               EnumName{BenchWeights::wide, "double"}};

/// One way to look the pack up, what it costs and how far off it is.
struct LookupCost {
  BenchSampler sampler = BenchSampler::fast;
  std::string target; ///< instruction set
  MappingKind mapping = MappingKind::mix;
  bool corner_pack = false; ///< corners are looked up in it; else tiles alone
  BenchFilter filter = BenchFilter::bilinear;
  BenchWeights weights = BenchWeights::single;
  double nanoseconds = 0;   ///< a sample, one thread, median
  double off_reference = 0; ///< largest difference from the reference sampler, 8-bit units of linear light
  double rms_truth = 0;     ///< RMS against the ground truth, 8-bit units of the encoded value
  double noise = 0;         ///< quartile_spread() of the rounds; 0.15 for fewer than four
  bool cells = false;       ///< each tap from its own tile: FastSampler::sample_exact
};
std::string_view corners_of(const LookupCost& cost); ///< "corner pack", "tiles alone", "own tiles"

/// A measured figure and what it is held to, if anything.
struct BenchRatio {
  std::string name;
  double value = 0;
  std::optional<double> at_least;
  bool excused = false; ///< a figure that may stand in for this one reaches its own limit
  bool met() const { return !at_least || excused || value >= *at_least; }
};

/// Cost at one size of the virtual texture; `stored` is a plain texture of that size, where it was made.
struct SizeCost {
  std::int64_t tiles = 0; ///< a side
  double tiled = 0;       ///< nanoseconds a sample
  std::optional<double> stored;
};

struct LookupBench {
  std::vector<LookupCost> costs;
  std::vector<BenchRatio> ratios; ///< tiled against plain, threads
  std::vector<SizeCost> sizes;
  int threads = 1;
  double memory_bandwidth = 0; ///< GB/s that a triad a = b + s c on all threads moves, a, b and c counted
};

struct BenchOptions {
  int rounds = 9;    ///< 1..1000; medians are taken over them
  bool large = true; ///< also what takes seconds and hundreds of megabytes: stored textures, maketx
  std::uint64_t seed = 1;
};

/// Times the fast and the reference sampler on one map of a pack, after checking each answer against the
/// reference (Error, check_failed, if one is off by more than a quarter of an 8-bit unit; 8.8 weights: 2
/// units; both times the largest value where that is above 1). Times differ from run to run, errors don't.
LookupBench bench_lookups(const Pack& pack, int map, const BenchOptions& options,
                          const Progress& progress = {});

} // namespace tilepack
