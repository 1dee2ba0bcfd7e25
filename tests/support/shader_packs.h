#pragma once

#include "support/framed_pack.h"

#include "tilepack/layout/rotated_scheme.h"
#include "tilepack/mapping/mapping.h"
#include "tilepack/tileset/sequential_set.h"

#include <string>
#include <utility>
#include <vector>

namespace tilepack::test {

/// A pack of random texels and what is special about it: together they have every mapping, layout and table that
/// lookups as text are written for.
struct NamedPack {
  std::string name;
  Pack pack;
};

inline std::vector<NamedPack> shader_packs() {
  std::vector<NamedPack> packs;
  const auto add = [&](const std::string& name, const TileSet& set, PackingOptions options,
                       MappingKind mapping, VirtualSize size) {
    options.mapping = mapping;
    options.virtual_size = size;
    packs.push_back({name, packed(set, options, 9)});
  };
  const Size tile{8, 8};
  const auto corners = [&](int colors) { return framed_set(complete_corner_set(colors), tile, 5); };
  const auto edges = [&](int kh, int kv) { return framed_set(complete_edge_set(kh, kv), {8, 4}, 5); };
  PackingOptions torus, grid, array, bordered, turned, guttered, with_corners;
  torus.layout = LayoutKind::de_bruijn;
  array.layout = bordered.layout = LayoutKind::array;
  bordered.array.border = 4;
  turned.layout = guttered.layout = LayoutKind::rotated;
  guttered.rotated.gutter = 2;
  with_corners.corner_pack = true;
  constexpr std::int64_t far = std::int64_t{1} << 31;
  add("even, 2 corner colors", corners(2), torus, MappingKind::even, {far, far});
  add("even, 3 corner colors", corners(3), torus, MappingKind::even, {1000, 7});
  add("even, 4 corner colors", corners(4), torus, MappingKind::even, {256, 256});
  add("mix, 2 corner colors", corners(2), torus, MappingKind::mix, {256, 256});
  add("mix, 3 x 2 edge colors", edges(3, 2), grid, MappingKind::mix, {6, 5});
  add("permutation, 3 x 2 edge colors", edges(3, 2), grid, MappingKind::permutation, {100, 77});
  add("permutation, 2 corner colors", corners(2), torus, MappingKind::permutation, {4096, 1});
  add("index, 2 edge colors", edges(2, 2), grid, MappingKind::index, {70, 33});
  add("array", edges(2, 2), array, MappingKind::mix, {far, 5});
  add("array with borders", corners(2), bordered, MappingKind::even, {6, 5});
  add("corner pack", edges(2, 2), with_corners, MappingKind::mix, {6, 5});
  add("corner pack, index", edges(2, 2), with_corners, MappingKind::index, {6, 5});
  PackingOptions torus_down = torus, array_down = array, bordered_down = bordered,
                 corners_down = with_corners;
  for (PackingOptions* options : {&torus_down, &array_down, &bordered_down, &corners_down})
    options->full_mips = true;
  add("full chain, 3 corner colors", corners(3), torus_down, MappingKind::even, {64, 64});
  add("full chain, array", edges(2, 2), array_down, MappingKind::mix, {64, 5});
  add("full chain, array with borders", corners(2), bordered_down, MappingKind::even, {6, 5});
  add("full chain, corner pack", edges(3, 2), corners_down, MappingKind::mix, {6, 5});
  for (NamedPack& named : packs) // so that blends are seen
    if (named.pack.corner_pack) named.pack.corner_pack->width = 3;
  const TileSet few = framed_set(sequential_edge_set(2, 2), tile, 5);
  const auto fill = [&](const std::string& name, const PackingOptions& options) {
    add(name, few, options, MappingKind::index, {12, 9});
  };
  fill("rotated", turned);
  fill("rotated with gutters", guttered);
  guttered.full_mips = true;
  fill("full chain, rotated", guttered);
  return packs;
}

} // namespace tilepack::test
