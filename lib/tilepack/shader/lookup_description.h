#pragma once

#include "tilepack/lookup/pack_lookup.h"
#include "tilepack/sampler/address.h"
#include "tilepack/shader/lookup_program.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tilepack {

/// What a program holds beside the functions that every one has, `tile` and `place`.
struct LookupFeatures {
  WrapMode border = WrapMode::wrap;
  bool levels = true;    ///< lookups at a level: `texel`, `nearest`, `level`, `exact`
  bool gradients = true; ///< lookups by derivatives: `grad`, `exact_grad`
};

/// The most words of a table that a program holds: 16 KiB, what constants of every language can be.
inline constexpr std::size_t most_table_words = 4096;

/// The one description of a pack's lookup, from which all languages are written:
///
///   tile(cell_x, cell_y)             the id of the tile in a cell, any of 32 bits
///   place(cell_x, cell_y)            where it lies: column in bits 0..15, row or layer in bits 16..31
///   texel(x, y, i, j, level)         texel (i, j) of the tile in cell (x, y), both within the virtual texture
///   nearest(cell, fraction, level)   the texel that holds a place, at a whole level
///   level(cell, fraction, level)     one fetch, filtered, at a level
///   exact(cell, fraction, level)     trilinear, each tap from the tile that it lies in   [Wei04, section 4.3]
///   grad(cell, fraction, derivatives), exact_grad(...)   the same where derivatives choose the level
///
/// A place is a whole tile and the fraction within it, 0 <= fraction < 1; derivatives are in tiles a pixel. At whole
/// levels values are those of the reference sampler; between two, `level` and `grad` take the width of the blend
/// with a corner pack (two fetches near corners) and of the last half texel before a border that doesn't wrap from
/// between theirs. A mirrored place exactly on a border counts to the tile before. Rotated layouts have no exact
/// lookups, for their tiles have no rows of texels.
///
/// Error (invalid_content) for what no language could hold, saying what to bake instead: tables beyond most_table_words.
LookupProgram describe_lookup(const PackLookup& lookup, const LookupFeatures& features);

/// The first part of it: everything up to `place_of(x, y)`, which takes a cell within the virtual texture.
void describe_lattice(LookupProgram& program, const PackLookup& lookup, WrapMode border);

/// Of a corner pack: corner_place(x, y, fraction_x, fraction_y), the cell of it that stands for cell (x, y).
void describe_corner_place(LookupProgram& program, const PackLookup& lookup);

/// tile_index(a, b): TileIndex1D, unless the program has it.
void describe_tile_index(LookupProgram& program);

/// The cell after and before one, round the border.
Expression next_cell(const Expression& i, std::uint32_t side);
Expression previous_cell(const Expression& i, std::uint32_t side);

/// A table with entries of 1, 2, 4, 8 or 16 bits.
struct PackedTable {
  std::string name;
  std::uint32_t bits = 8;
};

/// Bits of an entry that holds 0 to `largest`: 1, 2, 4, 8 or 16.
std::uint32_t bits_for(std::uint32_t largest);

/// Adds `entries`, at least one and each below 65536. Error (invalid_content) for more words than
/// most_table_words; `instead` says what to bake.
PackedTable add_table(LookupProgram& program, const std::string& name, const std::string& comment,
                      const std::vector<std::uint32_t>& entries, const std::string& instead);
Expression entry_of(const PackedTable& table, Expression index);

} // namespace tilepack
