#include "tilepack/mapping/index_fill.h"

#include "tilepack/error/error.h"
#include "tilepack/mapping/index_size.h"
#include "tilepack/numeric/random.h"
#include "tilepack/tileset/border_colors.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

namespace tilepack {
namespace {

// Rows before the last from which on a row's south colors must be able to reach the first row's north colors.
constexpr int horizon = 32;
constexpr int most_retries = 2000;

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

// The colors of one axis renumbered 0..count-1.
class Numbering {
public:
  int of(int color) { return numbers.emplace(color, static_cast<int>(numbers.size())).first->second; }
  int count() const { return static_cast<int>(numbers.size()); }

private:
  std::map<int, int> numbers;
};

class Filler {
public:
  Filler(VirtualSize size, const TileColors& tiles, std::uint64_t fill_seed)
      : width(static_cast<int>(size.width)), height(static_cast<int>(size.height)), seed(fill_seed) {
    Numbering rows;
    Numbering columns;
    for (const BorderColors& b : border_colors(tiles))
      borders.push_back({rows.of(b.north), columns.of(b.east), rows.of(b.south), columns.of(b.west)});
    row_colors = rows.count();
    column_colors = columns.count();
    fitting.resize(index(row_colors) * index(column_colors));
    for (std::size_t id = 0; id < borders.size(); ++id)
      fitting[index(borders[id].north * column_colors + borders[id].west)].push_back(static_cast<int>(id));
    // reach[r][north * row_colors + south]: can r tiles below each other join these colors?
    reach.emplace_back(index(row_colors) * index(row_colors), false);
    for (int c = 0; c < row_colors; ++c) reach[0][index(c * row_colors + c)] = true;
    for (int r = 1; r <= horizon; ++r) {
      std::vector<bool> next(reach[0].size(), false);
      for (const BorderColors& b : borders)
        for (int goal = 0; goal < row_colors; ++goal)
          if (reach.back()[index(b.south * row_colors + goal)])
            next[index(b.north * row_colors + goal)] = true;
      reach.push_back(std::move(next));
    }
  }

  std::optional<std::vector<int>> run() {
    ids.assign(index(width) * index(height), -1);
    int retries = 0;
    for (int y = 0; y < height;) {
      if (fill_row(y)) {
        ++y;
        continue;
      }
      if (++retries > most_retries) return {};
      ++salt;
      y = std::max(0, y - 1 - retries % (row_colors + 2)); // a row or a few back, and choose anew
    }
    return std::move(ids);
  }

private:
  int id_at(int x, int y) const { return ids[index(y) * index(width) + index(x)]; }

  // The tiles that fit cell (x, y) with this west color, as far as north and south decide.
  template <typename Use>
  void for_candidates(int x, int y, int west, Use&& use) const {
    const auto try_tile = [&](int id) {
      const BorderColors& b = borders[index(id)];
      const int rows_below = height - 1 - y;
      // Row 0 closes on itself where it is the only one; below, its north colors are the goal.
      const int goal = y == 0 ? b.north : borders[index(id_at(x, 0))].north;
      if (rows_below <= horizon && !reach[index(rows_below)][index(b.south * row_colors + goal)]) return;
      use(id);
    };
    const int first = y == 0 ? 0 : borders[index(id_at(x, y - 1))].south;
    const int last = y == 0 ? row_colors - 1 : first;
    for (int north = first; north <= last; ++north)
      for (const int id : fitting[index(north * column_colors + west)]) try_tile(id);
  }

  // closes[x][west]: can columns x.. of the row be filled, starting with this west color and ending with
  // `goal`?
  std::vector<std::vector<bool>> closing(int y, int goal) const {
    std::vector<std::vector<bool>> closes(index(width) + 1, std::vector<bool>(index(column_colors), false));
    closes[index(width)][index(goal)] = true;
    for (int x = width - 1; x >= 0; --x)
      for (int west = 0; west < column_colors; ++west)
        for_candidates(x, y, west, [&](int id) {
          if (closes[index(x) + 1][index(borders[index(id)].east)]) closes[index(x)][index(west)] = true;
        });
    return closes;
  }

