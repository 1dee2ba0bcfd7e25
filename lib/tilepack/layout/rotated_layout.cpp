#include "tilepack/layout/rotated_layout.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/rotated_lattice.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace tilepack {

Size rotated_texture_size(const RotatedScheme& scheme, const RotatedTexture& texture) {
  if (texture.tile_side < 1 || texture.tile_side > limits::largest_tile_side)
    throw Error(ErrorKind::usage, "layout rotated",
                fmt::format("tile side {}; 1 to {} texels", texture.tile_side, limits::largest_tile_side));
  if (texture.gutter < 0 || texture.gutter > texture.tile_side)
    throw Error(ErrorKind::usage, field("gutter"),
                fmt::format("{} texels; 0 to the tile's side, {}", texture.gutter, texture.tile_side));
  const std::int64_t cell = texture.tile_side + 2 * texture.gutter;
  const std::int64_t area = cell * cell * (scheme.n * scheme.n + scheme.k * scheme.k);
  std::int64_t side = static_cast<std::int64_t>(std::sqrt(static_cast<double>(area)));
  while (side * side < area) ++side;
  while (side > 1 && (side - 1) * (side - 1) >= area) --side;
  if (texture.power_of_two) {
    std::int64_t power = 1;
    while (power < side) power *= 2;
    side = power;
  }
  if (side * scheme.squares > limits::longest_texture_side)
    throw Error(ErrorKind::usage, "layout rotated",
                fmt::format("{} tiles of {} texels a side need a texture {} texels wide; at most {}, so take "
                            "smaller tiles or fewer",
                            tile_count(scheme), texture.tile_side, side * scheme.squares,
                            limits::longest_texture_side));
  return {static_cast<int>(side) * scheme.squares, static_cast<int>(side)};
}

Layout rotated_layout(const RotatedScheme& scheme, const RotatedTexture& texture,
                      const std::vector<int>& arrangement) {
  const RotatedLattice lattice(scheme);
  if (static_cast<int>(arrangement.size()) != lattice.sites())
    throw Error(
        ErrorKind::internal, "rotated_layout",
        fmt::format("{} tiles for the {} sites of {}", arrangement.size(), lattice.sites(), formula(scheme)));
  Layout layout;
  layout.kind = LayoutKind::rotated;
  layout.columns = lattice.columns();
  layout.rows = lattice.rows();
  layout.rotated = {scheme, texture.gutter, rotated_texture_size(scheme, texture), Matching::none};
  layout.cells.resize(arrangement.size());
  for (int site = 0; site < lattice.sites(); ++site) {
    const int tile = arrangement[static_cast<std::size_t>(site)];
    Cell cell = lattice.cell_of(site);
    cell.tile = tile;
    layout.cells.at(static_cast<std::size_t>(tile)) = cell;
  }
  return layout;
}

} // namespace tilepack
