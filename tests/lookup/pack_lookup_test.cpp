#include "tilepack/error/error.h"
#include "tilepack/layout/array_layout.h"
#include "tilepack/layout/corner_grid.h"
#include "tilepack/layout/de_bruijn.h"
#include "tilepack/layout/rotated_layout.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/lookup/lookup_tables.h"
#include "tilepack/numeric/random.h"
#include "tilepack/numeric/wrap.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

using namespace tilepack;

namespace {

constexpr std::int64_t far = std::int64_t{1} << 31;

// Lattice colors as mapping.h and the pages on the format define them, in 64-bit and signed arithmetic: another
// way to the same values as the words'.
struct Plain {
  Mapping mapping;
  ColorCounts colors;

  std::int64_t permuted(std::int64_t i) const {
    return mapping.table[static_cast<std::size_t>(i % static_cast<std::int64_t>(mapping.table.size()))];
  }

  std::int64_t hashed(std::int64_t axis, std::int64_t x, std::int64_t y) const {
    const std::uint64_t start =
        mixed(mapping.seed) + (2 * static_cast<std::uint64_t>(axis) + 1) * 0x9e3779b97f4a7c15u;
    const std::array<std::uint64_t, 2> drawn{mixed(start), mixed(start + 0x9e3779b97f4a7c15u)};
    const std::array<std::uint64_t, 4> odd{0x85ebca6b, 0xc2b2ae35, 0x9e3779b1, 0x27d4eb2f};
    constexpr std::uint64_t two_32 = std::uint64_t{1} << 32;
    std::array<std::uint64_t, 2> state{static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y)};
    for (std::size_t round = 0; round < 4; ++round) {
      const std::uint64_t key = round % 2 == 0 ? drawn[round / 2] % two_32 : drawn[round / 2] / two_32;
      const std::uint64_t v = (state[round % 2] + key) % two_32 * odd[round] % two_32;
      state[1 - round % 2] ^= v ^ v / 32768;
    }
    return static_cast<std::int64_t>(state[0]);
  }

  std::int64_t color(char family, std::int64_t at_x, std::int64_t at_y) const {
    const std::int64_t x = wrapped(at_x, mapping.size.width), y = wrapped(at_y, mapping.size.height);
    const int count = family == 'H' ? colors.horizontal : family == 'V' ? colors.vertical : colors.corner;
    const std::int64_t axis = family == 'H' ? 0 : family == 'V' ? 1 : 2;
    switch (mapping.kind) {
    case MappingKind::permutation:
      return (family == 'V' ? permuted(x + permuted(2 * y)) : permuted(permuted(x) + y)) % count;
    case MappingKind::mix:
      return hashed(axis, x, y) / 65536 * count / 65536;
    case MappingKind::even: {
      const std::int64_t word = hashed(axis, x / 64, y / 64);
      std::int64_t u = (x + word) % 64, v = (y + word / 64) % 64;
      if (word / 4096 % 2 == 1) u = 63 - u;
      if (word / 8192 % 2 == 1) v = 63 - v;
      if (word / 16384 % 2 == 1) std::swap(u, v);
      return (mapping.table[static_cast<std::size_t>(v * 64 + u)] + word / 65536 * count / 65536) % count;
    }
    case MappingKind::index:
      break;
    }
    return -1;
  }

  std::int64_t variant(std::int64_t at_x, std::int64_t at_y) const {
    const std::int64_t x = wrapped(at_x, mapping.size.width), y = wrapped(at_y, mapping.size.height);
    switch (mapping.kind) {
    case MappingKind::permutation:
      return permuted(permuted(permuted(x) + y) + x) % colors.variants;
    case MappingKind::mix:
      return hashed(3, x, y) / 65536 * colors.variants / 65536;
    case MappingKind::even: {
      if (colors.variants == 1) return 0;
      const std::int64_t word = hashed(2, x / 64, y / 64);
      std::int64_t u = (x + word) % 64, v = (y + word / 64) % 64;
      if (word / 4096 % 2 == 1) u = (126 - u) % 64;
      if (word / 8192 % 2 == 1) v = (126 - v) % 64;
      if (word / 16384 % 2 == 1) std::swap(u, v);
      return mapping.variants[static_cast<std::size_t>(v * 64 + u)];
    }
    case MappingKind::index:
      break;
    }
    return -1;
  }