  // How badly a tile would repeat its neighbours: across a side shows more than across a corner.
  int repeats(int id, int x, int y) const {
    int badness = 0;
    const auto same = [&](int cx, int cy, int weight) {
      const int at_x = (cx + width) % width;
      const int at_y = (cy + height) % height;
      if (id_at(at_x, at_y) == id && (at_x != x || at_y != y)) badness += weight;
    };
    constexpr int side = 8;
    same(x - 1, y, side);
    same(x, y - 1, side);
    same(x - 1, y - 1, 1);
    same(x + 1, y - 1, 1);
    if (x == width - 1) same(x + 1, y, side); // round the torus
    if (y == height - 1)
      for (int dx = -1; dx <= 1; ++dx) same(x + dx, y + 1, dx == 0 ? side : 1);
    return badness;
  }

  std::uint32_t chance(const char* purpose, int x, int y, std::uint32_t count) const {
    const std::uint64_t cell =
        static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width) + static_cast<std::uint64_t>(x);
    return random_below(seed, purpose, (salt << 32) ^ cell, count);
  }

  bool fill_row(int y) {
    std::fill(ids.begin() + static_cast<std::ptrdiff_t>(y) * width, ids.end(), -1);
    const int turn = static_cast<int>(chance("index row", 0, y, static_cast<std::uint32_t>(column_colors)));
    for (int i = 0; i < column_colors; ++i) {
      const int first_west = (turn + i) % column_colors;
      const auto closes = closing(y, first_west);
      if (!closes[0][index(first_west)]) continue;
      int west = first_west;
      for (int x = 0; x < width; ++x) {
        std::vector<int> best;
        int least = 0;
        for_candidates(x, y, west, [&](int id) {
          if (!closes[index(x) + 1][index(borders[index(id)].east)]) return;
          const int badness = repeats(id, x, y);
          if (best.empty() || badness < least) {
            best.clear();
            least = badness;
          }
          if (badness == least) best.push_back(id);
        });
        const int id = best[chance("index cell", x, y, static_cast<std::uint32_t>(best.size()))];
        ids[index(y) * index(width) + index(x)] = id;
        west = borders[index(id)].east;
      }
      return true;
    }
    return false;
  }

  int width;
  int height;
  std::uint64_t seed;
  std::uint64_t salt = 0;
  int row_colors = 0;
  int column_colors = 0;
  std::vector<BorderColors> borders;     // by tile, colors renumbered
  std::vector<std::vector<int>> fitting; // by north * column_colors + west: tiles
  std::vector<std::vector<bool>> reach;
  std::vector<int> ids;
};

} // namespace

void check_index_size(const VirtualSize& size) {
  if (size.width < 1 || size.height < 1 || size.width > limits::longest_index_side ||
      size.height > limits::longest_index_side || size.width * size.height > limits::most_index_cells)
    throw Error(
        ErrorKind::usage, field("virtual-size"),
        fmt::format("{0}x{1} tiles can't be an index map; each side must be 1 to {2}, and there may be {3} "
                    "cells in all, such as {4}x{4}",
                    size.width, size.height, limits::longest_index_side, limits::most_index_cells,
                    largest_index_square()));
}

Mapping filled_index_mapping(VirtualSize size, const TileColors& tiles, std::uint64_t seed) {
  check_index_size(size);
  std::optional<std::vector<int>> ids;
  if (tile_count(tiles) > 0) ids = Filler(size, tiles, seed).run();
  if (!ids)
    throw Error(
        ErrorKind::invalid_content, "index map",
        fmt::format("found no way to fill {}x{} cells with these {} tiles so that colors agree and the map "
                    "wraps; try other sides, or add tiles: each pair of a north and a west color needs one",
                    size.width, size.height, tile_count(tiles)));
  Mapping mapping;
  mapping.kind = MappingKind::index;
  mapping.size = size;
  mapping.ids = std::move(*ids);
  return mapping;
}

} // namespace tilepack
