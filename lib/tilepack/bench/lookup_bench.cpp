#include "tilepack/bench/lookup_bench.h"

#include "tilepack/bench/timing.h"
#include "tilepack/error/error.h"
#include "tilepack/mapping/even_pattern.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/sampler/ground_truth.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/virtual_texture.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tilepack {
namespace {

constexpr double samples_a_frame = static_cast<double>(LookupFrame::side) * LookupFrame::side;
constexpr double unknown_noise = 0.15;    // of a time measured too seldom to tell
constexpr std::size_t checked_every = 61; // samples of a frame compared with the reference: one in so many

Mapping mapping_of_kind(const Pack& pack, MappingKind kind, VirtualSize size, std::uint64_t seed) {
  const Mapping mix = mix_mapping(size, seed);
  if (kind == MappingKind::mix) return mix;
  if (kind == MappingKind::even) return even_mapping(size, pack.colors.corner, seed, pack.colors.variants);
  if (kind == MappingKind::permutation) return permutation_mapping(size, pack.colors, seed);
  return index_mapping(mix, pack.colors);
}

struct Buffers {
  std::array<std::vector<float>, 4> values;
  std::array<float*, 4> pointers{};
  Buffers(int channels, std::size_t count) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
      values[c].resize(count);
      pointers[c] = values[c].data();
    }
  }
  std::span<float* const> span(int channels) const {
    return {pointers.data(), static_cast<std::size_t>(channels)};
  }
};

// Bucket by bucket into the same small buffer, so that the memory for results isn't what is measured.
void look_up_frame(const FastSampler& sampler, const LookupFrame& frame, Filter filter, Weights weights,
                   const Buffers& out, bool cells = false) {
  for (std::size_t at = 0; at < frame.x.size(); at += LookupFrame::bucket) {
    const SampleBatch batch{LookupFrame::bucket, frame.tile_x.data() + at, frame.tile_y.data() + at,
                            frame.x.data() + at, frame.y.data() + at,      frame.level.data() + at};
    if (cells)
      sampler.sample_exact(batch, filter, weights, out.span(sampler.channels()));
    else
      sampler.sample(batch, filter, weights, out.span(sampler.channels()));
  }
}

// The plain texture's frame: the same texels, but the unit is the whole texture.
LookupFrame over_whole_texture(const LookupFrame& frame, int columns, int rows) {
  LookupFrame whole = frame;
  for (float& x : whole.x) x /= static_cast<float>(columns);
  for (float& y : whole.y) y /= static_cast<float>(rows);
  std::fill(whole.tile_x.begin(), whole.tile_x.end(), 0);
  std::fill(whole.tile_y.begin(), whole.tile_y.end(), 0);
  return whole;
}

double encoded(const PackedMap& map, double linear, std::size_t channel) {
  const bool light = static_cast<int>(channel) < color_channels(map.channels);
  return map.encoding == Encoding::srgb && light ? linear_to_srgb(linear) : linear;
}

