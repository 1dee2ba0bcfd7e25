#include "tilepack/sampler/fast_sampler.h"

#include "tilepack/error/error.h"
#include "tilepack/lookup/lookup_tables.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/pack/pack_maps.h"
#include "tilepack/sampler/address.h"
#include "tilepack/sampler/fast_borders.h"
#include "tilepack/sampler/fast_corners.h"
#include "tilepack/sampler/fast_far.h"
#include "tilepack/sampler/fast_kernel.h"
#include "tilepack/sampler/pack_texels.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Imath/half.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace tilepack {
namespace {

// Samples a task, some 50 microseconds: large against what a task costs, small enough that others take over
// what a thread would do that wakes up late.
constexpr std::size_t parallel_grain = 4096;

TexelStorage storage_for(const PackedMap& map, bool alpha) {
  if (alpha) return TexelStorage::f32;
  if (map.encoding == Encoding::srgb) return map.depth == Depth::u8 ? TexelStorage::u16 : TexelStorage::f32;
  switch (map.depth) {
  case Depth::u8:
    return TexelStorage::u8;
  case Depth::u16:
    return TexelStorage::u16;
  case Depth::f16:
    return TexelStorage::f16;
  case Depth::f32:
    break;
  }
  return TexelStorage::f32;
}

std::size_t bytes_of(TexelStorage storage) {
  switch (storage) {
  case TexelStorage::u8:
    return 1;
  case TexelStorage::u16:
  case TexelStorage::f16:
    return 2;
  case TexelStorage::f32:
    break;
  }
  return 4;
}

void store(TexelStorage storage, float value, std::byte* at) {
  const auto put = [at](auto code) {
    std::copy_n(reinterpret_cast<const std::byte*>(&code), sizeof code, at);
  };
  switch (storage) {
  case TexelStorage::u8:
    return put(
        static_cast<std::uint8_t>(std::lround(static_cast<double>(quantised(value, Depth::u8)) * 255)));
  case TexelStorage::u16:
    return put(
        static_cast<std::uint16_t>(std::lround(static_cast<double>(quantised(value, Depth::u16)) * 65535)));
  case TexelStorage::f16:
    return put(half(value).bits());
  case TexelStorage::f32:
    return put(value);
  }
}

} // namespace

struct FastSampler::State {
  FastTables tables;
  FastKernel kernel;
  std::vector<std::byte> texels;
  Mapping mapping; // a copy, so that the pack may go
  std::optional<LookupTables> lookup;

  void take_kernel(std::string_view target);
  std::optional<FastFar> far_pass;
  std::optional<FastCorners> corner_pass;

  void take_texels(const PackedMap& map, Size tile);
  void take_layers(const Pack& pack, int map);
  void take_storage(const PackedMap& map, Size tile);
  void place_levels(const std::vector<Size>& sizes);
  void store_texel(int level, std::int64_t x, std::int64_t y, std::span<const float> texel);
  void take_mapping(const Pack& pack);
};

void FastSampler::State::take_kernel(std::string_view target) {
  const auto kernels = fast_kernels();
  const auto found = std::find_if(kernels.begin(), kernels.end(),
                                  [&](const FastKernel& k) { return target.empty() || target == k.target; });
  if (found == kernels.end())
    throw Error(ErrorKind::usage, "target",
                fmt::format("'{}' is no instruction set that runs here; {} is the best that does", target,
                            kernels.front().target));
  kernel = *found;
}

// What follows from the map alone.
void FastSampler::State::take_storage(const PackedMap& map, Size tile) {
  const int levels = static_cast<int>(map.levels.size());
  if (levels < 1 || levels > FastTables::max_levels || map.channels < 1 || map.channels > 4)
    throw Error(ErrorKind::usage, map.name,
                fmt::format("{} levels of {} channels can't be looked up; 1..{} levels of 1..4 channels can",
                            levels, map.channels, FastTables::max_levels));
  FastTables& t = tables;
  t.channels = map.channels;
  t.levels = levels;
  t.alpha = value_space(map).has_alpha();
  t.storage = storage_for(map, t.alpha);
  t.unit = t.storage == TexelStorage::u8 ? 1.0f / 255 : t.storage == TexelStorage::u16 ? 1.0f / 65535 : 1.0f;
  for (int l = 0; l < levels; ++l) {
    t.tile_width[l] = static_cast<float>(tile.width >> l);
    t.tile_height[l] = static_cast<float>(tile.height >> l);
  }
}

// Room for levels of these sizes, with a texel more on each side.
void FastSampler::State::place_levels(const std::vector<Size>& sizes) {
  std::int64_t count = 0;
  for (std::size_t l = 0; l < sizes.size(); ++l) {
    tables.stride[l] = sizes[l].width + 2;
    tables.base[l] = static_cast<std::int32_t>(count) + tables.stride[l] + 1;
    count += static_cast<std::int64_t>(sizes[l].width + 2) * (sizes[l].height + 2);
    if (count > std::numeric_limits<std::int32_t>::max())
      throw Error(ErrorKind::usage, "pack", "has more texels than the 2^31 that the fast sampler can reach");
  }
  texels.resize(static_cast<std::size_t>(count) * 4 * bytes_of(tables.storage));
  tables.texels = texels.data();
}

void FastSampler::State::store_texel(int level, std::int64_t x, std::int64_t y, std::span<const float> from) {
  const std::size_t value = bytes_of(tables.storage);
  const std::int64_t index = tables.base[level] + y * tables.stride[level] + x;
  std::byte* at = texels.data() + static_cast<std::size_t>(index) * 4 * value;
  for (std::size_t c = 0; c < from.size(); ++c) {
    const bool weighed = tables.alpha && c + 1 < from.size();
    store(tables.storage, weighed ? from[c] * from.back() : from[c], at + c * value);
  }
}

