// Searches for the patterns of lib/mapping/even_pattern.cpp and prints one as C++.
//
//   even_pattern_search [COLORS [SWEEPS [SEED]]]      3000 sweeps take some minutes
//
// A pattern is a torus of corner colors. Wherever one looks at it through a window of 8 x 8 or 16 x 16 tiles,
// all tiles should be shown equally often and no displacement should bring many tiles onto equal ones. Equal
// tiles side by side are what the eye finds first, and rows of three most of all: each costs by itself. One
// corner after the other is recolored at random; what worsens the sum below by more than a threshold, which
// falls to nothing, is taken back. Everything counted is an integer, so taking back is exact.

#include "tilepack/numeric/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

constexpr int side = 64;
constexpr double pi = 3.14159265358979323846;
constexpr double pair_cost = 0.01; // of two equal tiles side by side, along x or y
constexpr double row_cost = 0.2;   // of three, beyond that of their two pairs

constexpr std::size_t at(int x, int y) {
  return static_cast<std::size_t>((y & (side - 1)) * side + (x & (side - 1)));
}

/// Windows of one size at every `stride`-th tile, what is counted in them, and what the counts cost.
struct View {
  int window, stride, farthest;
  double repeat_cost; ///< of the fourth power of the share of equal pairs at one displacement
  double uneven_cost; ///< of the squared difference of a tile's count from the fair one, as a share of it
};

class Windows {
public:
  Windows(const View& chosen, int tile_count)
      : view(chosen), tiles(tile_count), a_side(side / view.stride),
        fair(static_cast<float>(view.window * view.window) / static_cast<float>(tile_count)) {
    // Tiles at a window's middle count more: whoever looks at a repeat looks at both places at once.
    std::vector<int> weight;
    for (int i = 0; i < view.window; ++i)
      weight.push_back(static_cast<int>(std::lround(16 - 16 * std::cos(2 * pi * (i + 0.5) / view.window))));
    pair_weight.resize(static_cast<std::size_t>(view.farthest + 1));
    std::vector<double> total;
    for (int d = 0; d <= view.farthest; ++d) {
      total.push_back(0);
      for (int i = 0; i + d < view.window; ++i) {
        pair_weight[static_cast<std::size_t>(d)].push_back(weight[static_cast<std::size_t>(i)] *
                                                           weight[static_cast<std::size_t>(i + d)]);
        total.back() += pair_weight[static_cast<std::size_t>(d)].back();
      }
    }
    for (int dy = 0; dy <= view.farthest; ++dy)
      for (int dx = -view.farthest; dx <= view.farthest; ++dx)
        if (dy > 0 || dx > 0)
          lags.push_back({dx, dy,
                          static_cast<float>(1 / (total[static_cast<std::size_t>(std::abs(dx))] *
                                                  total[static_cast<std::size_t>(dy)]))});
    const auto all = static_cast<std::size_t>(a_side * a_side);
    equal.assign(lags.size() * all, 0);
    shown.assign(static_cast<std::size_t>(tiles) * all, 0);
    uneven_unit = view.uneven_cost / (static_cast<double>(fair) * fair * tiles);
  }

  struct Lag {
    int dx, dy;
    float norm; ///< one over the sum of the weights of all pairs this far apart
  };

  /// Adds (sign 1) or takes away (-1) the pair of tiles (x, y) and (x, y) + lag; returns what it costs more.
  double pair(std::size_t l, int x, int y, int sign) {
    const Lag& lag = lags[l];
    const int near = std::min(x, x + lag.dx);
    const int reach_x = view.window - std::abs(lag.dx);
    const int reach_y = view.window - lag.dy;
    const int* wx = pair_weight[static_cast<std::size_t>(std::abs(lag.dx))].data();
    const int* wy = pair_weight[static_cast<std::size_t>(lag.dy)].data();
    int* plane = &equal[l * static_cast<std::size_t>(a_side * a_side)];
    float more = 0;
    for (int j = first(y); j < reach_y; j += view.stride) {
      int* row = plane + ((y - j) & (side - 1)) / view.stride * a_side;
      const int scaled = sign * wy[j];
      for (int i = first(near); i < reach_x; i += view.stride) {
        int& e = row[((near - i) & (side - 1)) / view.stride];
        const float before = static_cast<float>(e) * lag.norm;
        e += scaled * wx[i];
        const float after = static_cast<float>(e) * lag.norm;
        const float b = before * before;
        const float a = after * after;
        more += a * a - b * b;
      }
    }
    return view.repeat_cost * static_cast<double>(more);
  }