  std::array<std::int64_t, 4> of_cell(std::int64_t x, std::int64_t y) const {
    if (colors.corner > 0)
      return {color('C', x, y), color('C', x + 1, y), color('C', x, y + 1), color('C', x + 1, y + 1)};
    return {color('H', x, y), color('V', x + 1, y), color('H', x, y + 1), color('V', x, y)};
  }
};

// A pack without texels.
Pack bare_pack(const Mapping& mapping, const ColorCounts& colors, LayoutKind kind, Size tile = {16, 8}) {
  Pack pack;
  pack.tile_size = tile;
  pack.colors = colors;
  pack.tiles = complete_set(colors);
  const int tiles = tile_count(pack.tiles);
  switch (kind) {
  case LayoutKind::tile_index:
    pack.layout = tile_index_layout(std::get<std::vector<EdgeTile>>(pack.tiles));
    break;
  case LayoutKind::de_bruijn:
    pack.layout = de_bruijn_layout(std::get<std::vector<CornerTile>>(pack.tiles));
    break;
  case LayoutKind::array:
    pack.layout = array_layout(tiles, tile, 4);
    break;
  case LayoutKind::rotated: {
    std::vector<int> arrangement(static_cast<std::size_t>(tiles));
    std::iota(arrangement.rbegin(), arrangement.rend(), 0);
    pack.layout = rotated_layout(rotated_schemes(tiles).back(), {tile.width, 2, false}, arrangement);
    break;
  }
  }
  pack.mapping = mapping;
  pack.tile_levels = 4;
  return pack;
}

// Coordinates in 32 bits: every one within a window of each of these, and strewn ones.
template <typename Check>
void each_cell(int strewn, Check&& check) {
  constexpr std::array<std::int64_t, 6> starts{-far, -70, -3, 60, far / 2 - 20, far - 36};
  for (const std::int64_t oy : starts)
    for (const std::int64_t ox : starts)
      for (std::int64_t y = oy; y < oy + 36; ++y)
        for (std::int64_t x = ox; x < ox + 36; ++x) check(x, y);
  for (int i = 0; i < strewn; ++i) {
    const std::uint64_t bits = random_bits(1, "cell", static_cast<std::uint64_t>(i));
    check(static_cast<std::int32_t>(bits), static_cast<std::int32_t>(bits >> 32));
  }
}

LatticeCell wrapped_in(const PackLookup& lookup, std::int64_t x, std::int64_t y) {
  return {wrapped_cell(static_cast<std::int32_t>(x), lookup.lattice.width),
          wrapped_cell(static_cast<std::int32_t>(y), lookup.lattice.height)};
}

// Every step of the lookup for over a million cells of all mappings handed in.
void check_cells(const Mapping& mapping, const ColorCounts& colors, LayoutKind kind) {
  const Pack pack = bare_pack(mapping, colors, kind);
  const Plain plain{mapping, colors};
  const LookupTables tables(pack);
  const PackLookup& lookup = tables.words();
  std::int64_t faults = 0;
  each_cell(60000, [&](std::int64_t x, std::int64_t y) {
    const LatticeCell cell = wrapped_in(lookup, x, y);
    const auto expected = plain.of_cell(x, y);
    const CellColors found = colors_of_cell(lookup, cell);
    const int kh = colors.corner > 0 ? colors.corner : colors.horizontal;
    const int kv = colors.corner > 0 ? colors.corner : colors.vertical;
    const auto id = ((expected[0] * kv + expected[1]) * kh + expected[2]) * kv + expected[3] +
                    plain.variant(x, y) * combinations(colors);
    const Cell& at = pack.layout.cells[static_cast<std::size_t>(id)];
    const TexturePlace place = place_of_cell(lookup, cell);
    const bool good = found.a == expected[0] && found.b == expected[1] && found.c == expected[2] &&
                      found.d == expected[3] && colors_of_tile(lookup, tile_of_cell(lookup, cell)) == found &&
                      tile_of_cell(lookup, cell) == id && id == tile_at(mapping, colors, x, y) &&
                      static_cast<int>(place.column) == at.column && static_cast<int>(place.row) == at.row &&
                      unpacked_place(packed_place_of_cell(lookup, cell.x, cell.y)) == place;
    faults += good ? 0 : 1;
  });
  CHECK(faults == 0);
}

} // namespace

