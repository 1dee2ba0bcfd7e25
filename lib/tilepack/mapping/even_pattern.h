#pragma once

#include "tilepack/mapping/mix_hash.h"

#include <cstdint>
#include <vector>

namespace tilepack {

/// The mapping "even": corner colors from a pattern, a torus of 64 x 64 colors in which displacements of 1 to
/// 4 tiles bring fewer tiles onto equal ones than chance would, wherever one looks, and all tiles are shown
/// more evenly. With independent colors, half of all windows of 8 x 8 tiles of 2 colors show one tile 8 times
/// or more where 4 is fair, a quarter lack one, and half have a displacement that repeats a third of what is
/// seen.
///
/// The pattern alone would repeat. So the plane is cut into blocks of 64 x 64 corners, and each block shows
/// the pattern from another place, perhaps transposed or mirrored, and with the colors exchanged, all by a
/// hash of the block. Corner colors are free, so blocks need not match where they meet.
constexpr int even_pattern_side = 64;
constexpr int even_block_bits = 6;

/// Pattern colors row by row, for the numbers of corner colors for which has_even_pattern(). Found by
/// tests/bench/even_pattern_search.cpp: that of 2 colors by 3000 sweeps, those of 3 and 4 by earlier forms of
/// it (of 3 colors the earliest, which repeats fewer pairs of tiles 8 apart), whose patterns bring no equal
/// tiles side by side in any case.
std::vector<int> even_pattern(int colors);
constexpr bool has_even_pattern(int colors) {
  return colors >= 2 && colors <= 4;
}

/// The word of the block in which corner (x, y) lies, 0 <= x, y < 2^31. `keys` are the corner family's. Its
/// bits: 0..5 and 6..11 the place in the pattern, 12 mirrors x, 13 mirrors y, 14 exchanges x and y, 16..31
/// the shift of colors.
inline std::uint32_t even_word(const MixKeys& keys, std::uint32_t x, std::uint32_t y) {
  return mix_word(keys, x >> even_block_bits, y >> even_block_bits);
}

/// The block in which corner (x, y) lies, as one number: equal for corners of one block.
inline std::uint64_t even_block_of(std::uint32_t x, std::uint32_t y) {
  return std::uint64_t{x >> even_block_bits} << 32 | y >> even_block_bits;
}

/// The color, 0..colors-1, of corner (x, y) of a block with this word. `pattern`: even_pattern(colors).
inline std::uint32_t even_color(std::uint32_t word, const int* pattern, std::uint32_t x, std::uint32_t y,
                                std::uint32_t colors) {
  constexpr std::uint32_t mask = even_pattern_side - 1;
  const std::uint32_t u = (x + word) ^ (0u - (word >> 12 & 1u));
  const std::uint32_t v = (y + (word >> 6)) ^ (0u - (word >> 13 & 1u));
  const bool exchanged = (word >> 14 & 1u) != 0;
  const std::uint32_t column = (exchanged ? v : u) & mask;
  const std::uint32_t row = (exchanged ? u : v) & mask;
  const std::uint32_t color =
      static_cast<std::uint32_t>(pattern[row * even_pattern_side + column]) + color_of(word, colors);
  return color < colors ? color : color - colors;
}

/// The variant of cell (x, y) of the block of its north-west corner, which has this word. `variants`:
/// even_variants() of the pattern, by cell: the variant of the cell whose corner of least column and row is
/// there. In a mirrored block that corner is the cell's other one.
inline std::uint32_t even_variant(std::uint32_t word, const int* variants, std::uint32_t x, std::uint32_t y) {
  constexpr std::uint32_t mask = even_pattern_side - 1;
  const std::uint32_t mirrored_x = word >> 12 & 1u, mirrored_y = word >> 13 & 1u;
  const std::uint32_t u = ((x + word) ^ (0u - mirrored_x)) - mirrored_x;
  const std::uint32_t v = ((y + (word >> 6)) ^ (0u - mirrored_y)) - mirrored_y;
  const bool exchanged = (word >> 14 & 1u) != 0;
  const std::uint32_t column = (exchanged ? v : u) & mask;
  const std::uint32_t row = (exchanged ? u : v) & mask;
  return static_cast<std::uint32_t>(variants[row * even_pattern_side + column]);
}

inline std::uint32_t even_color(const MixKeys& keys, const int* pattern, std::uint32_t x, std::uint32_t y,
                                std::uint32_t colors) {
  return even_color(even_word(keys, x, y), pattern, x, y, colors);
}

} // namespace tilepack
