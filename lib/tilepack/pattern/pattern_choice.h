#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tilepack {

/// A probability map: `entries` patterns, indexed by a random number of 0..entries-1, each pattern as often as its
/// share asks for.   [LN03, section 3.2]
///
/// Shares are 0 or more and sum to 1 within 1e-6 (Error, invalid_content, where not). The smallest share that isn't 0
/// comes out as 1 / entries; what rounding leaves over goes to the largest remainders, so each is off by less than
/// 1 / entries. Patterns come in order of their number.
std::vector<int> probability_map(std::span<const double> shares, int entries);

/// How often 0..patterns-1 stand in a map, 0..1 each. Entries below 0 (blank) count for no one.
std::vector<double> shares_of(std::span<const int> map, int patterns);

/// A materials map: one probability map a material; `index` is any number, taken modulo the map's length.
///   [LN03, section 3.2]
struct MaterialsMap {
  std::vector<std::vector<int>> materials;

  int pattern(std::int64_t material, std::int64_t index) const {
    const auto& map = materials[static_cast<std::size_t>(material)];
    return map[static_cast<std::size_t>(index) % map.size()];
  }
};

} // namespace tilepack