TEST_CASE("cells of 32-bit coordinates wrap as 64-bit ones do") {
  for (const std::int64_t side : {std::int64_t{1}, std::int64_t{2}, std::int64_t{7}, std::int64_t{64},
                                  std::int64_t{1000003}, far - 1, far})
    for (const std::int64_t i : {-far, -far + 1, -side, -side - 1, std::int64_t{-65}, std::int64_t{-1},
                                 std::int64_t{0}, std::int64_t{1}, side - 1, std::int64_t{63}, far - 1})
      if (i >= -far && i < far)
        CHECK(wrapped_cell(static_cast<std::int32_t>(i), static_cast<std::uint32_t>(side)) ==
              wrapped(i, side));
}

TEST_CASE("every mapping leads from a cell to the colors, the tile and the place that its definition says") {
  const ColorCounts edges{3, 2, 0};
  check_cells(mix_mapping({far, far}, 9), edges, LayoutKind::tile_index);
  check_cells(mix_mapping({1000, 7}, (std::uint64_t{1} << 53) - 1), edges, LayoutKind::array);
  check_cells(mix_mapping({far - 1, 1}, 5), {0, 0, 4}, LayoutKind::de_bruijn);
  check_cells(permutation_mapping({256, 100}, edges, 3), edges, LayoutKind::tile_index);
  check_cells(permutation_mapping({5, 3}, {0, 0, 3}, 3), {0, 0, 3}, LayoutKind::de_bruijn);
  for (const int k : {2, 3, 4})
    check_cells(even_mapping({1000, far}, k, 11), {0, 0, k}, LayoutKind::de_bruijn);
  check_cells(even_mapping({40, 65}, 2, 12), {0, 0, 2}, LayoutKind::rotated);

  const ColorCounts three_variants{3, 2, 0, 3};
  check_cells(mix_mapping({far, 1000}, 9), three_variants, LayoutKind::tile_index);
  check_cells(permutation_mapping({256, 100}, three_variants, 3), three_variants, LayoutKind::tile_index);
  for (const int k : {2, 3, 4})
    check_cells(even_mapping({far, 1000}, k, 11, 5), {0, 0, k, 5}, LayoutKind::de_bruijn);

  Mapping far_permutation; // no bake makes one so large, but a pack may hold it
  far_permutation.size = {far, far - 1};
  far_permutation.table = permutation_table(11, 3);
  check_cells(far_permutation, edges, LayoutKind::tile_index);
}

TEST_CASE("an index map gives its tiles, and their colors") {
  const ColorCounts colors{2, 3, 0};
  const Mapping index = index_mapping(mix_mapping({70, 33}, 4), colors);
  const Pack pack = bare_pack(index, colors, LayoutKind::tile_index);
  const LookupTables tables(pack);
  const auto& tiles = std::get<std::vector<EdgeTile>>(pack.tiles);
  each_cell(20000, [&](std::int64_t x, std::int64_t y) {
    const LatticeCell cell = wrapped_in(tables.words(), x, y);
    const std::int64_t stored = wrapped(y, std::int64_t{33}) * 70 + wrapped(x, std::int64_t{70});
    const int id = index.ids[static_cast<std::size_t>(stored)];
    if (tile_of_cell(tables.words(), cell) != static_cast<std::uint32_t>(id))
      FAIL("tile at " << x << ',' << y);
    const EdgeTile& tile = tiles[static_cast<std::size_t>(id)];
    const CellColors found = colors_of_cell(tables.words(), cell);
    if (found != CellColors{static_cast<std::uint32_t>(tile.north), static_cast<std::uint32_t>(tile.east),
                            static_cast<std::uint32_t>(tile.south), static_cast<std::uint32_t>(tile.west)})
      FAIL("colors at " << x << ',' << y);
  });
}

