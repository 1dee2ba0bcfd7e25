#include "tilepack/bench/bench.h"

#include "tilepack/bake/packing.h"
#include "tilepack/bench/stored_texture_bench.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/numeric/random.h"
#include "tilepack/sampler/ground_truth.h"
#include "tilepack/sampler/reference_sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tilepack {
namespace {

bool is_grid(const Pack& pack) {
  return pack.layout.kind == LayoutKind::tile_index || pack.layout.kind == LayoutKind::de_bruijn;
}

// The same tiles, mapping and depth; only the coarser levels are made anew.
Pack with_mips(const Pack& pack, int map, MipMode mode) {
  Pack result = pack;
  result.mip_mode = mode;
  result.jump_weight =
      mode == MipMode::least_squares ? std::optional(MipOptions{}.jump_weight) : std::nullopt;
  PackedMap& packed = result.maps[static_cast<std::size_t>(map)];
  const std::size_t stored = packed.levels.size();
  const auto chain = mip_chain(tile_set_of(pack), map, {mode}, &pack.layout);
  for (std::size_t level = 1; level < stored && level < chain.size(); ++level)
    packed.levels[level] = quantised(atlas(chain[level].tiles, pack.layout), packed.depth);
  return result;
}

constexpr std::array modes{MipMode::box, MipMode::edges, MipMode::corners, MipMode::least_squares};

} // namespace

std::vector<ReferenceErrors> mip_mode_errors(const Pack& pack, int map, int lookups, std::uint64_t seed,
                                             const Progress& progress) {
  std::vector<ReferenceErrors> all{against_reference(pack, map, lookups, seed, progress)};
  all[0].mips = "as stored";
  if (!is_grid(pack) || pack.maps[static_cast<std::size_t>(map)].levels.size() < 2) return all;
  for (const MipMode mode : modes)
    all.push_back(against_reference(with_mips(pack, map, mode), map, lookups, seed, progress));
  return all;
}

