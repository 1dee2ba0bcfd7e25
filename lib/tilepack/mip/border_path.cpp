#include "tilepack/mip/border_path.h"

#include "tilepack/numeric/as_size.h"
#include "tilepack/numeric/wrap.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace tilepack {
namespace {

// m(i, j) for i, j = -1..length: the pad is at -1 and length, the ring at 0 and length - 1.
double line_integral(int i, int j, int length) {
  const auto pad = [length](int k) { return k < 0 || k == length; };
  if (i == j) {
    if (pad(i)) return 1.0 / 24;
    const double before = i == 0 ? 7.0 / 24 : 1.0 / 3;
    const double after = i == length - 1 ? 7.0 / 24 : 1.0 / 3;
    return before + after;
  }
  if (std::abs(i - j) > 1) return 0;
  return pad(i) || pad(j) ? 1.0 / 12 : 1.0 / 6;
}

} // namespace

PackNeighbours pack_neighbours(const Layout& layout) {
  PackNeighbours neighbours;
  if (layout.kind == LayoutKind::array || layout.kind == LayoutKind::rotated) return neighbours;
  std::vector<int> grid(as_size(layout.columns) * as_size(layout.rows), 0);
  const auto cell = [&](int column, int row) -> int& {
    return grid[as_size(wrapped(row, layout.rows)) * as_size(layout.columns) +
                as_size(wrapped(column, layout.columns))];
  };
  for (const Cell& c : layout.cells) cell(c.column, c.row) = c.tile;
  neighbours.around.resize(layout.cells.size());
  for (const Cell& c : layout.cells) {
    std::size_t i = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (dx != 0 || dy != 0) neighbours.around[as_size(c.tile)][i++] = cell(c.column + dx, c.row + dy);
  }
  return neighbours;
}

BorderPath::BorderPath(Size tile_size) : size(tile_size) {
  const int w = size.width;
  const int h = size.height;
  index_of_node.assign(as_size(w + 2) * as_size(h + 2), -1);
  index_in_ring.assign(as_size(w) * as_size(h), -1);
  for (int y = -1; y <= h; ++y)
    for (int x = -1; x <= w; ++x) {
      if (x > 0 && x < w - 1 && y > 0 && y < h - 1) continue;
      index_of_node[as_size(y + 1) * as_size(w + 2) + as_size(x + 1)] = static_cast<int>(all_nodes.size());
      all_nodes.push_back({x, y});
      if (x >= 0 && x < w && y >= 0 && y < h) index_in_ring[as_size(y * w + x)] = ring_texels++;
    }
  for (const Node& a : all_nodes) {
    auto& list = node_products.emplace_back();
    for (int y = std::max(-1, a.y - 1); y <= std::min(h, a.y + 1); ++y)
      for (int x = std::max(-1, a.x - 1); x <= std::min(w, a.x + 1); ++x)
        if (const int b = node_at(x, y); b >= 0)
          list.push_back({b, line_integral(a.x, x, w) * line_integral(a.y, y, h)});
  }
  for (int x = -1; x <= w; ++x) {
    side_crossings[north].push_back({node_at(x, 0), node_at(x, -1)});
    side_crossings[south].push_back({node_at(x, h - 1), node_at(x, h)});
  }
  for (int y = -1; y <= h; ++y) {
    side_crossings[west].push_back({node_at(0, y), node_at(-1, y)});
    side_crossings[east].push_back({node_at(w - 1, y), node_at(w, y)});
  }
}

int BorderPath::node_at(int x, int y) const {
  return index_of_node[as_size(y + 1) * as_size(size.width + 2) + as_size(x + 1)];
}

int BorderPath::ring_index(int x, int y) const {
  return index_in_ring[as_size(y * size.width + x)];
}

void BorderPath::integrate(const std::vector<double>& values, std::vector<double>& out) {
  const int length = static_cast<int>(values.size()) - 2;
  out.assign(values.size(), 0.0);
  for (int i = -1; i <= length; ++i)
    for (int j = std::max(-1, i - 1); j <= std::min(length, i + 1); ++j)
      out[as_size(i + 1)] += line_integral(i, j, length) * values[as_size(j + 1)];
}

} // namespace tilepack
