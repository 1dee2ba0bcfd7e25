#pragma once

#include "tilepack/mapping/even_pattern.h"
#include "tilepack/mapping/mix_hash.h"
#include "tilepack/numeric/enum_names.h"

#include <cstddef>
#include <cstdint>

namespace tilepack {

/// What a mapping computes a cell's tile from; see mapping.h.
enum class MappingKind { permutation, mix, even, index };

template <>
inline constexpr auto enum_names<MappingKind> =
    std::array{EnumName{MappingKind::permutation, "permutation"}, EnumName{MappingKind::mix, "mix"},
               EnumName{MappingKind::even, "even"}, EnumName{MappingKind::index, "index"}};

/// A mapping as words of 32 bits, and the colors of the lattice that follow from them: the formulas of
/// mapping.h, written once for every lookup, on the CPU and in a shader.
///
/// All words are unsigned, and arithmetic is modulo 2^32. Only the hash mix_word() and
/// the places in even_color() go round; every other sum stays below 2^32.
///
/// Tables are not owned: they are those of the Mapping, which must outlive this.
struct LatticeWords {
  MappingKind kind = MappingKind::permutation;
  std::uint32_t corner_colored = 0; ///< 1: one family of colors, C, at corners; 0: H and V, on edges
  std::uint32_t width = 1;          ///< of the virtual texture in tiles, 1..2^31; any, not only powers of 2
  std::uint32_t height = 1;         ///< 1..2^31
  std::uint32_t horizontal_colors = 0;  ///< Kh, 1..8; of corners K
  std::uint32_t vertical_colors = 0;    ///< Kv, 1..8; of corners K
  MixKeys horizontal_keys;              ///< mix and even: of the family H; of corners C
  MixKeys vertical_keys;                ///< mix: of the family V
  std::uint32_t table_length = 0;       ///< permutation: n, 1..2^31; even: 64 * 64
  const int* table = nullptr;           ///< permutation: P, entries 0..n-1; even: the pattern, entries 0..K-1
  const int* ids = nullptr;             ///< index: width * height tile ids, row by row
  std::uint32_t variants = 1;           ///< V, 1..8, of each combination of colors; not for index
  MixKeys variant_keys;                 ///< mix: of the cells' variants
  const int* variant_pattern = nullptr; ///< even with V > 1: 64 * 64 variants, entries 0..V-1
};

/// A cell of the virtual texture, 0 <= x < width, 0 <= y < height.
struct LatticeCell {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};

/// i modulo side in 0..side-1, for i in -2^31..2^31-1 and side 1..2^31. Unsigned throughout: a signed
/// remainder can't hold a side of 2^31, and shading languages leave that of negative numbers open.
inline std::uint32_t wrapped_cell(std::int32_t i, std::uint32_t side) {
  const std::uint32_t word = static_cast<std::uint32_t>(i);
  return i < 0 ? side - 1 - ~word % side : word % side; // ~word = -i - 1
}

/// The one after cell coordinate `i`, round the border.
inline std::uint32_t next_cell(std::uint32_t i, std::uint32_t side) {
  return i + 1 == side ? 0 : i + 1;
}

/// P[i mod n]: i is a coordinate below 2^31, twice one, or a coordinate and an entry of P: below 2^32.
inline std::uint32_t permuted(const LatticeWords& w, std::uint32_t i) {
  // Tables are mostly twice as long as the texture: one subtraction does, where a remainder is a division.
  const std::uint32_t n = w.table_length;
  if (i >= n) i -= n;
  if (i >= n) i %= n;
  return static_cast<std::uint32_t>(w.table[i]);
}

/// H(x, y), the color of the edge on top of cell (x, y), 0..Kh-1. Not for even and index; here and below
/// 0 <= x < width, 0 <= y < height.
inline std::uint32_t horizontal_color(const LatticeWords& w, std::uint32_t x, std::uint32_t y) {
  if (w.kind == MappingKind::mix) return mix_color(w.horizontal_keys, x, y, w.horizontal_colors);
  return permuted(w, permuted(w, x) + y) % w.horizontal_colors; // [Wei04, Eq. 2]
}

/// V(x, y), the color of the edge on the left of cell (x, y), 0..Kv-1. Not for even and index.
inline std::uint32_t vertical_color(const LatticeWords& w, std::uint32_t x, std::uint32_t y) {
  if (w.kind == MappingKind::mix) return mix_color(w.vertical_keys, x, y, w.vertical_colors);
  return permuted(w, x + permuted(w, 2 * y)) % w.vertical_colors; // [Wei04, Eq. 2]
}

/// C(x, y), the color of the north-west corner of cell (x, y), 0..K-1. Not for index.
inline std::uint32_t corner_color(const LatticeWords& w, std::uint32_t x, std::uint32_t y) {
  if (w.kind == MappingKind::even) return even_color(w.horizontal_keys, w.table, x, y, w.horizontal_colors);
  return horizontal_color(w, x, y); // the formula of H with the keys of corners
}

/// The colors of a cell in the order in which they are the digits of its tile's id: north, east, south, west
/// or, of corners, nw, ne, sw, se. Both are "a, its neighbour, the same a row on".
struct CellColors {
  std::uint32_t a = 0; ///< north or nw
  std::uint32_t b = 0; ///< east or ne
  std::uint32_t c = 0; ///< south or sw
  std::uint32_t d = 0; ///< west or se
  bool operator==(const CellColors&) const = default;
};

/// The colors of a cell within the texture. Not for index mappings, which hold tiles and no colors.
inline CellColors colors_of_cell(const LatticeWords& w, LatticeCell cell) {
  const auto [x, y] = cell;
  const std::uint32_t x1 = next_cell(x, w.width);
  const std::uint32_t y1 = next_cell(y, w.height);
  if (w.corner_colored == 0)
    return {horizontal_color(w, x, y), vertical_color(w, x1, y), horizontal_color(w, x, y1),
            vertical_color(w, x, y)};
  if (w.kind == MappingKind::even && even_block_of(x, y) == even_block_of(x1, y1)) { // one hash for all four
    const std::uint32_t word = even_word(w.horizontal_keys, x, y);
    const auto color = [&](std::uint32_t i, std::uint32_t j) {
      return even_color(word, w.table, i, j, w.horizontal_colors);
    };
    return {color(x, y), color(x1, y), color(x, y1), color(x1, y1)};
  }
  return {corner_color(w, x, y), corner_color(w, x1, y), corner_color(w, x, y1), corner_color(w, x1, y1)};
}

/// The variant of a cell within the texture, 0..V-1: which of the tiles with its colors lies there. Not for index.
inline std::uint32_t variant_of_cell(const LatticeWords& w, LatticeCell cell) {
  const auto [x, y] = cell;
  if (w.variants == 1) return 0;
  if (w.kind == MappingKind::even)
    return even_variant(even_word(w.horizontal_keys, x, y), w.variant_pattern, x, y);
  if (w.kind == MappingKind::mix) return mix_color(w.variant_keys, x, y, w.variants);
  return permuted(w, permuted(w, permuted(w, x) + y) + x) %
         w.variants; // what H and C are taken from, and x again
}

/// The id, in the complete set of its colors, of the first tile with these: they are its digits, bases Kh and Kv
/// in turn. At most 8^4 - 1.
inline std::uint32_t id_in_complete_set(const LatticeWords& w, const CellColors& colors) {
  const std::uint32_t kh = w.horizontal_colors, kv = w.vertical_colors;
  return ((colors.a * kv + colors.b) * kh + colors.c) * kv + colors.d;
}

/// How many tiles a variant has: (Kh · Kv)², K⁴ of corners.
inline std::uint32_t tiles_of_variant(const LatticeWords& w) {
  const std::uint32_t pairs = w.horizontal_colors * w.vertical_colors;
  return pairs * pairs;
}

/// The id of the tile in a cell within the texture; hashed mappings are for complete sets, whose variants stand one
/// after the other.
inline std::uint32_t tile_of_cell(const LatticeWords& w, LatticeCell cell) {
  if (w.kind == MappingKind::index) // a size_t: 2^26 cells at most are stored, but any may be asked for here
    return static_cast<std::uint32_t>(w.ids[static_cast<std::size_t>(cell.y) * w.width + cell.x]);
  const std::uint32_t id = id_in_complete_set(w, colors_of_cell(w, cell));
  return w.variants == 1 ? id : id + variant_of_cell(w, cell) * tiles_of_variant(w);
}

} // namespace tilepack
