#pragma once

#include "tilepack/pack/pack.h"
#include "tilepack/sampler/fast_tables.h"
#include "tilepack/sampler/filter.h"
#include "tilepack/sampler/sample_batch.h"

#include <array>
#include <span>
#include <vector>

namespace tilepack {

/// The far levels of a map for FastSampler: its kernels read levels of tiles, and here what lies past those is blended
/// in. Not for rotated layouts.
class FastFar {
public:
  /// Copies what it needs of pack.maps[map], which has far levels.
  FastFar(const Pack& pack, int map);

  /// `out` holds the values of the last level of tiles where a sample asks for a coarser one. Nearest stays
  /// there.
  void blend_in(const FastTables& tables, const SampleBatch& batch, Filter filter,
                std::span<float* const> out) const;

private:
  struct Level {
    int width = 0, height = 0; // of a layer
    std::vector<float> texels; // four channels, colors times alpha where there is one
  };
  using Value = std::array<float, 4>;

  Value value_at(const FastTables& tables, const SampleBatch& batch, std::size_t k, int level,
                 float share) const;
  void add(Value& sum, const Level& level, float u, float v, int layer, float share) const;

  std::vector<Level> levels;
  int tile_levels = 0;
  bool alpha = false;
  bool layered = false;
  float columns = 1, rows = 1;                            // of a grid
  float begin_x = 0, begin_y = 0, part_x = 1, part_y = 1; // of an array: where a tile lies in its layer
};

} // namespace tilepack
