#include "tilepack/lookup/pack_lookup.h"

#include "tilepack/layout/corner_grid.h"

namespace tilepack {
namespace {

// The cell before coordinate `i`, round the border.
std::uint32_t previous_cell(std::uint32_t i, std::uint32_t side) {
  return (i == 0 ? side : i) - 1;
}

} // namespace

std::uint32_t packed_place_of_cell(const PackLookup& lookup, std::uint32_t x, std::uint32_t y) {
  return lookup.places[tile_of_cell(lookup, {x, y})];
}

TexturePlace corner_place(const PackLookup& lookup, LatticeCell point) {
  const LatticeWords& words = lookup.lattice;
  const LatticeCell west{previous_cell(point.x, words.width), point.y};
  const LatticeCell north{point.x, previous_cell(point.y, words.height)};
  CornerCell cell;
  const auto place = [](std::uint32_t left, std::uint32_t right, std::uint32_t up, std::uint32_t down) {
    return corner_cell(static_cast<int>(left), static_cast<int>(right), static_cast<int>(up),
                       static_cast<int>(down));
  };
  if (words.kind == MappingKind::index) {
    const CellColors here = colors_of_cell(lookup, point);
    cell = place(colors_of_cell(lookup, west).a, here.a, colors_of_cell(lookup, north).d, here.d);
  } else {
    cell = place(horizontal_color(words, west.x, west.y), horizontal_color(words, point.x, point.y),
                 vertical_color(words, north.x, north.y), vertical_color(words, point.x, point.y));
  }
  return {static_cast<std::uint32_t>(cell.column), static_cast<std::uint32_t>(cell.row)};
}

} // namespace tilepack