// Tiles side by side in textures that wrap.
void FastSampler::State::take_texels(const PackedMap& map, Size tile) {
  take_storage(map, tile);
  std::vector<Size> sizes;
  for (const Image& level : map.levels) sizes.push_back(level.size());
  place_levels(sizes);
  for (int l = 0; l < tables.levels; ++l) {
    tables.pitch_x[l] = tile.width >> l;
    tables.pitch_y[l] = tile.height >> l;
    const Image image = to_linear(map.levels[static_cast<std::size_t>(l)], map.encoding);
    tbb::parallel_for(-1, image.height() + 1, [&](int y) {
      for (int x = -1; x <= image.width(); ++x)
        store_texel(l, x, y, image.texel(wrapped(x, image.width()), wrapped(y, image.height())));
    });
  }
}

// The layers of an array one below the other, each with the texel beyond it on every side that filters read.
void FastSampler::State::take_layers(const Pack& pack, int map) {
  const PackTexels layers(pack, map);
  take_storage(pack.maps[static_cast<std::size_t>(map)], pack.tile_size);
  const int count = pack.layout.rows;
  std::vector<Size> sizes;
  for (int l = 0; l < tables.levels; ++l) {
    const Size tile = layers.tile_size(l);
    sizes.push_back({tile.width, count * (tile.height + 2) - 2});
  }
  place_levels(sizes);
  for (int l = 0; l < tables.levels; ++l) {
    const Size tile = layers.tile_size(l);
    tables.pitch_x[l] = tile.width;
    tables.pitch_y[l] = tile.height + 2;
    tbb::parallel_for(0, count, [&](int layer) {
      for (int y = -1; y <= tile.height; ++y)
        for (int x = -1; x <= tile.width; ++x)
          store_texel(l, x, static_cast<std::int64_t>(layer) * tables.pitch_y[l] + y,
                      layers.texel(l, {0, layer, 0}, x, y));
    });
  }
}

void FastSampler::State::take_mapping(const Pack& pack) {
  if (pack.layout.kind == LayoutKind::rotated)
    throw Error(ErrorKind::usage, "layout",
                "'rotated' is not one the fast sampler looks up; bake with " + field("layout", "tile-index") +
                    ", de-bruijn or array, or use the reference sampler");
  mapping = pack.mapping;
  lookup.emplace(pack, mapping);
  tables.lookup = &lookup->words();
  tables.width = mapping.size.width;
  tables.height = mapping.size.height;
}

FastSampler::FastSampler(const Pack& pack, int map, std::string_view target)
    : state(std::make_unique<State>()) {
  state->take_kernel(target);
  const PackedMap& own = map_at(pack, map);
  state->take_mapping(pack);
  if (pack.layout.kind == LayoutKind::array)
    state->take_layers(pack, map);
  else
    state->take_texels(own, pack.tile_size);
  if (!own.far_levels.empty()) state->far_pass.emplace(pack, map);
  if (pack.corner_pack) state->corner_pass.emplace(pack, map);
}

FastSampler::FastSampler(const PackedMap& map, Size size, std::string_view target)
    : state(std::make_unique<State>()) {
  state->take_kernel(target);
  state->take_texels(map, size);
}

FastSampler::FastSampler(FastSampler&&) noexcept = default;
FastSampler& FastSampler::operator=(FastSampler&&) noexcept = default;
FastSampler::~FastSampler() = default;

int FastSampler::channels() const {
  return state->tables.channels;
}

TexelStorage FastSampler::storage() const {
  return state->tables.storage;
}

std::size_t FastSampler::bytes() const {
  const std::size_t entries =
      state->mapping.table.size() + state->mapping.ids.size() + state->mapping.variants.size();
  const std::size_t by_tile = state->lookup ? state->lookup->bytes() : 0;
  return state->texels.size() + entries * sizeof(std::int32_t) + by_tile;
}

void FastSampler::sample(const SampleBatch& batch, Filter filter, Weights weights,
                         std::span<float* const> out) const {
  state->kernel.look_up(state->tables, batch, filter, weights, out.data());
  if (state->far_pass) state->far_pass->blend_in(state->tables, batch, filter, out);
  if (state->corner_pass) state->corner_pass->blend_in(batch, filter, out);
}

void FastSampler::sample_exact(const SampleBatch& batch, Filter filter, Weights weights,
                               std::span<float* const> out) const {
  state->kernel.look_up(state->tables, batch, filter, weights, out.data());
  if (state->lookup) mend_borders(state->tables, batch, filter, weights, out);
  if (state->far_pass) state->far_pass->blend_in(state->tables, batch, filter, out);
}

void FastSampler::sample_parallel(const SampleBatch& batch, Filter filter, Weights weights,
                                  std::span<float* const> out) const {
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, batch.count, parallel_grain), [&](const Range& range) {
    const auto from = [&](auto* array) { return array == nullptr ? nullptr : array + range.begin(); };
    const SampleBatch part{range.size(),  from(batch.tile_x), from(batch.tile_y),
                           from(batch.x), from(batch.y),      from(batch.level)};
    std::array<float*, 4> targets{};
    for (std::size_t c = 0; c < out.size() && c < targets.size(); ++c) targets[c] = out[c] + range.begin();
    sample(part, filter, weights, {targets.data(), out.size()});
  });
}

std::vector<std::string> fast_sampler_targets() {
  std::vector<std::string> names;
  for (const FastKernel& kernel : fast_kernels()) names.push_back(kernel.target);
  return names;
}

} // namespace tilepack
