#include "tilepack/synth/shared_window.h"

#include "tilepack/seam/cut_graph.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace tilepack {
namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

// Of a tile's corners, by pane of a window at a lattice point: the tile north-west of it has it at its south-east.
int corner_of_pane(const FrameShape& shape, const FrameShape::Tile& tile, std::size_t pane) {
  const FrameShape::Strip& strip = shape.horizontal[index(pane < 2 ? tile.south : tile.north)];
  return pane % 2 == 0 ? strip.second : strip.first;
}

// The first part of a pane whose tile is one that `wanted` accepts.
template <class Wanted>
std::size_t first_part(const FrameShape& shape, const SharedWindow& window, std::size_t pane,
                       Wanted&& wanted) {
  const auto it = std::find_if(window.parts.begin(), window.parts.end(), [&](const WindowPart& part) {
    return part.pane == pane && wanted(shape.tiles[part.tile]);
  });
  return static_cast<std::size_t>(it - window.parts.begin());
}

template <class Wanted>
int tiles_with(const FrameShape& shape, Wanted&& wanted) {
  return static_cast<int>(std::count_if(shape.tiles.begin(), shape.tiles.end(), wanted));
}

// The border between panes `before` and `after` along the edge of this strip, if there are tiles on both sides.
void add_border(const FrameShape& shape, Direction direction, int strip, std::size_t before,
                std::size_t after, int from, int to, SharedWindow& window) {
  const bool horizontal = direction == Direction::horizontal;
  const auto ends = [&](const FrameShape::Tile& t) { return (horizontal ? t.south : t.east) == strip; };
  const auto begins = [&](const FrameShape::Tile& t) { return (horizontal ? t.north : t.west) == strip; };
  const std::size_t a = first_part(shape, window, before, ends);
  const std::size_t b = first_part(shape, window, after, begins);
  if (from < to && a < window.parts.size() && b < window.parts.size())
    window.borders.push_back({a, b, direction, from, to, tiles_with(shape, begins)});
}

// A texel that several tiles share: the side or corner of the tile, its color, the place there.
using SharedTexel = std::tuple<int, int, int, int>;

// Where in_guard.
SharedTexel shared_texel(const FrameShape& shape, const FrameShape::Tile& tile, int x, int y) {
  const int w = shape.tile.width, h = shape.tile.height, guard = shape.guard;
  const bool north = y < guard, south = y >= h - guard, west = x < guard, east = x >= w - guard;
  if ((north || south) && (west || east)) {
    const std::size_t pane = (south ? 0u : 2u) + (east ? 0u : 1u);
    return {4 + static_cast<int>(pane), corner_of_pane(shape, tile, pane), x, y};
  }
  if (north) return {0, tile.north, x, y};
  if (south) return {1, tile.south, x, y};
  if (west) return {2, tile.west, x, y};
  return {3, tile.east, x, y};
}

// One graph for all parts of a window.
class WindowGraph {
public:
  WindowGraph(const FeatureImage& feature_image, const FrameShape& frame_shape, const LaidWindow& laid_window,
              const std::vector<SourceCanvas>& set_tiles, const WindowDecisions& decided)
      : image(feature_image), shape(frame_shape), laid(laid_window), window(laid_window.window),
        tiles(set_tiles), graph(open_texels(decided)) {
    std::map<SharedTexel, int> shared;
    for (std::size_t n = 0; n < window.parts.size(); ++n) {
      const WindowPart& part = window.parts[n];
      std::vector<int>& own = nodes.emplace_back();
      const Rect& a = part.area;
      for (int y = a.y; y < a.y + a.height; ++y)
        for (int x = a.x; x < a.x + a.width; ++x) {
          if (!in_guard(shape, x, y)) {
            const CutConstraint c = decided.empty() ? CutConstraint::free : decided[n][own.size()];
            own.push_back(c == CutConstraint::keep   ? CutGraph::kept
                          : c == CutConstraint::take ? CutGraph::taken
                                                     : graph.add_node());
            continue;
          }
          if (is_kept(x, y)) {
            own.push_back(CutGraph::kept);
            continue;
          }
          const auto [it, is_new] = shared.try_emplace(shared_texel(shape, shape.tiles[part.tile], x, y), 0);
          if (is_new) it->second = graph.add_node();
          own.push_back(it->second);
        }
    }
    if (laid.price > 0) mark_lone();
  }