TEST_CASE("the corner pack's cell follows from the four edges that end in a lattice point") {
  const ColorCounts colors{3, 2, 0};
  const Mapping mix = mix_mapping({50, 41}, 4);
  for (const Mapping& mapping : {mix, permutation_mapping({50, 41}, colors, 4), index_mapping(mix, colors)}) {
    Pack pack = bare_pack(mapping, colors, LayoutKind::tile_index);
    pack.corner_pack = CornerPack{9, 4, 2.5, {}};
    const LookupTables tables(pack);
    CHECK(tables.words().corner_columns == 9);
    CHECK(tables.words().corner_rows == 4);
    CHECK(tables.words().corner_width == 2.5f);
    const auto& tiles = std::get<std::vector<EdgeTile>>(pack.tiles);
    const auto tile = [&](std::int64_t x, std::int64_t y) {
      return tiles[static_cast<std::size_t>(tile_at(mapping, colors, x, y))];
    };
    for (std::uint32_t y = 0; y < 41; ++y)
      for (std::uint32_t x = 0; x < 50; ++x) {
        const TexturePlace place = corner_place(tables.words(), {x, y});
        const CornerCell expected = corner_cell(tile(std::int64_t{x} - 1, y).north, tile(x, y).north,
                                                tile(x, std::int64_t{y} - 1).west, tile(x, y).west);
        REQUIRE(place == TexturePlace{static_cast<std::uint32_t>(expected.column),
                                      static_cast<std::uint32_t>(expected.row)});
      }
  }
}

TEST_CASE("the words of a layout give the places that the header says") {
  const Mapping mapping = mix_mapping({8, 8}, 0);
  for (const LayoutKind kind : {LayoutKind::tile_index, LayoutKind::array, LayoutKind::rotated}) {
    const Size tile{16, kind == LayoutKind::rotated ? 16 : 8};
    const Pack pack = bare_pack(mapping, {2, 2, 0}, kind, tile);
    const LookupTables tables(pack);
    const LayoutWords& w = tables.words().layout;
    for (std::uint32_t id = 0; id < tables.words().tiles; ++id)
      for (int level = 0; level < 3; ++level) {
        const TexturePlace place = place_of_tile(tables.words(), id);
        const Placement found =
            placement(w, static_cast<int>(place.column), static_cast<int>(place.row), level);
        CHECK(found.at(0.25, 0.75) ==
              placement(pack.layout, static_cast<int>(id), tile, level).at(0.25, 0.75));
        const Size texture = texture_size(w, level);
        CHECK(texture == texture_size(pack.layout, tile, level));
        for (const double x : {0.0, 0.3, 1.0})
          for (const double y : {0.0, 0.6, 1.0}) {
            double u = 0, v = 0; // texels
            if (kind == LayoutKind::rotated) {
              const double side = w.tile_width + 2.0 * w.gutter;
              const double across = (w.gutter + x * w.tile_width) / side;
              const double down = (w.gutter + y * w.tile_width) / side;
              const double m = w.n * w.n + w.k * w.k;
              u = (place.column + w.n * across - w.k * down) / (m * w.squares) * texture.width;
              v = (place.row + w.k * across + w.n * down) / m * texture.height;
            } else {
              const std::uint32_t border = w.border >> level;
              u = place.column * ((w.tile_width >> level) + 2 * border) + border +
                  x * (w.tile_width >> level);
              v = place.row * ((w.tile_height >> level) + 2 * border) + border + y * (w.tile_height >> level);
            }
            CHECK(found.at(x, y).x == Approx(u).margin(1e-9));
            CHECK(found.at(x, y).y == Approx(v).margin(1e-9));
          }
      }
  }
}

TEST_CASE("moved tables keep their words, and sizes beyond 32 bits are refused") {
  Pack pack = bare_pack(mix_mapping({8, 8}, 0), {2, 2, 0}, LayoutKind::tile_index);
  LookupTables tables(pack);
  const TexturePlace before = place_of_cell(tables.words(), {3, 5});
  const LookupTables moved = std::move(tables);
  CHECK(place_of_cell(moved.words(), {3, 5}) == before);
  pack.mapping.size.width = far + 1;
  CHECK_THROWS_AS(LookupTables(pack), Error);
}
