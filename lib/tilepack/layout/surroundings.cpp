#include "tilepack/layout/surroundings.h"

#include "tilepack/layout/rotated_lattice.h"
#include "tilepack/numeric/as_size.h"
#include "tilepack/tileset/border_colors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <functional>

namespace tilepack {
namespace {

template <typename Fits>
int first_tile(const std::vector<BorderColors>& borders, Fits&& fits) {
  const auto at = std::find_if(borders.begin(), borders.end(), fits);
  return at == borders.end() ? -1 : static_cast<int>(at - borders.begin());
}

} // namespace

std::vector<Surroundings> fitting_surroundings(const TileColors& tiles) {
  const std::vector<BorderColors> all = border_colors(tiles);
  const auto first = [&](auto&& fits) { return first_tile(all, fits); };
  // A corner neighbour needs both side neighbours next to it.
  const auto corner = [&](int a, int b, auto&& fits) {
    if (a < 0 || b < 0) return -1;
    return first([&](const BorderColors& x) { return fits(x, all[as_size(a)], all[as_size(b)]); });
  };
  std::vector<Surroundings> result;
  for (const BorderColors& mine : all) {
    Surroundings r;
    r.n = first([&](const BorderColors& x) { return x.south == mine.north; });
    r.s = first([&](const BorderColors& x) { return x.north == mine.south; });
    r.w = first([&](const BorderColors& x) { return x.east == mine.west; });
    r.e = first([&](const BorderColors& x) { return x.west == mine.east; });
    using B = const BorderColors&;
    r.nw = corner(r.n, r.w, [](B x, B n, B w) { return x.east == n.west && x.south == w.north; });
    r.ne = corner(r.n, r.e, [](B x, B n, B e) { return x.west == n.east && x.south == e.north; });
    r.sw = corner(r.s, r.w, [](B x, B s, B w) { return x.east == s.west && x.north == w.south; });
    r.se = corner(r.s, r.e, [](B x, B s, B e) { return x.west == s.east && x.north == e.south; });
    result.push_back(r);
  }
  return result;
}

std::vector<Surroundings> packed_surroundings(const Layout& rotated) {
  const RotatedLattice lattice(rotated.rotated.scheme);
  std::vector<int> tile_on(rotated.cells.size());
  std::vector<int> site_of(rotated.cells.size());
  for (const Cell& cell : rotated.cells) {
    const int site = lattice.site_with(cell.column, cell.row);
    tile_on[as_size(site)] = cell.tile;
    site_of[as_size(cell.tile)] = site;
  }
  std::vector<Surroundings> result;
  for (std::size_t tile = 0; tile < site_of.size(); ++tile) {
    const LatticeStep here = lattice.step_to(site_of[tile]);
    const auto at = [&](int east, int south) {
      return tile_on[as_size(lattice.site_at({here.east + east, here.south + south}))];
    };
    result.push_back({at(-1, -1), at(0, -1), at(1, -1), at(-1, 0), at(1, 0), at(-1, 1), at(0, 1), at(1, 1)});
  }
  return result;
}

bool colors_match(const TileColors& tiles, const std::vector<Surroundings>& packed) {
  const std::vector<BorderColors> borders = border_colors(tiles);
  for (std::size_t id = 0; id < packed.size(); ++id)
    if (borders[id].east != borders[as_size(packed[id].e)].west ||
        borders[id].south != borders[as_size(packed[id].s)].north)
      return false;
  return true;
}

std::vector<Image> with_margin(const std::vector<Image>& tiles, const std::vector<Surroundings>& surroundings,
                               int margin) {
  std::vector<Image> result(tiles.size());
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t id) {
    const Image& own = tiles[id];
    const int w = own.width();
    const int h = own.height();
    const Surroundings round = surroundings.empty() ? Surroundings{} : surroundings[id];
    const int ids[3][3] = {{round.nw, round.n, round.ne},
                           {round.w, static_cast<int>(id), round.e},
                           {round.sw, round.s, round.se}};
    Image wide(w + 2 * margin, h + 2 * margin, own.channels());
    for (int y = 0; y < wide.height(); ++y)
      for (int x = 0; x < wide.width(); ++x) {
        int from_x = std::clamp(x - margin, -w, 2 * w - 1);
        int from_y = std::clamp(y - margin, -h, 2 * h - 1);
        const auto third = [](int i, int side) { return i < 0 ? 0 : i < side ? 1 : 2; };
        int column = third(from_x, w);
        int row = third(from_y, h);
        // Without a corner neighbour the side neighbours' texels go on; without these the tile's own.
        if (ids[row][column] < 0 && row != 1 && column != 1) {
          from_x = std::clamp(from_x, 0, w - 1);
          column = 1;
        }
        if (ids[row][column] < 0) {
          from_x = std::clamp(from_x, 0, w - 1);
          from_y = std::clamp(from_y, 0, h - 1);
          row = column = 1;
        }
        const auto texel =
            tiles[as_size(ids[row][column])].texel(from_x - (column - 1) * w, from_y - (row - 1) * h);
        std::copy(texel.begin(), texel.end(), wide.texel(x, y).begin());
      }
    result[id] = std::move(wide);
  });
  return result;
}

} // namespace tilepack