  WindowCut solved() {
    for (std::size_t n = 0; n < lone.size(); ++n)
      for (std::size_t i = 0; i < lone[n].size(); ++i)
        if (lone[n][i] && nodes[n][i] >= 0) graph.add_price(nodes[n][i], laid.price);
    for_each_pair([&](const Pair& pair) {
      if (pair.p < 0 && pair.q < 0) return;
      const auto cost = [&](SourceTexel a, SourceTexel b) {
        return static_cast<double>(pair.times * seam_cost(image, a, b, pair.dx, pair.dy));
      };
      const bool some_takes = pair.p == CutGraph::taken || pair.q == CutGraph::taken;
      graph.add_pair(
          pair.p, pair.q, some_takes ? 0.0 : cost(pair.p_old, pair.q_old),
          pair.q == CutGraph::kept || pair.p == CutGraph::taken ? 0.0 : cost(pair.p_old, pair.q_new),
          pair.p == CutGraph::kept || pair.q == CutGraph::taken ? 0.0 : cost(pair.p_new, pair.q_old));
    });
    graph.solve();
    WindowCut cut;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      std::vector<CutConstraint>& own = cut.decisions.emplace_back();
      for (std::size_t i = 0; i < nodes[n].size(); ++i) {
        const bool takes = graph.takes(nodes[n][i]);
        own.push_back(takes ? CutConstraint::take : CutConstraint::keep);
        if (takes && !lone.empty() && lone[n][i]) cut.gain -= laid.price;
      }
    }
    for_each_pair([&](const Pair& pair) {
      const SourceTexel p = graph.takes(pair.p) ? pair.p_new : pair.p_old;
      const SourceTexel q = graph.takes(pair.q) ? pair.q_new : pair.q_old;
      const std::int64_t old = pair.times * seam_cost(image, pair.p_old, pair.q_old, pair.dx, pair.dy);
      cut.before += old;
      if (p != pair.p_old || q != pair.q_old)
        cut.gain += old - pair.times * seam_cost(image, p, q, pair.dx, pair.dy);
    });
    return cut;
  }

private:
  // At most so many get a node.
  std::size_t open_texels(const WindowDecisions& decided) const {
    std::size_t sum = 0;
    for (std::size_t n = 0; n < window.parts.size(); ++n) {
      const Rect& a = window.parts[n].area;
      const std::size_t all = index(a.width) * index(a.height);
      const std::size_t shared =
          index(shape.guard) * (index(a.width) + index(a.height)); // what is shared is always open
      sum +=
          decided.empty()
              ? all
              : std::min(all, 2 * shared + static_cast<std::size_t>(std::count(
                                               decided[n].begin(), decided[n].end(), CutConstraint::free)));
    }
    return sum;
  }

  // A window on an edge changes nothing at the edge's ends.
  bool is_kept(int x, int y) const {
    if (window.panes == 4) return false;
    const int along = window.borders.empty() ? 0
                      : window.borders[0].direction == Direction::horizontal
                          ? std::min(x, shape.tile.width - 1 - x)
                          : std::min(y, shape.tile.height - 1 - y);
    return along < shape.guard;
  }

  // (x, y) of the part's area.
  SourceTexel proposed(const WindowPart& part, int x, int y) const {
    return {laid.place.x + part.at.x + x, laid.place.y + part.at.y + y};
  }
  int node(std::size_t n, int x, int y) const {
    const Rect& a = window.parts[n].area;
    if (x < 0 || y < 0 || x >= a.width || y >= a.height) return CutGraph::kept;
    return nodes[n][index(y) * index(a.width) + index(x)];
  }

  // What only one tile shows there.
  void mark_lone() {
    for (const WindowPart& part : window.parts) {
      std::vector<std::uint8_t>& own = lone.emplace_back();
      const std::vector<int>& node_of = nodes[lone.size() - 1];
      std::size_t i = 0;
      for (int y = part.area.y; y < part.area.y + part.area.height; ++y)
        for (int x = part.area.x; x < part.area.x + part.area.width; ++x, ++i) {
          bool alone = node_of[i] != CutGraph::kept && !in_guard(shape, x, y);
          const SourceTexel shown = tiles[part.tile].at(x, y);
          for (std::size_t n = 0; alone && n < window.parts.size(); ++n) {
            const WindowPart& other = window.parts[n];
            alone = other.pane != part.pane || other.tile == part.tile || tiles[other.tile].at(x, y) != shown;
          }
          own.push_back(alone);
        }
    }
  }

  // Two neighbours of which one at least has a node: what they show, what they would, how often they meet.
  struct Pair {
    int p, q;
    SourceTexel p_old, q_old, p_new, q_new;
    int dx, dy, times;
  };

  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    for (std::size_t n = 0; n < window.parts.size(); ++n) visit_part(n, visit);
    for (const PaneBorder& border : window.borders) visit_border(border, visit);
  }

  // Pairs within the part, and those that join it to the texels of its tile around it.
  template <class Visit>
  void visit_part(std::size_t n, Visit& visit) const {
    const WindowPart& part = window.parts[n];
    const SourceCanvas& tile = tiles[part.tile];
    const Rect& a = part.area;
    const auto look = [&](int x, int y, int dx, int dy) {
      const int tx = a.x + x, ty = a.y + y;
      if (tx < 0 || ty < 0 || tx + dx >= tile.width || ty + dy >= tile.height) return;
      const int p = node(n, x, y), q = node(n, x + dx, y + dy);
      if (p != CutGraph::kept || q != CutGraph::kept)
        visit(Pair{p, q, tile.at(tx, ty), tile.at(tx + dx, ty + dy), proposed(part, x, y),
                   proposed(part, x + dx, y + dy), dx, dy, 1});
    };
    for (int y = -1; y < a.height; ++y)
      for (int x = -1; x < a.width; ++x) {
        if (y >= 0) look(x, y, 1, 0);
        if (x >= 0) look(x, y, 0, 1);
      }
  }

  template <class Visit>
  void visit_border(const PaneBorder& border, Visit& visit) const {
    const WindowPart& before = window.parts[border.before];
    const WindowPart& after = window.parts[border.after];
    const bool horizontal = border.direction == Direction::horizontal;
    for (int i = border.from; i < border.to; ++i) {
      const int px = horizontal ? i - before.at.x : before.area.width - 1;
      const int py = horizontal ? before.area.height - 1 : i - before.at.y;
      const int qx = horizontal ? i - after.at.x : 0;
      const int qy = horizontal ? 0 : i - after.at.y;
      const int p = node(border.before, px, py), q = node(border.after, qx, qy);
      if (p != CutGraph::kept || q != CutGraph::kept)
        visit(Pair{p, q, tiles[before.tile].at(before.area.x + px, before.area.y + py),
                   tiles[after.tile].at(after.area.x + qx, after.area.y + qy), proposed(before, px, py),
                   proposed(after, qx, qy), horizontal ? 0 : 1, horizontal ? 1 : 0, border.tiles});
    }
  }

  const FeatureImage& image;
  const FrameShape& shape;
  const LaidWindow& laid;
  const SharedWindow& window;
  const std::vector<SourceCanvas>& tiles;
  CutGraph graph;
  std::vector<std::vector<std::uint8_t>> lone;
  std::vector<std::vector<int>> nodes; // of each part, row by row
};

} // namespace

