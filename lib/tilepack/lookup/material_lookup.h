#pragma once

#include "tilepack/mapping/lattice_words.h"
#include "tilepack/mapping/mix_hash.h"

#include <cstdint>

namespace tilepack {

struct Pack;

/// How the tiles of a transition (Pack::materials) are looked up where the materials at lattice points are given from
/// outside, by a map of materials, in place of the pack's own mapping. A value of a few words, for loops over texels.
///
///   const MaterialLookup lookup = material_lookup(pack);
///   const auto corner = [&](std::uint32_t x, std::uint32_t y) { return color_of_material(lookup, map(x, y), {x, y}); };
///   const CellColors corners{corner(x, y), corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)};   // nw, ne, sw, se
///   const std::uint32_t tile = tile_of_corners(lookup, corners, {x, y});
///   const TexturePlace place = place_of_tile(words, tile);                                  // PackLookup
///
/// Any map of materials tiles without seams: what neighbours share are the materials at the two ends of their edge, and what
/// tiles show along an edge follows from these alone.
struct MaterialLookup {
  std::uint32_t materials = 0; ///< 1..4; of a pack that names none, its corner colors
  std::uint32_t colors_of_material =
      1;                      ///< corner colors of each: material m has m * this and those that follow
  std::uint32_t variants = 1; ///< 1..8
  MixKeys corner_keys;
  MixKeys variant_keys;

  std::uint32_t colors() const { return materials * colors_of_material; }
};

/// `pack` has corner colors and a complete set (Error, invalid_content); its mapping does not count.
MaterialLookup material_lookup(const Pack& pack);

/// The corner color of a lattice point at which a material (0 to materials - 1) is shown: by the mixing hash of (x, y), 0 <= x,
/// y <= 2^31 - 1, where there are several.
inline std::uint32_t color_of_material(const MaterialLookup& lookup, std::uint32_t material,
                                       LatticeCell point) {
  if (lookup.colors_of_material == 1) return material;
  return material * lookup.colors_of_material +
         mix_color(lookup.corner_keys, point.x, point.y, lookup.colors_of_material);
}

/// The variant that lies in a cell, 0 to variants - 1, by the mixing hash of (x, y), with other keys.
inline std::uint32_t variant_of_materials(const MaterialLookup& lookup, LatticeCell cell) {
  return lookup.variants == 1 ? 0 : mix_color(lookup.variant_keys, cell.x, cell.y, lookup.variants);
}

/// The id of the tile in a cell whose corners have these colors, each below lookup.colors().
inline std::uint32_t tile_of_corners(const MaterialLookup& lookup, const CellColors& corners,
                                     LatticeCell cell) {
  const std::uint32_t k = lookup.colors();
  const std::uint32_t id = ((corners.a * k + corners.b) * k + corners.c) * k + corners.d;
  return id + variant_of_materials(lookup, cell) * k * k * k * k;
}

} // namespace tilepack
