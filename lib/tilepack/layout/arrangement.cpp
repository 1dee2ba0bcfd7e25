#include "tilepack/layout/arrangement.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/de_bruijn.h"
#include "tilepack/layout/rotated_lattice.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/tileset/border_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>

namespace tilepack {
namespace {

enum Direction { north, east, south, west };
constexpr int unknown = -1;

class Search {
public:
  Search(const TileColors& tiles, const RotatedScheme& scheme, long long most_trials)
      : borders(border_colors(tiles)), neighbours(borders.size()), tile_at(borders.size(), unknown),
        used(borders.size(), false), trials_left(most_trials) {
    const RotatedLattice lattice(scheme);
    for (int site = 0; site < lattice.sites(); ++site) {
      const int to_east = lattice.east_of(site);
      const int to_south = lattice.south_of(site);
      neighbours[index(site)][east] = to_east;
      neighbours[index(to_east)][west] = site;
      neighbours[index(site)][south] = to_south;
      neighbours[index(to_south)][north] = site;
    }
  }

  Arrangement run() {
    if (!balanced()) return {Matching::none, {}};
    if (place_rest()) return {Matching::found, tile_at};
    return {trials_left > 0 ? Matching::none : Matching::not_found, {}};
  }

private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  // Each border has two sides, so a color occurs as often east as west and as often south as north.
  bool balanced() const {
    std::map<int, int> across;
    std::map<int, int> down;
    for (const BorderColors& b : borders) {
      ++across[b.east];
      --across[b.west];
      ++down[b.south];
      --down[b.north];
    }
    const auto zero = [](const auto& entry) { return entry.second == 0; };
    return std::all_of(across.begin(), across.end(), zero) && std::all_of(down.begin(), down.end(), zero);
  }

  // A site may neighbour itself (1 tile, or 2 turned by 45° at their corners): then the tile is its own
  // neighbour.
  bool fits(int tile, int site) const {
    const BorderColors& mine = borders[index(tile)];
    for (const Direction side : {north, east, south, west}) {
      const int next = neighbours[index(site)][side];
      const int other = next == site ? tile : tile_at[index(next)];
      if (other == unknown) continue;
      const BorderColors& theirs = borders[index(other)];
      const bool agree = side == north   ? mine.north == theirs.south
                         : side == east  ? mine.east == theirs.west
                         : side == south ? mine.south == theirs.north
                                         : mine.west == theirs.east;
      if (!agree) return false;
    }
    return true;
  }

  std::vector<int> candidates(int site) {
    trials_left -= static_cast<long long>(borders.size());
    std::vector<int> result;
    for (int tile = 0; tile < static_cast<int>(borders.size()); ++tile)
      if (!used[index(tile)] && fits(tile, site)) result.push_back(tile);
    return result;
  }

  // Depth first, the most constrained site next.
  bool place_rest() {
    int site = unknown;
    std::vector<int> options;
    for (int s = 0; s < static_cast<int>(borders.size()); ++s) {
      if (tile_at[index(s)] != unknown) continue;
      std::vector<int> here = candidates(s);
      if (here.empty()) return false;
      if (site == unknown || here.size() < options.size()) {
        site = s;
        options = std::move(here);
      }
    }
    if (site == unknown) return true;
    // The torus may be shifted so that tile 0 lies on any site: at the root one tile is enough.
    if (std::all_of(tile_at.begin(), tile_at.end(), [](int t) { return t == unknown; })) options.resize(1);
    for (const int tile : options) {
      if (trials_left <= 0) return false;
      tile_at[index(site)] = tile;
      used[index(tile)] = true;
      if (place_rest()) return true;
      tile_at[index(site)] = unknown;
      used[index(tile)] = false;
    }
    return false;
  }

  std::vector<BorderColors> borders;
  std::vector<std::array<int, 4>> neighbours; // by site
  std::vector<int> tile_at;                   // by site
  std::vector<bool> used;                     // by tile
  long long trials_left;
};

// Complete sets have known grids; empty if this isn't one.
std::vector<int> complete_grid(const TileColors& tiles, const RotatedScheme& scheme) {
  if (scheme.k != 0 || !is_complete_set(tiles)) return {};
  const Layout layout = coloring_of(tiles) == Coloring::edge
                            ? tile_index_layout(std::get<std::vector<EdgeTile>>(tiles))
                            : de_bruijn_layout(std::get<std::vector<CornerTile>>(tiles));
  // Of two variants the second torus may as well lie beside the first.
  const bool beside = layout.columns == scheme.n && layout.rows == 2 * scheme.n && scheme.squares == 2;
  if (!beside && (layout.rows != scheme.n || layout.columns != scheme.n * scheme.squares)) return {};
  const RotatedLattice lattice(scheme);
  std::vector<int> tile_on(layout.cells.size());
  for (const Cell& cell : layout.cells) {
    const int second = beside && cell.row >= scheme.n ? scheme.n : 0;
    tile_on[static_cast<std::size_t>(lattice.site_at({cell.column + second, cell.row - second}))] = cell.tile;
  }
  return tile_on;
}

} // namespace

Arrangement matching_arrangement(const TileColors& tiles, const RotatedScheme& scheme,
                                 long long most_trials) {
  if (tile_count(tiles) != tile_count(scheme))
    throw Error(ErrorKind::internal, "matching_arrangement",
                fmt::format("{} tiles for a scheme of {}", tile_count(tiles), tile_count(scheme)));
  if (std::vector<int> known = complete_grid(tiles, scheme); !known.empty())
    return {Matching::found, std::move(known)};
  return Search(tiles, scheme, most_trials).run();
}

} // namespace tilepack
