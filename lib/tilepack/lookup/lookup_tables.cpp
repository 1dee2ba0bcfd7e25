#include "tilepack/lookup/lookup_tables.h"

#include "tilepack/error/error.h"
#include "tilepack/mip/far_levels.h"

#include <fmt/format.h>

#include <variant>

namespace tilepack {
namespace {

std::uint32_t packed(int a, int b, int c, int d) {
  const auto word = [](int color) { return static_cast<std::uint32_t>(color); };
  return word(a) | word(b) << 8 | word(c) << 16 | word(d) << 24;
}

std::uint32_t packed(const EdgeTile& tile) {
  return packed(tile.north, tile.east, tile.south, tile.west);
}

std::uint32_t packed(const CornerTile& tile) {
  return packed(tile.nw, tile.ne, tile.sw, tile.se);
}

void check(const Pack& pack, const Mapping& mapping) {
  constexpr std::int64_t longest_side = std::int64_t{1} << 31;
  constexpr int most_cells = 65536;
  const VirtualSize size = mapping.size;
  if (size.width < 1 || size.height < 1 || size.width > longest_side || size.height > longest_side)
    throw Error(ErrorKind::invalid_content, "mapping",
                fmt::format("{} x {} tiles; each side is 1 to 2^31", size.width, size.height));
  if (pack.layout.columns > most_cells || pack.layout.rows > most_cells)
    throw Error(ErrorKind::invalid_content, "layout",
                fmt::format("{} columns and {} rows; at most {} each", pack.layout.columns, pack.layout.rows,
                            most_cells));
}

} // namespace

LookupTables::LookupTables(const Pack& pack) : LookupTables(pack, pack.mapping) {}

LookupTables::LookupTables(const Pack& pack, const Mapping& mapping) {
  check(pack, mapping);
  places.resize(pack.layout.cells.size());
  for (const Cell& cell : pack.layout.cells)
    places[static_cast<std::size_t>(cell.tile)] =
        static_cast<std::uint32_t>(cell.column) | static_cast<std::uint32_t>(cell.row) << 16;
  std::visit(
      [&](const auto& tiles) {
        for (const auto& tile : tiles) colors.push_back(packed(tile));
      },
      pack.tiles);
  lookup.lattice = lattice_words(mapping, pack.colors);
  lookup.layout = layout_words(pack.layout, pack.tile_size);
  lookup.layout_kind = pack.layout.kind;
  lookup.levels = static_cast<std::uint32_t>(pack.tile_levels);
  lookup.chain_levels = lookup.levels;
  if (pack.full_chain)
    lookup.chain_levels +=
        static_cast<std::uint32_t>(far_level_sizes(pack.layout, pack.tile_size, pack.tile_levels).size());
  lookup.tiles = static_cast<std::uint32_t>(places.size());
  lookup.places = places.data();
  lookup.colors = colors.data();
  if (!pack.corner_pack) return;
  lookup.corner_columns = static_cast<std::uint32_t>(pack.corner_pack->columns);
  lookup.corner_rows = static_cast<std::uint32_t>(pack.corner_pack->rows);
  lookup.corner_width = static_cast<float>(pack.corner_pack->width);
}

} // namespace tilepack