std::vector<CornerPicture> corner_pictures(const Pack& pack, int map, int level) {
  constexpr int texels = 4; // either side of the corner less 2
  constexpr int pixels = 8; // a texel
  std::vector<CornerPicture> pictures;
  if (!is_grid(pack)) return pictures;
  const PackedMap& packed = pack.maps[static_cast<std::size_t>(map)];
  const Size tile = level_size(pack.tile_size, level);
  const GroundTruth truth = GroundTruth::of_level_0(pack, map);
  const auto channels = static_cast<std::size_t>(packed.channels);
  for (const MipMode mode : modes) {
    const Pack made = with_mips(pack, map, mode);
    const ReferenceSampler through_pack(made, map);
    CornerPicture picture{std::string(name_of(mode)), level, texels * pixels, {}};
    for (int y = 0; y < picture.side; ++y)
      for (int x = 0; x < picture.side; ++x) {
        const auto place = [&](int p, int side) {
          return from_texels(std::int64_t{2} * side, (p + 0.5) / pixels - texels / 2.0, side);
        };
        std::array<double, 4> got{};
        std::array<double, 4> wanted{};
        through_pack.sample(place(x, tile.width), place(y, tile.height), level, Filter::bilinear,
                            {got.data(), channels});
        truth.sample(place(x, tile.width), place(y, tile.height), level, Filter::bilinear,
                     {wanted.data(), channels});
        double worst = 0;
        for (std::size_t c = 0; c < channels; ++c) {
          const bool light =
              packed.encoding == Encoding::srgb && static_cast<int>(c) < color_channels(packed.channels);
          const auto code = [&](double v) { return 255 * (light ? linear_to_srgb(v) : v); };
          worst = std::max(worst, std::fabs(code(got[c]) - code(wanted[c])));
        }
        picture.error.push_back(worst);
      }
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

std::vector<CoordinateError> coordinate_errors(const Pack& pack, int map, std::uint64_t seed) {
  constexpr int places = 1000;
  Pack far = pack;
  far.mapping = mix_mapping({std::int64_t{1} << 31, std::int64_t{1} << 31}, seed);
  const ReferenceSampler sampler(far, map);
  const auto channels = static_cast<std::size_t>(sampler.channels());
  const Size tile = pack.tile_size;
  std::vector<CoordinateError> errors;
  for (int n = 8; n <= 40; n += 4) {
    std::array<double, 3> squares{};
    for (std::uint64_t i = 0; i < places; ++i) {
      const auto draw = [&](std::string_view axis) {
        return (std::int64_t{1} << n) +
               static_cast<std::int64_t>(random_bits(seed, axis, i) & ((std::uint64_t{1} << n) - 1));
      };
      const std::int64_t x = draw("far x");
      const std::int64_t y = draw("far y");
      const double rest_x = static_cast<double>(random_below(seed, "rest x", i, 1 << 20)) * 0x1p-20;
      const double rest_y = static_cast<double>(random_below(seed, "rest y", i, 1 << 20)) * 0x1p-20;
      const TileCoordinate exact_x = from_texels(x, rest_x, tile.width);
      const TileCoordinate exact_y = from_texels(y, rest_y, tile.height);
      const double double_x = static_cast<double>(x) + rest_x;
      const double double_y = static_cast<double>(y) + rest_y;
      const auto in_float = [](TileCoordinate c) {
        return TileCoordinate{c.tile, static_cast<double>(static_cast<float>(c.fraction))};
      };
      const std::array<std::pair<TileCoordinate, TileCoordinate>, 3> ways{
          std::pair{from_texels(static_cast<double>(static_cast<float>(double_x)), tile.width),
                    from_texels(static_cast<double>(static_cast<float>(double_y)), tile.height)},
          std::pair{from_texels(double_x, tile.width), from_texels(double_y, tile.height)},
          std::pair{in_float(exact_x), in_float(exact_y)}};
      std::array<double, 4> wanted{};
      sampler.sample(exact_x, exact_y, 0, Filter::bilinear, {wanted.data(), channels});
      for (std::size_t way = 0; way < ways.size(); ++way) {
        std::array<double, 4> got{};
        sampler.sample(ways[way].first, ways[way].second, 0, Filter::bilinear, {got.data(), channels});
        for (std::size_t c = 0; c < channels; ++c)
          squares[way] += (got[c] - wanted[c]) * (got[c] - wanted[c]);
      }
    }
    const auto rms = [&](double sum) {
      return 255 * std::sqrt(sum / (places * static_cast<double>(channels)));
    };
    errors.push_back({n, rms(squares[0]), rms(squares[1]), rms(squares[2])});
  }
  return errors;
}

std::vector<MipSummary> mip_summaries(const Bench& bench) {
  std::vector<MipSummary> summaries;
  for (const ReferenceErrors& errors : bench.mips) {
    // Sums of squares, and how many.
    std::array<double, 3> squares{};
    std::array<double, 3> counts{};
    const auto add = [&](std::size_t figure, double value) {
      squares[figure] += value * value;
      counts[figure] += 1;
    };
    for (const LevelError& level : errors.levels) {
      if (level.level == 0) continue;
      for (const ZoneError& zone : level.zones)
        if (zone.lookups > 0) add(zone.zone == Zone::interior ? 0 : 1, zone.rms);
      add(2, level.jump);
    }
    const auto rms = [&](std::size_t figure) {
      return counts[figure] > 0 ? std::sqrt(squares[figure] / counts[figure]) : 0.0;
    };
    const std::size_t number = summaries.size(); // the pack as it is comes first
    const auto mode = number == 0 ? std::nullopt : std::optional(modes[number - 1]);
    summaries.push_back({errors.mips, mode, rms(0), rms(1), rms(2),
                         std::sqrt(rms(0) * rms(0) + rms(1) * rms(1) + rms(2) * rms(2))});
  }
  return summaries;
}

Bench measured_bench(const Pack& pack, int map, const std::string& name, int lookups,
                     const BenchOptions& options, const std::filesystem::path& folder,
                     const Progress& progress) {
  Bench bench;
  bench.pack = name;
  bench.map = pack.maps[static_cast<std::size_t>(map)].name;
  bench.mapping = pack.mapping.kind;
  bench.target = fast_sampler_targets().front();
  bench.mips = mip_mode_errors(pack, map, lookups, options.seed, progress);
  bench.corners = corner_pictures(pack, map, std::min(2, pack.tile_levels - 1));
  bench.coordinates = coordinate_errors(pack, map, options.seed);
  bench.stress_lookups = stress_lookups();
  bench.lookups = bench_lookups(pack, map, options, progress);
  if (options.large) bench.stored = bench_stored_texture(pack, map, folder, options, progress);
  return bench;
}

} // namespace tilepack
