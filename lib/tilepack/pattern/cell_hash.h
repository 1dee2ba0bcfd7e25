#pragma once

#include "tilepack/mapping/mix_hash.h"
#include "tilepack/numeric/enum_names.h"
#include "tilepack/pattern/tile_map.h"

#include <cstdint>
#include <vector>

namespace tilepack {

/// What virtual (computed) maps draw their random numbers from.
enum class HashKind {
  mix,   ///< a keyed integer hash, mapping/mix_hash.h: no table, no period, 32 bits a number
  chain, ///< the permutation chain of [LN03, section 3.2]
};

template <>
inline constexpr auto enum_names<HashKind> =
    std::array{EnumName{HashKind::mix, "mix"}, EnumName{HashKind::chain, "chain"}};

/// A virtual indirection map and a virtual random map: the random number of each cell of a grid, found from the cell
/// alone.   [LN03, section 3.2]
///
/// chain: with σ a permutation of 0..n-1,
///   s₀ = σ(g mod n),  sᵢ = σ((⌊g / nⁱ⌋ + sᵢ₋₁) mod n)  up to the i with nⁱ⁺¹ >= N
/// over x, and on with the same over y, as Perlin's σ(x + σ(y)). (The paper's own vector form keeps x and y apart:
/// the column of its pattern would follow from the column of the cell alone.) The last σ is bijective in what goes
/// before, so along x each aligned run of n cells has each number exactly once: more even than chance. The number is
/// one of n, and there is no period but the grid's: the chain is as long as the grid needs.
///
/// Integers of 0..values-1. mix scales its word (bias below values / 2^32). chain takes s mod values, where n is a
/// multiple of `values`, so there is no bias; [LN03, figure 2.2] shows what happens else, floored_index() below.
class CellHash {
public:
  CellHash() = default;

  /// values: 1..65536. `stream`: 0.. for uncorrelated maps of one seed. `table`: the least n for chain, 1..65536;
  /// n is the least multiple of `values` that is not below it.
  CellHash(HashKind kind, PatternGrid grid, int values, std::uint64_t seed, int stream = 0, int table = 256);

  int values() const { return value_count; }
  int table_length() const { return static_cast<int>(sigma.size()); } ///< n; of mix 0

  /// 0..values-1.
  std::uint32_t index(PatternCell cell) const {
    if (hash == HashKind::mix)
      return static_cast<std::uint32_t>(std::uint64_t{word(cell)} * static_cast<std::uint32_t>(value_count) >>
                                        32);
    return chained(cell) % static_cast<std::uint32_t>(value_count);
  }

  /// In 0..1 (1 excluded): steps of 2^-32, of chain s / n.
  double number(PatternCell cell) const {
    if (hash == HashKind::mix) return word(cell) * 0x1p-32;
    return static_cast<double>(chained(cell)) / static_cast<double>(sigma.size());
  }

  /// What the numbers are computed from, for programs that do so elsewhere.
  HashKind kind() const { return hash; }
  const MixKeys& mix_keys_drawn() const { return keys; }                  ///< of mix
  const std::vector<std::uint32_t>& permutation() const { return sigma; } ///< σ of chain
  int chain_steps_x() const { return steps_x; } ///< how often chain looks σ up over x, then over y
  int chain_steps_y() const { return steps_y; }

private:
  std::uint32_t word(PatternCell cell) const {
    return mix_word(keys, static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y));
  }
  std::uint32_t chained(PatternCell cell) const {
    const auto n = static_cast<std::uint64_t>(sigma.size());
    std::uint64_t s = 0;
    auto g = static_cast<std::uint64_t>(cell.x);
    for (int i = 0; i < steps_x; ++i, g /= n) s = sigma[(g + s) % n];
    g = static_cast<std::uint64_t>(cell.y);
    for (int i = 0; i < steps_y; ++i, g /= n) s = sigma[(g + s) % n];
    return static_cast<std::uint32_t>(s);
  }

  HashKind hash = HashKind::mix;
  int value_count = 1;
  MixKeys keys;
  std::vector<std::uint32_t> sigma;
  int steps_x = 0, steps_y = 0;
};

/// The form that [LN03, figure 2.2] warns of: a number of n levels used as an index of 0..values-1 by flooring. Some
/// indices are then one level of n more frequent than others, unless n is a multiple of `values`. For comparison.
inline std::uint32_t floored_index(double number, int values) {
  return static_cast<std::uint32_t>(std::floor(number * values));
}

} // namespace tilepack