// Fills in both errors of `cost`; throws where the fast sampler isn't the reference.
void check_answer(const Pack& pack, int map, const FastSampler& fast, const LookupFrame& frame, Filter filter,
                  Weights weights, LookupCost& cost) {
  const PackedMap& packed = pack.maps[static_cast<std::size_t>(map)];
  const auto channels = static_cast<std::size_t>(packed.channels);
  const ReferenceSampler reference(pack, map);
  const GroundTruth truth = GroundTruth::of_level_0(pack, map);
  Buffers out(packed.channels, frame.x.size());
  const SampleBatch batch{frame.x.size(), frame.tile_x.data(), frame.tile_y.data(),
                          frame.x.data(), frame.y.data(),      frame.level.data()};
  std::optional<GroundTruth> stored;
  if (cost.cells) {
    stored = GroundTruth::of_stored_levels(pack, map);
    fast.sample_exact(batch, filter, weights, out.span(packed.channels));
  } else {
    fast.sample(batch, filter, weights, out.span(packed.channels));
  }
  double squares = 0;
  double full_scale = 1; // floats keep 24 bits of the largest value there is
  std::size_t count = 0;
  std::array<double, 4> wanted{};
  std::array<double, 4> ideal{};
  for (std::size_t i = 0; i < frame.x.size(); i += checked_every) {
    const TileCoordinate x{frame.tile_x[i], static_cast<double>(frame.x[i])};
    const TileCoordinate y{frame.tile_y[i], static_cast<double>(frame.y[i])};
    const auto level = static_cast<double>(frame.level[i]);
    if (stored)
      stored->sample(x, y, level, filter, {wanted.data(), channels});
    else
      reference.sample(x, y, level, filter, {wanted.data(), channels});
    truth.sample(x, y, level, filter, {ideal.data(), channels});
    for (std::size_t c = 0; c < channels; ++c) {
      const auto got = static_cast<double>(out.values[c][i]);
      cost.off_reference = std::max(cost.off_reference, 255 * std::fabs(got - wanted[c]));
      full_scale = std::max(full_scale, std::fabs(wanted[c]));
      const double off = 255 * (encoded(packed, got, c) - encoded(packed, ideal[c], c));
      squares += off * off;
      ++count;
    }
  }
  cost.rms_truth = std::sqrt(squares / static_cast<double>(count));
  const double allowed = (weights == Weights::exact ? 0.25 : 2.0) * full_scale;
  if (cost.off_reference > allowed)
    throw Error(
        ErrorKind::check_failed, fmt::format("{} {}", name_of(cost.mapping), name_of(cost.filter)),
        fmt::format("the fast sampler is off by {:.3f} of 255, more than {}; this is a fault of tilepack",
                    cost.off_reference, allowed));
}

BenchFilter bench_filter(Filter filter) {
  return filter == Filter::bilinear ? BenchFilter::bilinear : BenchFilter::trilinear;
}

void bench_configurations(const Pack& pack, int map, const BenchOptions& options, const LookupFrame& frame,
                          LookupBench& bench) {
  const int channels = pack.maps[static_cast<std::size_t>(map)].channels;
  const std::string best = fast_sampler_targets().front();
  const Buffers out(channels, LookupFrame::bucket);
  std::vector<FastSampler> samplers;
  std::vector<std::function<void()>> runs;
  const auto bench_kind = [&](MappingKind kind, bool corner_pack, bool cells = false) {
    Pack with = pack;
    with.mapping = mapping_of_kind(pack, kind, {256, 256}, options.seed);
    if (!corner_pack) with.corner_pack.reset();
    samplers.emplace_back(with, map);
    for (const Filter filter : {Filter::bilinear, Filter::trilinear})
      for (const Weights weights : {Weights::exact, Weights::fixed_8_8}) {
        if (cells && weights != Weights::exact) continue;
        LookupCost cost;
        cost.target = best;
        cost.mapping = kind;
        cost.corner_pack = with.corner_pack.has_value();
        cost.cells = cells;
        cost.filter = bench_filter(filter);
        cost.weights = weights == Weights::exact ? BenchWeights::single : BenchWeights::fixed_8_8;
        check_answer(with, map, samplers.back(), frame, filter, weights, cost);
        bench.costs.push_back(cost);
        const std::size_t number = samplers.size() - 1;
        runs.push_back([&, number, filter, weights, cells] {
          look_up_frame(samplers[number], frame, filter, weights, out, cells);
        });
      }
  };
  for (const MappingKind kind :
       {MappingKind::index, MappingKind::permutation, MappingKind::mix, MappingKind::even}) {
    if (kind == MappingKind::even && !has_even_pattern(pack.colors.corner)) continue;
    bench_kind(kind, false);
    if (pack.corner_pack) bench_kind(kind, true);
    bench_kind(kind, false, true);
  }
  const auto times = in_turn(runs, {options.rounds}, samples_a_frame);
  for (std::size_t i = 0; i < times.size(); ++i) {
    bench.costs[i].nanoseconds = median(times[i]);
    bench.costs[i].noise = times[i].size() < 4 ? unknown_noise : quartile_spread(times[i]);
  }
}

