#include "tilepack/bench/stored_texture_bench.h"

#include "tilepack/bench/openimageio_textures.h"
#include "tilepack/bench/timing.h"
#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/openimageio_module.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/sampler/virtual_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tilepack {
namespace {

constexpr int stored_side = 8192; // texels
constexpr int mip_side = 4096;

// Values as stored, taken for linear: the texture system doesn't decode either.
Pack as_linear(const Pack& pack, int map) {
  Pack result = pack;
  result.maps = {pack.maps[static_cast<std::size_t>(map)]};
  result.maps[0].encoding = Encoding::linear;
  return result;
}

TextureMaker texture_of(const Pack& pack, Size size) {
  const PackedMap& map = pack.maps[0];
  return openimageio<TextureSystem>().maker(size, map.channels, map.depth, [&](int top, int rows) {
    return virtual_texture(pack, 0, 0, {0, top, size.width, rows});
  });
}

template <typename Make>
void make_texture(const Make& make, const std::filesystem::path& file) {
  try {
    make(file);
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& failed) {
    throw Error(ErrorKind::cannot_write, file.string(), failed.what());
  }
}

LookupFrame part_of(const LookupFrame& frame, std::size_t at, std::size_t count) {
  LookupFrame part = frame;
  const auto cut = [&](auto& array) {
    array.erase(array.begin(), array.begin() + static_cast<std::ptrdiff_t>(at));
    array.resize(count);
  };
  cut(part.x);
  cut(part.y);
  cut(part.tile_x);
  cut(part.tile_y);
  cut(part.level);
  return part;
}

SampleBatch batch_of(const LookupFrame& frame, std::size_t at, std::size_t count) {
  return {count,
          frame.tile_x.data() + at,
          frame.tile_y.data() + at,
          frame.x.data() + at,
          frame.y.data() + at,
          frame.level.data() + at};
}

// In level 0, where both must find the same; the texture system picks levels a little differently.
void compare_answers(const TextureLookup& stored, const FastSampler& fast, const LookupFrame& over_whole,
                     const LookupFrame& in_tiles) {
  const auto channels = static_cast<std::size_t>(fast.channels());
  std::vector<float> theirs(LookupFrame::bucket * channels);
  std::vector<float> ours(LookupFrame::bucket * channels);
  stored(part_of(over_whole, 0, LookupFrame::bucket), theirs, false);
  std::vector<float*> pointers;
  for (std::size_t c = 0; c < channels; ++c) pointers.push_back(ours.data() + c * LookupFrame::bucket);
  fast.sample(batch_of(in_tiles, 0, LookupFrame::bucket), Filter::bilinear, Weights::exact, pointers);
  constexpr std::size_t width = texture_batch;
  double sum = 0;
  for (std::size_t i = 0; i < LookupFrame::bucket; ++i)
    for (std::size_t c = 0; c < channels; ++c)
      sum += std::fabs(static_cast<double>(ours[c * LookupFrame::bucket + i]) -
                       static_cast<double>(theirs[(i / width * channels + c) * width + i % width]));
  const double mean = 255 * sum / static_cast<double>(ours.size());
  if (!(mean < 0.05))
    throw Error(
        ErrorKind::check_failed, "stored texture",
        fmt::format("lookups through the pack and of the stored texture differ by {:.2f} of 255 on average",
                    mean));
}

// All of a map's levels as files, as a pack has them.
void write_levels(const std::filesystem::path& folder, const TileMap& finest,
                  const std::vector<TileMap>& coarser) {
  const auto write = [&](const TileMap& level, std::size_t number) {
    write_image(folder / fmt::format("level_{}.{}", number, name_of(usual_container(level.depth))),
                level.tiles[0], level.depth, level.encoding);
  };
  write(finest, 0);
  for (std::size_t i = 0; i < coarser.size(); ++i) write(coarser[i], i + 1);
}

// The levels in memory, as baking makes them, against the program maketx, which reads an image file and
// writes the texture; both from file to file; and both by the levels alone, by maketx's own account.
std::vector<BenchRatio> mip_ratios(const Pack& pack, const std::filesystem::path& folder,
                                   const BenchOptions& options) {
  // Whole tiles, but one big tile as far as both are concerned.
  const int tiles = std::max(1, mip_side / pack.tile_size.width);
  const Size size{tiles * pack.tile_size.width, tiles * pack.tile_size.height};
  const PackedMap& map = pack.maps[0];
  const Encoding encoding = is_light(map.role) && map.depth == Depth::u8 ? Encoding::srgb : map.encoding;
  const std::string image = (folder / ("mips." + std::string(name_of(usual_container(map.depth))))).string();
  write_image(image, virtual_texture(pack, 0, 0, {0, 0, size.width, size.height}), map.depth, encoding);
  std::vector<double> wall_ratios, processor_ratios, file_ratios, level_ratios;
  for (int round = 0; round < std::min(options.rounds, 3); ++round) {
    const BenchTime start = bench_time();
    TileSet set{size, {1, 1, 0}, complete_edge_set(1, 1), {}, 0};
    set.maps.push_back({map.name, map.role, encoding, map.depth, {read_image(image, encoding).image}});
    const BenchTime read = bench_time();
    // It is over so soon that one disturbance is most of it: the median of a few.
    std::vector<TileMap> coarser;
    std::vector<double> walls, processors;
    for (int repeat = 0; repeat < 5; ++repeat) {
      coarser.clear();
      const BenchTime before = bench_time();
      coarser = coarser_levels(set, 0, {MipMode::box});
      const BenchTime after = bench_time();
      walls.push_back(after.wall - before.wall);
      processors.push_back(after.processor - before.processor);
    }
    const double chain = median(walls);
    const BenchTime made = bench_time();
    write_levels(folder, set.maps[0], coarser);
    const BenchTime written = bench_time();
    double levels_alone = 0;
    make_texture([&](const std::filesystem::path& file) { levels_alone = openimageio<TextureSystem>().maketx(image, file); },
                 folder / "mips.tx");
    const BenchTime end = bench_time();
    const double theirs = end.wall - written.wall;
    wall_ratios.push_back(theirs / chain);
    processor_ratios.push_back((end.processor - written.processor) / median(processors));
    file_ratios.push_back(theirs / (read.wall - start.wall + chain + written.wall - made.wall));
    level_ratios.push_back(levels_alone / chain);
  }
  return {{fmt::format("mip chain of {} x {} texels in memory, linear light, against the program maketx, "
                       "which reads and writes files, wall clock",
                       size.width, size.height),
           median(wall_ratios), 60.0},
          {"the same by processor time", median(processor_ratios), {}},
          {"the same against what maketx reports for its levels alone (encoded values averaged)",
           median(level_ratios),
           {}},
          {"both from image file to files of all levels, compressed", median(file_ratios), {}}};
}

} // namespace

