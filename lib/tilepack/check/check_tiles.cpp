#include "tilepack/check/structure_checks.h"
#include "tilepack/check/tile_border.h"
#include "tilepack/layout/rotated_lattice.h"
#include "tilepack/layout/surroundings.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/numeric/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace tilepack {
namespace {

// The colors of a tile in the order of its complete set's ids, each with the number of colors of its kind.
struct Digit {
  std::string_view name;
  int value;
  int count;
};

std::array<Digit, 4> digits(const Pack& pack, int tile) {
  const ColorCounts& k = pack.colors;
  if (const auto* edges = std::get_if<std::vector<EdgeTile>>(&pack.tiles)) {
    const EdgeTile& t = (*edges)[tile];
    return {{{"north", t.north, k.horizontal},
             {"east", t.east, k.vertical},
             {"south", t.south, k.horizontal},
             {"west", t.west, k.vertical}}};
  }
  const CornerTile& t = std::get<std::vector<CornerTile>>(pack.tiles)[tile];
  return {{{"nw", t.nw, k.corner}, {"ne", t.ne, k.corner}, {"sw", t.sw, k.corner}, {"se", t.se, k.corner}}};
}

bool in_range(const std::array<Digit, 4>& colors) {
  return std::all_of(colors.begin(), colors.end(),
                     [](const Digit& d) { return d.value >= 0 && d.value < d.count; });
}

int complete_id(const std::array<Digit, 4>& colors) {
  int id = 0;
  for (const Digit& digit : colors) id = id * digit.count + digit.value;
  return id;
}

std::string combination(const Pack& pack, int id) {
  const int tiles = tile_count(pack.tiles);
  if (tiles == 0) return std::to_string(id);
  const int variant = id / combinations(pack.colors);
  std::array<Digit, 4> colors = digits(pack, 0);
  for (int i = 3; i >= 0; --i) {
    colors[i].value = id % colors[i].count;
    id /= colors[i].count;
  }
  return fmt::format("{} {}, {} {}, {} {}, {} {}{}", colors[0].name, colors[0].value, colors[1].name,
                     colors[1].value, colors[2].name, colors[2].value, colors[3].name, colors[3].value,
                     pack.colors.variants > 1 ? fmt::format(", variant {}", variant) : "");
}

bool placed_in_grid(const Layout& layout, const Cell& cell) {
  return cell.column >= 0 && cell.column < layout.columns && cell.row >= 0 && cell.row < layout.rows;
}

// Tile of each grid cell, row by row; -1 where there is none.
Grid<int> grid_of(const Pack& pack) {
  const Layout& layout = pack.layout;
  if (layout.columns <= 0 || layout.rows <= 0) return {};
  Grid<int> grid(layout.columns, layout.rows, -1);
  for (const Cell& cell : layout.cells)
    if (placed_in_grid(layout, cell) && cell.tile >= 0 && cell.tile < tile_count(pack.tiles))
      grid.at(cell.column, cell.row) = cell.tile;
  return grid;
}

void check_cells(const Pack& pack, std::vector<Issue>& issues) {
  const Layout& layout = pack.layout;
  const int tiles = tile_count(pack.tiles);
  std::vector<int> times(static_cast<std::size_t>(tiles), 0);
  std::map<std::pair<int, int>, int> taken;
  for (const Cell& cell : layout.cells) {
    const std::string where = fmt::format("layout, cell at column {}, row {}", cell.column, cell.row);
    if (cell.tile < 0 || cell.tile >= tiles) {
      issues.push_back({Rule::tile_not_placed, where, fmt::format("tile {}", cell.tile),
                        fmt::format("a tile of 0 to {}", tiles - 1)});
      continue;
    }
    ++times[cell.tile];
    if (!placed_in_grid(layout, cell)) {
      issues.push_back({Rule::cell_outside, where, fmt::format("tile {}", cell.tile),
                        fmt::format("columns 0 to {}, rows 0 to {}", layout.columns - 1, layout.rows - 1)});
      continue;
    }
    const auto [other, free] = taken.try_emplace({cell.row, cell.column}, cell.tile);
    if (!free)
      issues.push_back({Rule::cell_taken_twice, where,
                        fmt::format("tiles {} and {}", other->second, cell.tile), "one tile a cell"});
  }
  for (int tile = 0; tile < tiles; ++tile)
    if (times[tile] != 1)
      issues.push_back({Rule::tile_not_placed, fmt::format("layout, tile {}", tile),
                        fmt::format("placed {} times", times[tile]), "placed once"});
}

void check_neighbours(const Pack& pack, std::vector<Issue>& issues) {
  const Layout& layout = pack.layout;
  const Grid<int> grid = grid_of(pack);
  const auto at = [&](int column, int row) { return grid.at(column % layout.columns, row % layout.rows); };
  const auto compare = [&](int tile, Side side, int neighbour, Side facing, int column, int row) {
    if (neighbour < 0 || border_key(pack.tiles, tile, side) == border_key(pack.tiles, neighbour, facing))
      return;
    issues.push_back(
        {Rule::border_colors,
         fmt::format("layout, cell at column {}, row {} and its {} neighbour", column, row, name_of(side)),
         fmt::format("tile {} {} beside tile {} {}", tile, border_text(pack.tiles, tile, side), neighbour,
                     border_text(pack.tiles, neighbour, facing)),
         "the same color on both sides"});
  };
  for (int row = 0; row < layout.rows; ++row)
    for (int column = 0; column < layout.columns; ++column) {
      const int tile = at(column, row);
      if (tile < 0) {
        issues.push_back({Rule::cell_empty, fmt::format("layout, cell at column {}, row {}", column, row),
                          "no tile", "one tile"});
        continue;
      }
      compare(tile, Side::east, at(column + 1, row), Side::west, column, row);
      compare(tile, Side::south, at(column, row + 1), Side::north, column, row);
    }
}

// Without gutters a filter reads on into the neighbours of a turned tile, and with them it may where the pack
// says that neighbours match.
void check_turned_neighbours(const Pack& pack, std::vector<Issue>& issues) {
  const bool promised = pack.layout.rotated.matching == Matching::found;
  if (pack.layout.rotated.gutter > 0 && !promised) return;
  const RotatedLattice lattice(pack.layout.rotated.scheme);
  for (const Cell& cell : pack.layout.cells)
    if (lattice.site_with(cell.column, cell.row) < 0) {
      issues.push_back({Rule::cell_outside, fmt::format("layout, tile {}", cell.tile),
                        fmt::format("column {}, row {}", cell.column, cell.row),
                        fmt::format("a place of the scheme {}", formula(pack.layout.rotated.scheme))});
      return;
    }
  if (lattice.sites() != static_cast<int>(pack.layout.cells.size())) return;
  const std::vector<Surroundings> around = packed_surroundings(pack.layout);
  const auto compare = [&](int tile, Side side, int neighbour, Side facing) {
    if (border_key(pack.tiles, tile, side) == border_key(pack.tiles, neighbour, facing)) return;
    issues.push_back({Rule::border_colors,
                      fmt::format("layout, tile {} and its {} neighbour", tile, name_of(side)),
                      fmt::format("tile {} {} beside tile {} {}", tile, border_text(pack.tiles, tile, side),
                                  neighbour, border_text(pack.tiles, neighbour, facing)),
                      promised ? "the same color on both sides, as layout.matching says"
                               : "the same color on both sides, or a gutter"});
  };
  for (int tile = 0; tile < static_cast<int>(around.size()); ++tile) {
    compare(tile, Side::east, around[static_cast<std::size_t>(tile)].e, Side::west);
    compare(tile, Side::south, around[static_cast<std::size_t>(tile)].s, Side::north);
  }
}

// [Wei04, Eq. 7]: a sampler may compute the cell from the colors and never look at the layout's list.
void check_formula(const Pack& pack, std::vector<Issue>& issues) {
  const auto* edges = std::get_if<std::vector<EdgeTile>>(&pack.tiles);
  if (pack.layout.kind != LayoutKind::tile_index || !edges) return;
  for (const Cell& cell : pack.layout.cells) {
    if (cell.tile < 0 || cell.tile >= tile_count(pack.tiles) || !in_range(digits(pack, cell.tile))) continue;
    const EdgeTile& tile = (*edges)[cell.tile];
    const int column = tile_index_1d(tile.west, tile.east);
    const int variant = cell.tile / combinations(pack.colors);
    const int row =
        tile_index_1d(tile.north, tile.south) + variant * pack.colors.horizontal * pack.colors.horizontal;
    if (cell.column != column || cell.row != row)
      issues.push_back({Rule::cell_formula, fmt::format("layout, tile {}", cell.tile),
                        fmt::format("column {}, row {}", cell.column, cell.row),
                        fmt::format("column {}, row {}", column, row)});
  }
}

} // namespace

