#pragma once

#include "tilepack/mapping/lattice_words.h"
#include "tilepack/tileset/tile_colors.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace tilepack {

/// The virtual texture's size in tiles, each side 1..2^31. It wraps.
struct VirtualSize {
  std::int64_t width = 0;
  std::int64_t height = 0;
  bool operator==(const VirtualSize&) const = default;
};

/// Which tile lies in which cell of the virtual texture, found in constant time: each edge (or corner) of the
/// lattice gets its color from a hash of its place, so that neighbours agree without knowing each other.
///
///   permutation  with P a permutation of 0..n-1, first x mod width and y mod height, then indices mod n:
///                horizontal edges  H(x, y) = P[P[x] + y] mod Kh
///                vertical edges    V(x, y) = P[x + P[2y]] mod Kv              [Wei04, Eq. 2]
///                corners           C(x, y) = P[P[x] + y] mod K
///                H(x, y) is the edge on top of cell (x, y), V(x, y) the one on its left, C(x, y) its
///                north-west corner.
///   mix          the same lattice from a keyed integer hash, mapping/mix_hash.h: no table, no period
///   even         corners only: a pattern without near repeats, placed by the hash, mapping/even_pattern.h
///   index        a stored image of tile ids, one a cell
///
/// Where each combination of colors has V > 1 variants, a cell's own hash picks one, 0..V-1:
///   permutation  W(x, y) = P[P[P[x] + y] + x] mod V
///   mix          the hash with keys of its own
///   even         a second pattern, of cells, which lays equal tiles far apart: mapping/even_variants.h
struct Mapping {
  MappingKind kind = MappingKind::permutation;
  VirtualSize size;
  std::vector<int> table;         ///< permutation: a permutation of 0..n-1; even: the pattern, 64 * 64 colors
  std::uint64_t seed = 0;         ///< mix, even
  std::vector<int> ids;           ///< index: size.width * size.height tile ids, row by row
  std::vector<int> variants = {}; ///< even with variants: 64 * 64 of them; else empty
};

/// 0..length-1 in an order shuffled by `seed`; length >= 1.
std::vector<int> permutation_table(int length, std::uint64_t seed);

/// A permutation mapping whose table is shuffled by `seed`. The table length n is the smallest multiple of
/// the number of colors of each kind, and of variants, that is at least 2 * max(width, height): longer tables
/// repeat no row within the texture, and `mod K` is then unbiased. Sides 1..4096: beyond, the table would be larger than a
/// mix is slow (Error, usage).
Mapping permutation_mapping(VirtualSize size, const ColorCounts& colors, std::uint64_t seed);

Mapping mix_mapping(VirtualSize size, std::uint64_t seed);

/// `corners`: 2..4 colors (Error, usage); `variants`: 1..8.
Mapping even_mapping(VirtualSize size, int corners, std::uint64_t seed, int variants = 1);

/// `mapping` written out cell by cell; at most 2^26 cells (Error, usage).
Mapping index_mapping(const Mapping& mapping, const ColorCounts& colors);

/// The mapping as words, for lookups by lattice_words.h; `mapping` must outlive them.
LatticeWords lattice_words(const Mapping& mapping, const ColorCounts& colors);

/// The cell of the virtual texture at (x, y), any integers: the texture wraps.
LatticeCell cell_at(const LatticeWords& words, std::int64_t x, std::int64_t y);

/// Colors of the tile at cell (x, y), any integers: the texture wraps. Not for index mappings. Whoever asks
/// for many draws the words once.
EdgeTile edge_tile_at(const Mapping& mapping, const ColorCounts& colors, std::int64_t x, std::int64_t y);
CornerTile corner_tile_at(const Mapping& mapping, const ColorCounts& colors, std::int64_t x, std::int64_t y);

/// The id of the tile at cell (x, y), any integers, for a complete set or an index map.
int tile_at(const Mapping& mapping, const ColorCounts& colors, std::int64_t x, std::int64_t y);

} // namespace tilepack