std::vector<BenchRatio> bench_stored_texture(const Pack& original, int map,
                                             const std::filesystem::path& folder, const BenchOptions& options,
                                             const Progress& progress) {
  Pack pack = as_linear(original, map);
  const int columns = std::max(1, stored_side / pack.tile_size.width);
  const int rows = std::max(1, stored_side / pack.tile_size.height);
  pack.mapping = mix_mapping({columns, rows}, options.seed);
  const Size size{columns * pack.tile_size.width, rows * pack.tile_size.height};
  report(progress, "stored texture", 0.0);
  make_texture(texture_of(pack, size), folder / "stored.tx");

  const LookupFrame in_tiles = coherent_frame(0, 0, pack.tile_size.width);
  LookupFrame over_whole = in_tiles;
  for (float& x : over_whole.x) x /= static_cast<float>(columns);
  for (float& y : over_whole.y) y /= static_cast<float>(rows);
  const TextureLookup stored = openimageio<TextureSystem>().open(folder / "stored.tx", pack.maps[0].channels, size);
  std::vector<float> theirs(LookupFrame::bucket * static_cast<std::size_t>(pack.maps[0].channels));
  std::vector<float> ours(theirs.size());
  std::vector<float*> pointers;
  for (int c = 0; c < pack.maps[0].channels; ++c)
    pointers.push_back(ours.data() + static_cast<std::size_t>(c) * LookupFrame::bucket);

  std::vector<FastSampler> samplers;
  std::vector<std::function<void()>> runs{[&] { stored(over_whole, theirs, true); }};
  const std::vector<std::string> targets = fast_sampler_targets();
  std::vector<std::pair<std::string, double>> held_to{{targets.front(), 20.0}};
  if (targets.front() != "AVX2" && std::find(targets.begin(), targets.end(), "AVX2") != targets.end())
    held_to.emplace_back("AVX2", 15.0);
  samplers.reserve(held_to.size());
  for (const auto& [target, limit] : held_to) {
    samplers.emplace_back(pack, 0, target);
    compare_answers(stored, samplers.back(), over_whole, in_tiles);
    runs.push_back([&, n = samplers.size() - 1] {
      for (std::size_t at = 0; at < in_tiles.x.size(); at += LookupFrame::bucket)
        samplers[n].sample(batch_of(in_tiles, at, LookupFrame::bucket), Filter::trilinear, Weights::exact,
                           pointers);
    });
  }
  report(progress, "stored texture", 0.5);
  const auto times =
      in_turn(runs, {options.rounds}, static_cast<double>(LookupFrame::side) * LookupFrame::side);
  std::vector<BenchRatio> result;
  for (std::size_t i = 0; i < held_to.size(); ++i) {
    std::vector<double> ratios;
    for (std::size_t round = 0; round < times[0].size(); ++round)
      ratios.push_back(times[0][round] / times[i + 1][round]);
    result.push_back(
        {fmt::format("trilinear lookups ({}) against OpenImageIO's texture system on {} x {} texels stored",
                     held_to[i].first, size.width, size.height),
         median(ratios), held_to[i].second});
  }
  report(progress, "mips", 0.8);
  for (BenchRatio& ratio : mip_ratios(pack, folder, options)) result.push_back(std::move(ratio));
  return result;
}

} // namespace tilepack