SharedWindow window_at_corner(const FrameShape& shape, int color, Rect area) {
  const int w = shape.tile.width, h = shape.tile.height;
  const int west = -area.x, north = -area.y, east = area.width - west, south = area.height - north;
  const std::array<Rect, 4> areas{{{w - west, h - north, west, north},
                                   {0, h - north, east, north},
                                   {w - west, 0, west, south},
                                   {0, 0, east, south}}};
  SharedWindow window{{area.width, area.height}, 4, {}, {}};
  for (std::size_t pane = 0; pane < 4; ++pane)
    for (std::size_t id = 0; id < shape.tiles.size(); ++id)
      if (corner_of_pane(shape, shape.tiles[id], pane) == color)
        window.parts.push_back({id, areas[pane], {pane % 2 == 0 ? 0 : west, pane < 2 ? 0 : north}, pane});
  for (int strip = 0; strip < static_cast<int>(shape.horizontal.size()); ++strip) {
    const FrameShape::Strip& ends = shape.horizontal[index(strip)];
    if (ends.second == color) add_border(shape, Direction::horizontal, strip, 0, 2, 0, west, window);
    if (ends.first == color) add_border(shape, Direction::horizontal, strip, 1, 3, west, area.width, window);
  }
  for (int strip = 0; strip < static_cast<int>(shape.vertical.size()); ++strip) {
    const FrameShape::Strip& ends = shape.vertical[index(strip)];
    if (ends.second == color) add_border(shape, Direction::vertical, strip, 0, 1, 0, north, window);
    if (ends.first == color) add_border(shape, Direction::vertical, strip, 2, 3, north, area.height, window);
  }
  return window;
}

