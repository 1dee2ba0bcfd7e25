#pragma once

#include "tilepack/numeric/random.h"

#include <cstdint>

namespace tilepack {

/// Which family is asked for, of the lattice's colors or of the cells' variants: each has its own keys.
enum class MixAxis { horizontal = 0, vertical = 1, corner = 2, variant = 3 };

/// The keys of one family: four words of 32 bits drawn from the seed.
struct MixKeys {
  std::uint32_t k[4] = {};
};

inline MixKeys mix_keys(std::uint64_t seed, MixAxis axis) {
  // The sequence of splitmix64: cheap enough to be drawn anew for every cell.
  constexpr std::uint64_t increment = 0x9e3779b97f4a7c15u;
  const std::uint64_t start = mixed(seed) + (2 * static_cast<std::uint64_t>(axis) + 1) * increment;
  const std::uint64_t a = mixed(start);
  const std::uint64_t b = mixed(start + increment);
  return {{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a >> 32), static_cast<std::uint32_t>(b),
           static_cast<std::uint32_t>(b >> 32)}};
}

/// 32 random bits for the lattice element (x, y), 0 <= x, y < 2^31.
///
/// Four rounds of a Feistel network over the pair (x, y), in operations of 32 bits, so that vector units and
/// GPUs compute it as it stands. It is a bijection of pairs: no two cells share its state, unlike
/// P[P[x] + y], which is the same for all cells of equal P[x] + y, whence its copied columns.
inline std::uint32_t mix_word(const MixKeys& keys, std::uint32_t x, std::uint32_t y) {
  const auto round = [](std::uint32_t v, std::uint32_t odd) {
    v *= odd;
    return v ^ (v >> 15);
  };
  y ^= round(x + keys.k[0], 0x85ebca6bu);
  x ^= round(y + keys.k[1], 0xc2b2ae35u);
  y ^= round(x + keys.k[2], 0x9e3779b1u);
  x ^= round(y + keys.k[3], 0x27d4eb2fu);
  return x;
}

/// The high half of a word scaled to 0..colors-1 (1 <= colors <= 8): biased by at most colors / 2^16, not at
/// all for powers of two.
inline std::uint32_t color_of(std::uint32_t word, std::uint32_t colors) {
  return ((word >> 16) * colors) >> 16;
}

/// The color, 0..colors-1, of the lattice element (x, y), 0 <= x, y < 2^31.
inline std::uint32_t mix_color(const MixKeys& keys, std::uint32_t x, std::uint32_t y, std::uint32_t colors) {
  return color_of(mix_word(keys, x, y), colors);
}

} // namespace tilepack