  /// The same for a tile of this kind at (x, y).
  double show(int x, int y, int kind, int sign) {
    int* plane = &shown[static_cast<std::size_t>(kind * a_side * a_side)];
    float more = 0;
    for (int j = first(y); j < view.window; j += view.stride) {
      int* row = plane + ((y - j) & (side - 1)) / view.stride * a_side;
      for (int i = first(x); i < view.window; i += view.stride) {
        int& n = row[((x - i) & (side - 1)) / view.stride];
        more += 2 * static_cast<float>(sign) * (static_cast<float>(n) - fair) + 1;
        n += sign;
      }
    }
    return uneven_unit * static_cast<double>(more);
  }

  /// For the window at this place in the list: the largest share of equal pairs.
  double most_equal(std::size_t w) const {
    float most = 0;
    for (std::size_t l = 0; l < lags.size(); ++l)
      most = std::max(most, static_cast<float>(equal[l * static_cast<std::size_t>(a_side * a_side) + w]) *
                                lags[l].norm);
    return static_cast<double>(most);
  }
  double unevenness(std::size_t w) const {
    double sum = 0;
    for (int t = 0; t < tiles; ++t) {
      const double off =
          shown[static_cast<std::size_t>(t * a_side * a_side) + w] / static_cast<double>(fair) - 1;
      sum += off * off;
    }
    return sum / tiles;
  }
  void report() const {
    std::vector<double> most;
    double uneven = 0;
    for (std::size_t w = 0; w < static_cast<std::size_t>(a_side * a_side); ++w) {
      most.push_back(most_equal(w));
      uneven += unevenness(w);
    }
    const double windows = static_cast<double>(most.size());
    std::sort(most.begin(), most.end());
    std::fprintf(stderr, "  %2d: equal %.3f median %.3f 90 %% %.3f 99 %%, uneven %.3f", view.window,
                 most[most.size() / 2], most[most.size() * 9 / 10], most[most.size() * 99 / 100],
                 std::sqrt(uneven / windows));
  }

  const View view;
  const int tiles;
  const int a_side;
  std::vector<Lag> lags;

private:
  /// The offset, 0 to stride - 1, of a tile in the nearest window of the list that begins at or before it.
  int first(int x) const { return x & (view.stride - 1); }

  float fair;
  double uneven_unit;
  std::vector<std::vector<int>> pair_weight; ///< distance along an axis, place in the window
  std::vector<int> equal;                    ///< lag, window: weights of equal pairs
  std::vector<int> shown;                    ///< tile, window: how often it is shown
};