SharedWindow window_on_edge(const FrameShape& shape, Direction direction, std::size_t strip, Rect area) {
  const bool horizontal = direction == Direction::horizontal;
  const int color = static_cast<int>(strip);
  SharedWindow window{{area.width, area.height}, 2, {}, {}};
  for (std::size_t pane = 0; pane < 2; ++pane)
    for (std::size_t id = 0; id < shape.tiles.size(); ++id) {
      const FrameShape::Tile& t = shape.tiles[id];
      if ((horizontal ? (pane == 0 ? t.south : t.north) : (pane == 0 ? t.east : t.west)) != color) continue;
      WindowPart part{id, area, {0, 0}, pane};
      if (horizontal) {
        part.area.y = pane == 0 ? shape.tile.height + area.y : 0;
        part.area.height = pane == 0 ? -area.y : area.height + area.y;
        part.at.y = pane == 0 ? 0 : -area.y;
      } else {
        part.area.x = pane == 0 ? shape.tile.width + area.x : 0;
        part.area.width = pane == 0 ? -area.x : area.width + area.x;
        part.at.x = pane == 0 ? 0 : -area.x;
      }
      window.parts.push_back(part);
    }
  add_border(shape, direction, color, 0, 1, 0, horizontal ? area.width : area.height, window);
  return window;
}

std::size_t guises(const SharedWindow& window) {
  std::vector<std::size_t> counts(window.panes);
  for (const WindowPart& part : window.parts) ++counts[part.pane];
  return *std::max_element(counts.begin(), counts.end());
}

SourceCanvas shown_in_window(const SharedWindow& window, const std::vector<SourceCanvas>& tiles,
                             std::size_t guise) {
  SourceCanvas canvas(window.size.width, window.size.height);
  for (std::size_t pane = 0, first = 0; pane < window.panes; ++pane) {
    std::size_t last = first;
    while (last < window.parts.size() && window.parts[last].pane == pane) ++last;
    if (first == last) continue;
    const WindowPart& part = window.parts[first + (guise + pane * guise / 2) % (last - first)];
    for (int y = 0; y < part.area.height; ++y)
      for (int x = 0; x < part.area.width; ++x)
        canvas.at(part.at.x + x, part.at.y + y) = tiles[part.tile].at(part.area.x + x, part.area.y + y);
    first = last;
  }
  return canvas;
}

WindowCut cut_of_window(const FeatureImage& image, const FrameShape& shape, const LaidWindow& laid,
                        const std::vector<SourceCanvas>& tiles, const WindowDecisions& decided) {
  return WindowGraph(image, shape, laid, tiles, decided).solved();
}

bool apply(const LaidWindow& laid, const WindowDecisions& decisions, std::vector<SourceCanvas>& tiles) {
  bool changed = false;
  for (std::size_t n = 0; n < decisions.size(); ++n) {
    const WindowPart& part = laid.window.parts[n];
    std::size_t i = 0;
    for (int y = 0; y < part.area.height; ++y)
      for (int x = 0; x < part.area.width; ++x, ++i) {
        if (decisions[n][i] != CutConstraint::take) continue;
        SourceTexel& texel = tiles[part.tile].at(part.area.x + x, part.area.y + y);
        const SourceTexel from{laid.place.x + part.at.x + x, laid.place.y + part.at.y + y};
        changed = changed || texel != from;
        texel = from;
      }
  }
  return changed;
}

SharedWindow shrunk(SharedWindow window, int scale) {
  const auto shrink = [&](int& v) { v /= scale; };
  shrink(window.size.width);
  shrink(window.size.height);
  for (WindowPart& p : window.parts)
    for (int* v : {&p.area.x, &p.area.y, &p.area.width, &p.area.height, &p.at.x, &p.at.y}) shrink(*v);
  for (PaneBorder& b : window.borders) {
    shrink(b.from);
    shrink(b.to);
  }
  return window;
}

WindowDecisions enlarged(const WindowDecisions& decisions, const SharedWindow& window, int scale) {
  WindowDecisions large;
  for (std::size_t n = 0; n < decisions.size(); ++n) {
    const int w = window.parts[n].area.width / scale, h = window.parts[n].area.height / scale;
    const auto at = [&](int x, int y) {
      return decisions[n][index(std::clamp(y, 0, h - 1)) * index(w) + index(std::clamp(x, 0, w - 1))];
    };
    std::vector<CutConstraint> small;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        bool same = true;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) same = same && at(x + dx, y + dy) == at(x, y);
        small.push_back(same ? at(x, y) : CutConstraint::free);
      }
    std::vector<CutConstraint>& own = large.emplace_back();
    for (int y = 0; y < h * scale; ++y)
      for (int x = 0; x < w * scale; ++x)
        own.push_back(small[index(y / scale) * index(w) + index(x / scale)]);
  }
  return large;
}

} // namespace tilepack