std::vector<Issue> check_tiles(const Pack& pack) {
  std::vector<Issue> issues;
  const bool hashed = pack.mapping.kind != MappingKind::index;
  std::map<int, int> first_with; // complete id → tile
  for (int tile = 0; tile < tile_count(pack.tiles); ++tile) {
    const auto colors = digits(pack, tile);
    for (const Digit& digit : colors)
      if (digit.value < 0 || digit.value >= digit.count)
        issues.push_back({Rule::color_range, fmt::format("tile {}, {}", tile, digit.name),
                          fmt::format("color {}", digit.value), fmt::format("0 to {}", digit.count - 1)});
    if (!hashed || !in_range(colors)) continue;
    const int variant = std::min(tile / combinations(pack.colors), pack.colors.variants - 1);
    const int id = complete_id(colors) + variant * combinations(pack.colors);
    const auto [other, fresh] = first_with.try_emplace(id, tile);
    if (!fresh)
      issues.push_back({Rule::tile_repeated, fmt::format("tiles {} and {}", other->second, tile),
                        combination(pack, id), "each combination once in each variant"});
    else if (id != tile)
      issues.push_back({Rule::tile_order, fmt::format("tile {}", tile),
                        fmt::format("the colors of number {}", id),
                        fmt::format("{}", combination(pack, tile))});
  }
  if (!hashed) return issues;

  const long long wanted = 1LL * combinations(pack.colors) * pack.colors.variants;
  const long long lacking = wanted - static_cast<long long>(first_with.size());
  if (lacking > 0) {
    int id = 0;
    while (first_with.contains(id)) ++id;
    issues.push_back({Rule::set_incomplete, "tiles",
                      fmt::format("{} of {} combinations have no tile; the first is {}", lacking, wanted,
                                  combination(pack, id)),
                      fmt::format("{} tiles", wanted)});
  }
  return issues;
}

std::vector<Issue> check_layout(const Pack& pack) {
  std::vector<Issue> issues;
  check_cells(pack, issues);
  if (pack.layout.kind == LayoutKind::tile_index || pack.layout.kind == LayoutKind::de_bruijn)
    check_neighbours(pack, issues);
  if (pack.layout.kind == LayoutKind::rotated && issues.empty()) check_turned_neighbours(pack, issues);
  check_formula(pack, issues);
  return issues;
}

} // namespace tilepack
