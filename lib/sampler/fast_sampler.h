#pragma once

#include "tilepack/pack/pack.h"
#include "tilepack/sampler/filter.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// Many lookups at once, as a structure of arrays. Sample i lies at tile_x[i] + x[i] tiles from the west
/// border of the virtual texture and tile_y[i] + y[i] from its north border. All arrays have `count` entries.
struct SampleBatch {
  std::size_t count = 0;
  const std::int32_t* tile_x = nullptr; ///< null: all 0
  const std::int32_t* tile_y = nullptr; ///< null: all 0
  const float* x = nullptr;             ///< any float, as in TileCoordinate::fraction
  const float* y = nullptr;
  const float* level = nullptr; ///< null: all 0
};

/// How exactly bilinear and level weights are kept.
enum class Weights {
  exact,    ///< floats
  fixed_8_8 ///< positions rounded to 1/256 texel and level weights to 1/256, as graphics hardware does
};

/// How the texels are kept for fast lookup; which one follows from the map.
enum class TexelStorage {
  u8,  ///< linear 8-bit maps: as they are
  u16, ///< linear 16-bit maps as they are; sRGB 8-bit maps decoded to linear light, off by 7.7e-6 at most
  f16, ///< linear half maps: as they are
  f32  ///< everything else: decoded floats; color with alpha is premultiplied
};

/// Looks a pack up as ReferenceSampler does, in single precision and with the vector instructions that the
/// machine has (chosen when the program runs).
///
/// What differs from the reference: positions within a tile are floats, so a weight is off by up to tile side
/// * 2^-24; where alpha is 0, colors are 0; a fraction of 2^62 tiles or more counts as 0 there and here. The
/// last bits differ between kinds of processors: results are for looking at, not for packs.
///
/// Layouts: grids that wrap (tile_index, de_bruijn) and arrays. A corner pack is blended in as the reference
/// does, by the reference: places near corners of tiles, at coarse levels most places, cost what they cost
/// there and have exact weights. Rotated layouts are for ReferenceSampler alone.
class FastSampler {
public:
  /// Copies what it needs of pack.maps[map]. `target`: one of fast_sampler_targets(), empty for the best.
  /// Throws Error (usage) for a target, map or layout it can't use.
  FastSampler(const Pack& pack, int map, std::string_view target = {});

  /// A plain texture without tiles: level images of halved sizes, wrapping; coordinates are in units of the
  /// whole texture. What a tiled lookup is measured against.
  FastSampler(const PackedMap& map, Size size, std::string_view target = {});

  FastSampler(FastSampler&&) noexcept;
  FastSampler& operator=(FastSampler&&) noexcept;
  ~FastSampler();

  int channels() const;
  TexelStorage storage() const;
  std::size_t bytes() const; ///< taken by texels and tables

  /// Linear values, one array a channel: out[c][i] for sample i, c in 0..channels()-1. On this thread alone.
  void sample(const SampleBatch& batch, Filter filter, Weights weights, std::span<float* const> out) const;

  /// The same on all threads that oneTBB is allowed; same bits.
  void sample_parallel(const SampleBatch& batch, Filter filter, Weights weights,
                       std::span<float* const> out) const;

private:
  struct State;
  std::unique_ptr<State> state;
};

/// The instruction sets that lookups can run on here, best first: "AVX3", "AVX2", "SSE4", …, "SCALAR".
std::vector<std::string> fast_sampler_targets();

} // namespace tilepack