void bench_reference(const Pack& pack, int map, const BenchOptions& options, const LookupFrame& frame,
                     LookupBench& bench) {
  const PackedMap& packed = pack.maps[static_cast<std::size_t>(map)];
  const auto channels = static_cast<std::size_t>(packed.channels);
  const ReferenceSampler reference(pack, map);
  const GroundTruth truth = GroundTruth::of_level_0(pack, map);
  // Of the frame's pixels, all alike: a square turned by the frame's angle.
  const double step = frame.texels_a_pixel;
  const Footprint pixel{step * std::cos(frame.angle) / pack.tile_size.width,
                        step * std::sin(frame.angle) / pack.tile_size.height,
                        -step * std::sin(frame.angle) / pack.tile_size.width,
                        step * std::cos(frame.angle) / pack.tile_size.height};
  for (const BenchFilter filter : {BenchFilter::bilinear, BenchFilter::trilinear, BenchFilter::elliptical}) {
    LookupCost cost;
    cost.sampler = BenchSampler::reference;
    cost.mapping = pack.mapping.kind;
    cost.corner_pack = pack.corner_pack.has_value();
    cost.filter = filter;
    cost.weights = BenchWeights::wide;
    std::array<double, 4> got{};
    std::array<double, 4> ideal{};
    double squares = 0;
    double count = 0;
    const auto run = [&](bool compare) {
      for (std::size_t i = 0; i < frame.x.size(); i += checked_every) {
        const TileCoordinate x{frame.tile_x[i], static_cast<double>(frame.x[i])};
        const TileCoordinate y{frame.tile_y[i], static_cast<double>(frame.y[i])};
        const auto level = static_cast<double>(frame.level[i]);
        const auto look_up = [&](const auto& sampler, std::array<double, 4>& value) {
          if (filter == BenchFilter::elliptical)
            sampler.sample(x, y, pixel, {value.data(), channels});
          else
            sampler.sample(x, y, level,
                           filter == BenchFilter::bilinear ? Filter::bilinear : Filter::trilinear,
                           {value.data(), channels});
        };
        look_up(reference, got);
        if (!compare) continue;
        look_up(truth, ideal);
        for (std::size_t c = 0; c < channels; ++c) {
          const double off = 255 * (encoded(packed, got[c], c) - encoded(packed, ideal[c], c));
          squares += off * off;
          count += 1;
        }
      }
    };
    run(true);
    cost.rms_truth = std::sqrt(squares / count);
    const auto sampled = static_cast<double>((frame.x.size() + checked_every - 1) / checked_every);
    cost.nanoseconds = median(in_turn({[&] { run(false); }}, {options.rounds}, sampled)[0]);
    bench.costs.push_back(cost);
  }
}

void bench_against_plain(const Pack& pack, int map, const BenchOptions& options, const LookupFrame& frame,
                         LookupBench& bench) {
  const PackedMap& packed = pack.maps[static_cast<std::size_t>(map)];
  const FastSampler plain(packed, packed.levels[0].size());
  const LookupFrame whole = over_whole_texture(frame, pack.layout.columns, pack.layout.rows);
  const Buffers out(packed.channels, LookupFrame::bucket);
  for (const auto& [kind, limit] :
       {std::pair{MappingKind::index, 0.9}, std::pair{MappingKind::permutation, 0.75},
        std::pair{MappingKind::mix, 0.0}, std::pair{MappingKind::even, 0.0}}) {
    if (kind == MappingKind::even && !has_even_pattern(pack.colors.corner)) continue;
    Pack with = pack;
    with.mapping = mapping_of_kind(pack, kind, {256, 256}, options.seed);
    const FastSampler tiled(with, map);
    const auto times = in_turn({[&] { look_up_frame(plain, whole, Filter::trilinear, Weights::exact, out); },
                                [&] { look_up_frame(tiled, frame, Filter::trilinear, Weights::exact, out); }},
                               {options.rounds}, samples_a_frame);
    std::vector<double> ratios;
    for (std::size_t r = 0; r < times[0].size(); ++r) ratios.push_back(times[0][r] / times[1][r]);
    bench.ratios.push_back(
        {fmt::format("speed of {} lookups against a plain texture of the pack's size", name_of(kind)),
         median(ratios), limit > 0 ? std::optional(limit) : std::nullopt});
  }
}

// The best of a few passes over arrays far larger than any cache.
double triad_bandwidth(int rounds) {
  constexpr std::size_t length = std::size_t{1} << 23;
  std::vector<double> a(length, 0.0);
  const std::vector<double> b(length, 1.0);
  const std::vector<double> c(length, 2.0);
  double best = 0;
  for (int round = 0; round < std::max(3, rounds); ++round) {
    const double start = bench_time().wall;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, length, std::size_t{1} << 16),
                      [&](const tbb::blocked_range<std::size_t>& part) {
                        for (std::size_t i = part.begin(); i < part.end(); ++i) a[i] = b[i] + 3.0 * c[i];
                      });
    best = std::max(best, 3 * sizeof(double) * length * 1e-9 / (bench_time().wall - start));
  }
  return best;
}

