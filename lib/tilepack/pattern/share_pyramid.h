#pragma once

#include "tilepack/pattern/pattern_values.h"
#include "tilepack/sampler/filter.h"

#include <cstdint>
#include <vector>

namespace tilepack {

/// How much of a stored index map each index takes up, at every scale: an areas map filtered.   [LN03, section 5.1]
class SharePyramid {
public:
  /// More different indices than this are not worth a pyramid.
  static constexpr std::size_t most_indices = 64;

  explicit SharePyramid(const StoredMap& map);

  bool built() const { return !indices.empty(); } ///< false: too many indices, or 2^24 cells and more
  std::size_t bytes() const;

  /// Adds `weight` shared out among the indices that a pixel of `width` cells a side shows round a place of the map
  /// (cells and fractions). Where cells are larger than the pixel, the border between two is a ramp as wide as the
  /// pixel; `dithered`: as wide as a cell. out[1 + index], made longer as needed: index -1 comes first.
  void add(TileCoordinate x, TileCoordinate y, double width, bool dithered, double weight,
           std::vector<double>& out) const;

private:
  void add_level(int level, TileCoordinate x, TileCoordinate y, double ramp, double weight,
                 std::vector<double>& out) const;

  std::vector<std::int64_t> indices; ///< rising
  std::vector<Size> sizes;
  std::vector<std::vector<float>> levels; ///< indices.size() shares a cell
};

} // namespace tilepack
