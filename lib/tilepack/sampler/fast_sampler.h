#pragma once

#include "tilepack/pack/pack.h"
#include "tilepack/sampler/filter.h"
#include "tilepack/sampler/sample_batch.h"

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

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

  /// The same with each tap read from the tile that it lies in: what GroundTruth::of_stored_levels finds, at every
  /// level and place, so that no border shows but by how levels were made (with MipMode::box not at all). A corner
  /// pack is not read. A plain texture has no borders: as sample().
  void sample_exact(const SampleBatch& batch, Filter filter, Weights weights,
                    std::span<float* const> out) const;

  /// As sample() on all threads that oneTBB is allowed; same bits.
  void sample_parallel(const SampleBatch& batch, Filter filter, Weights weights,
                       std::span<float* const> out) const;

private:
  struct State;
  std::unique_ptr<State> state;
};

/// The instruction sets that lookups can run on here, best first: "AVX3", "AVX2", "SSE4", …, "SCALAR".
std::vector<std::string> fast_sampler_targets();

} // namespace tilepack