void bench_threads(const Pack& pack, int map, const BenchOptions& options, const LookupFrame& frame,
                   LookupBench& bench) {
  const FastSampler sampler(pack, map);
  const Buffers out(sampler.channels(), frame.x.size());
  const SampleBatch batch{frame.x.size(), frame.tile_x.data(), frame.tile_y.data(),
                          frame.x.data(), frame.y.data(),      frame.level.data()};
  constexpr int frames = 8; // one after another: threads asleep take as long to wake as a good part of one
  const auto seconds = [&](bool parallel) {
    const BenchTime start = bench_time();
    for (int i = 0; i < frames; ++i)
      if (parallel)
        sampler.sample_parallel(batch, Filter::trilinear, Weights::exact, out.span(sampler.channels()));
      else
        sampler.sample(batch, Filter::trilinear, Weights::exact, out.span(sampler.channels()));
    const BenchTime end = bench_time();
    return BenchTime{end.wall - start.wall, end.processor - start.processor};
  };
  bench.threads =
      static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  bench.memory_bandwidth = triad_bandwidth(options.rounds);
  std::vector<double> ratios, undisturbed, shares;
  // Coordinates and level in, values out; the pack stays in caches.
  const double bytes = frames * samples_a_frame * 4.0 * (5 + sampler.channels());
  for (int round = -1; round < options.rounds; ++round) {
    const BenchTime single = seconds(false);
    const BenchTime parallel = seconds(true);
    if (round < 0) continue;
    ratios.push_back(single.wall / parallel.wall);
    undisturbed.push_back(bench.threads * single.processor / parallel.processor);
    shares.push_back(bytes * 1e-9 / parallel.wall / bench.memory_bandwidth);
  }
  const bool four = bench.threads == 4;
  const double share = median(shares);
  constexpr double enough_bandwidth = 0.8;
  bench.ratios.push_back({fmt::format("speed of {} threads against one, wall clock", bench.threads),
                          median(ratios), four ? std::optional(3.4) : std::nullopt,
                          share >= enough_bandwidth});
  bench.ratios.push_back({"the same by processor time, as if no other program ran", median(undisturbed), {}});
  bench.ratios.push_back(
      {fmt::format("memory traffic of {} threads against a triad's {:.1f} GB/s ({:g} would "
                   "stand in for the scaling)",
                   bench.threads, bench.memory_bandwidth, enough_bandwidth),
       share,
       {}});
}

// A plain texture of so many tiles a side, each level a box of the one before.
PackedMap stored_texture(const Pack& pack, int map, int tiles) {
  PackedMap stored = pack.maps[static_cast<std::size_t>(map)];
  const int levels = static_cast<int>(stored.levels.size());
  stored.levels.clear();
  for (int level = 0; level < levels; ++level) {
    const Size tile = level_size(pack.tile_size, level);
    stored.levels.push_back(
        virtual_texture(pack, map, level, {0, 0, tiles * tile.width, tiles * tile.height}));
  }
  return stored;
}