class Search {
public:
  Search(int color_count, std::uint64_t random_seed, const std::vector<View>& views)
      : colors(color_count), seed(random_seed), corner(side * side), tile(side * side) {
    for (std::size_t i = 0; i < corner.size(); ++i)
      corner[i] = static_cast<int>(tilepack::random_below(seed, "corner", i, static_cast<unsigned>(colors)));
    for (const View& view : views) all.emplace_back(view, colors * colors * colors * colors);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) tile[at(x, y)] = kind(x, y);
    for (Windows& windows : all)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          windows.show(x, y, tile[at(x, y)], 1);
          for (std::size_t l = 0; l < windows.lags.size(); ++l)
            if (tile[at(x, y)] == tile[at(x + windows.lags[l].dx, y + windows.lags[l].dy)])
              windows.pair(l, x, y, 1);
        }
  }

  void run(int sweeps, double threshold) {
    const auto steps = static_cast<std::uint64_t>(sweeps) * corner.size();
    for (std::uint64_t n = 0; n < steps; ++n) {
      const std::uint64_t bits = tilepack::random_bits(seed, "step", n);
      const int x = static_cast<int>(bits % side);
      const int y = static_cast<int>(bits / side % side);
      const double left = 1.0 - static_cast<double>(n) / static_cast<double>(steps);
      const int before = corner[at(x, y)];
      const int by = 1 + static_cast<int>((bits >> 32) % static_cast<unsigned>(colors - 1));
      if (recolor(x, y, (before + by) % colors) > threshold * left * left) recolor(x, y, before);
      if ((n + 1) % (steps / 8) == 0) {
        std::fprintf(stderr, "%3.0f %%", 100 * (1 - left));
        for (const Windows& windows : all) windows.report();
        std::fprintf(stderr, "\n");
      }
    }
  }

  void print() const {
    for (int y = 0; y < side; ++y) {
      std::printf("    \"");
      for (int x = 0; x < side; ++x) std::printf("%d", corner[at(x, y)]);
      std::printf("\"\n");
    }
  }

private:
  int kind(int x, int y) const {
    return ((corner[at(x, y)] * colors + corner[at(x + 1, y)]) * colors + corner[at(x, y + 1)]) * colors +
           corner[at(x + 1, y + 1)];
  }

  /// What it costs more to give the corner this color, which is done.
  double recolor(int x, int y, int color) {
    corner[at(x, y)] = color;
    double more = 0;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) more += replace(x - i, y - j, kind(x - i, y - j));
    return more;
  }

  double replace(int x, int y, int now) {
    const int old = tile[at(x, y)];
    double more = 0;
    for (Windows& windows : all) {
      for (std::size_t l = 0; l < windows.lags.size(); ++l) {
        const auto& lag = windows.lags[l];
        const int ahead = tile[at(x + lag.dx, y + lag.dy)];
        const int behind = tile[at(x - lag.dx, y - lag.dy)];
        if (ahead == old || ahead == now) more += windows.pair(l, x, y, ahead == now ? 1 : -1);
        if (behind == old || behind == now)
          more += windows.pair(l, x - lag.dx, y - lag.dy, behind == now ? 1 : -1);
      }
      more += windows.show(x, y, old, -1) + windows.show(x, y, now, 1);
    }
    more -= side_by_side(x, y);
    tile[at(x, y)] = now;
    return more + side_by_side(x, y);
  }

  /// What equal neighbours cost, of those pairs and rows of three that the tile is part of.
  double side_by_side(int x, int y) const {
    double cost = 0;
    for (const bool down : {false, true}) {
      bool equal[4]; // of the tiles at -2 and -1, -1 and 0, 0 and 1, 1 and 2
      const auto beside = [&](int k) { return tile[down ? at(x, y + k) : at(x + k, y)]; };
      for (int k = 0; k < 4; ++k) equal[k] = beside(k - 2) == beside(k - 1);
      cost += pair_cost * (equal[1] + equal[2]);
      for (int k = 0; k < 3; ++k) cost += row_cost * (equal[k] && equal[k + 1]);
    }
    return cost;
  }

  int colors;
  std::uint64_t seed;
  std::vector<int> corner;
  std::vector<int> tile;
  std::vector<Windows> all;
};

} // namespace

int main(int argc, char** argv) {
  const int colors = argc > 1 ? std::atoi(argv[1]) : 2;
  const int sweeps = argc > 2 ? std::atoi(argv[2]) : 3000;
  Search search(colors, argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1,
                {{8, 2, 4, 4.0, 0.3}, {16, 4, 8, 4.0, 0.3}});
  search.run(sweeps, 0.3);
  search.print();
}