void bench_sizes(const Pack& pack, int map, const BenchOptions& options, LookupBench& bench) {
  constexpr std::int64_t largest_stored = 4096; // texels a side
  const int channels = pack.maps[static_cast<std::size_t>(map)].channels;
  const Buffers out(channels, LookupFrame::bucket);
  std::vector<FastSampler> samplers;
  std::vector<LookupFrame> frames;
  std::vector<std::function<void()>> runs;
  std::vector<std::size_t> stored_run;
  const auto add = [&](FastSampler sampler, LookupFrame frame) {
    samplers.push_back(std::move(sampler));
    frames.push_back(std::move(frame));
    const std::size_t n = samplers.size() - 1;
    runs.push_back([&, n] { look_up_frame(samplers[n], frames[n], Filter::trilinear, Weights::exact, out); });
  };
  for (const int log2 : {4, 6, 8, 12, 16, 20}) {
    const std::int64_t tiles = std::int64_t{1} << log2;
    Pack with = pack;
    with.mapping = mix_mapping({tiles, tiles}, options.seed);
    const auto corner = static_cast<std::int32_t>(tiles * 3 / 8);
    bench.sizes.push_back({tiles, 0, {}});
    add(FastSampler(with, map), coherent_frame(corner, corner, pack.tile_size.width));
  }
  for (SizeCost& size : bench.sizes)
    if (options.large &&
        size.tiles * std::max(pack.tile_size.width, pack.tile_size.height) <= largest_stored) {
      const int tiles = static_cast<int>(size.tiles);
      const PackedMap stored = stored_texture(pack, map, tiles);
      stored_run.push_back(runs.size());
      add(FastSampler(stored, stored.levels[0].size()),
          over_whole_texture(coherent_frame(0, 0, pack.tile_size.width), tiles, tiles));
      size.stored = 0;
    }
  const auto times = in_turn(runs, {options.rounds}, samples_a_frame);
  // The least time of a size is what it costs; what else the machine does only adds to it.
  double least = INFINITY;
  double most = 0;
  for (std::size_t s = 0; s < bench.sizes.size(); ++s) {
    const double cost = *std::min_element(times[s].begin(), times[s].end());
    least = std::min(least, cost);
    most = std::max(most, cost);
  }
  std::size_t next_stored = 0;
  for (std::size_t s = 0; s < bench.sizes.size(); ++s) {
    bench.sizes[s].tiled = median(times[s]);
    if (bench.sizes[s].stored) bench.sizes[s].stored = median(times[stored_run[next_stored++]]);
  }
  bench.ratios.push_back({fmt::format("speed at the slowest size against the fastest, {} to {} tiles a side",
                                      bench.sizes.front().tiles, bench.sizes.back().tiles),
                          least / most, 0.9});
}

} // namespace

std::string_view corners_of(const LookupCost& cost) {
  if (cost.cells) return "own tiles";
  return cost.corner_pack ? "corner pack" : "tiles alone";
}

LookupFrame coherent_frame(std::int32_t tile_x, std::int32_t tile_y, int tile_side) {
  LookupFrame frame;
  const double step = frame.texels_a_pixel / tile_side;
  const double east = step * std::cos(frame.angle);
  const double south = step * std::sin(frame.angle);
  constexpr int bucket_side = 64;
  for (int bucket = 0; bucket < (LookupFrame::side / bucket_side) * (LookupFrame::side / bucket_side);
       ++bucket)
    for (std::size_t i = 0; i < LookupFrame::bucket; ++i) {
      const int px =
          bucket % (LookupFrame::side / bucket_side) * bucket_side + static_cast<int>(i) % bucket_side;
      const int py =
          bucket / (LookupFrame::side / bucket_side) * bucket_side + static_cast<int>(i) / bucket_side;
      frame.x.push_back(static_cast<float>(0.37 + east * px - south * py));
      frame.y.push_back(static_cast<float>(0.21 + south * px + east * py));
    }
  frame.tile_x.assign(frame.x.size(), tile_x);
  frame.tile_y.assign(frame.x.size(), tile_y);
  frame.level.assign(frame.x.size(), static_cast<float>(std::log2(frame.texels_a_pixel)));
  return frame;
}

LookupBench bench_lookups(const Pack& pack, int map, const BenchOptions& options, const Progress& progress) {
  const int complete = combinations(pack.colors) * pack.colors.variants;
  if (tile_count(pack.tiles) != complete)
    throw Error(
        ErrorKind::usage, "pack",
        fmt::format("has {} of the {} tiles of its colors; the bench needs a complete set, since it tries "
                    "every mapping",
                    tile_count(pack.tiles), complete));
  LookupBench bench;
  const LookupFrame frame = coherent_frame(20, 30, pack.tile_size.width);
  report(progress, "lookups", 0.0);
  bench_configurations(pack, map, options, frame, bench);
  bench_reference(pack, map, options, frame, bench);
  report(progress, "lookups", 0.4);
  bench_against_plain(pack, map, options, frame, bench);
  bench_threads(pack, map, options, frame, bench);
  report(progress, "sizes", 0.6);
  bench_sizes(pack, map, options, bench);
  report(progress, "sizes", 1.0);
  return bench;
}

} // namespace tilepack
