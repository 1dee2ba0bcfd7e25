// Searches for the patterns of lib/mapping/even_pattern.cpp and prints one as C++.
//
//   even_pattern_search [COLORS [SWEEPS [SEED]]]      the patterns: 110 sweeps, some minutes
//
// A pattern is a torus of corner colors. Wherever one looks at it through a window of 8 x 8 or 16 x 16 tiles,
// no displacement should bring many tiles onto equal ones, and all tiles should be shown about equally often.
// One corner after the other is recolored at random; what worsens the sum below by more than a threshold,
// which falls to nothing, is taken back.

#include "tilepack/tileset/random.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

constexpr int side = 64;
constexpr double pi = 3.14159265358979323846;
constexpr double balance = 0.001; // weight of uneven counts

struct Lag {
  int dx, dy;
  double norm; // one over the sum of the weights of all pairs this far apart
};

/// Windows of one size at every `stride`-th tile. Tiles at a window's middle count more: whoever looks at a
/// repeat looks at both places at once.
struct Scale {
  int window, stride, farthest;
  double importance;
  std::vector<double> weight;
  std::vector<Lag> lags;
  std::vector<double> equal; ///< window, lag: share of equal pairs
  std::vector<double> share; ///< window, tile: how often it is shown, 1 is fair
  double even = 0;           ///< one over the sum of weights
  int windows() const { return side / stride; }
};

class Search {
public:
  Search(int color_count, std::uint64_t random_seed)
      : colors(color_count), tiles(colors * colors * colors * colors), seed(random_seed), corner(side * side),
        tile(side * side) {
    for (std::size_t i = 0; i < corner.size(); ++i)
      corner[i] = static_cast<int>(tilepack::random_below(seed, "corner", i, static_cast<unsigned>(colors)));
    scales.push_back(scale(8, 2, 4, 0.25));
    scales.push_back(scale(16, 8, 8, 1.2));
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) tile[at(x, y)] = id(x, y);
    for (Scale& s : scales) count(s);
  }

  void run(int sweeps) {
    const auto steps = static_cast<std::uint64_t>(sweeps) * corner.size();
    std::uint64_t taken = 0;
    for (std::uint64_t n = 0; n < steps; ++n) {
      const std::uint64_t bits = tilepack::random_bits(seed, "step", n);
      const int x = static_cast<int>(bits % side);
      const int y = static_cast<int>(bits / side % side);
      const double left = 1.0 - static_cast<double>(n) / static_cast<double>(steps);
      taken += recolored(x, y, 1 + static_cast<int>((bits >> 32) % static_cast<unsigned>(colors - 1)),
                         0.008 * left * left * left);
      if ((n + 1) % (steps / 8) == 0)
        std::fprintf(stderr, "%3.0f %%: %.4f, %llu steps taken\n", 100 * (1 - left), energy(),
                     static_cast<unsigned long long>(taken));
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
  static std::size_t at(int x, int y) {
    return static_cast<std::size_t>((y & (side - 1)) * side + (x & (side - 1)));
  }
  int id(int x, int y) const {
    return ((corner[at(x, y)] * colors + corner[at(x + 1, y)]) * colors + corner[at(x, y + 1)]) * colors +
           corner[at(x + 1, y + 1)];
  }

  Scale scale(int window, int stride, int farthest, double importance) const {
    Scale s{window, stride, farthest, importance, {}, {}, {}, {}};
    double total = 0;
    for (int i = 0; i < window; ++i) {
      s.weight.push_back(0.5 - 0.5 * std::cos(2 * pi * (i + 0.5) / window));
      total += s.weight.back();
    }
    s.even = 1 / (total * total);
    for (int dy = 0; dy <= farthest; ++dy)
      for (int dx = -farthest; dx <= farthest; ++dx) {
        if (dy == 0 && dx <= 0) continue;
        double sum = 0;
        for (int y = 0; y + dy < window; ++y)
          for (int x = std::max(0, -dx); x < window - std::max(0, dx); ++x)
            sum += s.weight[y] * s.weight[x] * s.weight[y + dy] * s.weight[x + dx];
        s.lags.push_back({dx, dy, 1 / sum});
      }
    const auto all = static_cast<std::size_t>(s.windows() * s.windows());
    s.equal.assign(all * s.lags.size(), 0.0);
    s.share.assign(all * static_cast<std::size_t>(tiles), 0.0);
    return s;
  }

  void count(Scale& s) {
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        for (std::size_t l = 0; l < s.lags.size(); ++l)
          if (tile[at(x, y)] == tile[at(x + s.lags[l].dx, y + s.lags[l].dy)]) pair(s, x, y, l, 1);
        show(s, x, y, tile[at(x, y)], 1);
      }
  }

  template <typename Visit>
  static void windows_with(const Scale& s, int first_x, int last_x, int first_y, int last_y, Visit visit) {
    for (int wy = first_y; wy <= last_y; ++wy) {
      if (wy & (s.stride - 1)) continue;
      for (int wx = first_x; wx <= last_x; ++wx)
        if (!(wx & (s.stride - 1)))
          visit(static_cast<std::size_t>((wy & (side - 1)) / s.stride * s.windows() +
                                         (wx & (side - 1)) / s.stride),
                wx, wy);
    }
  }

  double change(std::vector<double>& values, std::size_t i, double by) {
    undo.push_back({&values[i], values[i]});
    const double before = values[i];
    values[i] = before + by;
    return before;
  }

  double pair(Scale& s, int x, int y, std::size_t l, int sign) {
    const Lag& lag = s.lags[l];
    double more = 0;
    windows_with(s, std::max(x, x + lag.dx) - s.window + 1, std::min(x, x + lag.dx),
                 y + lag.dy - s.window + 1, y, [&](std::size_t w, int wx, int wy) {
                   const double by = sign * lag.norm * s.weight[y - wy] * s.weight[y + lag.dy - wy] *
                                     s.weight[x - wx] * s.weight[x + lag.dx - wx];
                   const double before = change(s.equal, w * s.lags.size() + l, by);
                   const double a = before * before, b = (before + by) * (before + by);
                   more += b * b - a * a;
                 });
    return s.importance * more;
  }

  double show(Scale& s, int x, int y, int which, int sign) {
    double more = 0;
    windows_with(s, x - s.window + 1, x, y - s.window + 1, y, [&](std::size_t w, int wx, int wy) {
      const double by = sign * tiles * s.even * s.weight[y - wy] * s.weight[x - wx];
      const double before =
          change(s.share, w * static_cast<std::size_t>(tiles) + static_cast<std::size_t>(which), by);
      more += (before + by - 1) * (before + by - 1) - (before - 1) * (before - 1);
    });
    return balance * s.importance * more * 16 / tiles;
  }

  double replace(int x, int y, int now) {
    const int old = tile[at(x, y)];
    if (old == now) return 0;
    double more = 0;
    for (Scale& s : scales) {
      for (std::size_t l = 0; l < s.lags.size(); ++l) {
        const Lag& lag = s.lags[l];
        const int ahead = tile[at(x + lag.dx, y + lag.dy)];
        const int behind = tile[at(x - lag.dx, y - lag.dy)];
        if (ahead == old || ahead == now) more += pair(s, x, y, l, ahead == now ? 1 : -1);
        if (behind == old || behind == now)
          more += pair(s, x - lag.dx, y - lag.dy, l, behind == now ? 1 : -1);
      }
      more += show(s, x, y, old, -1) + show(s, x, y, now, 1);
    }
    tile[at(x, y)] = now;
    return more;
  }

  bool recolored(int x, int y, int by, double threshold) {
    undo.clear();
    const int before = corner[at(x, y)];
    int tiles_before[2][2];
    corner[at(x, y)] = (before + by) % colors;
    double more = 0;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        tiles_before[j][i] = tile[at(x - i, y - j)];
        more += replace(x - i, y - j, id(x - i, y - j));
      }
    if (more < threshold) return true;
    corner[at(x, y)] = before;
    for (std::size_t u = undo.size(); u-- > 0;) *undo[u].value = undo[u].before;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) tile[at(x - i, y - j)] = tiles_before[j][i];
    return false;
  }

  double energy() const {
    double sum = 0;
    for (const Scale& s : scales) {
      double worst = 0, uneven = 0;
      for (const double e : s.equal) {
        sum += s.importance * e * e * e * e * e * e;
        worst = std::max(worst, e);
      }
      for (const double v : s.share) uneven += (v - 1) * (v - 1);
      sum += balance * s.importance * uneven * 16 / tiles;
      std::fprintf(stderr, "[worst %.3f uneven %.3f] ", worst,
                   std::sqrt(uneven / static_cast<double>(s.share.size())));
    }
    return sum;
  }

  struct Change {
    double* value;
    double before;
  };
  int colors;
  int tiles;
  std::uint64_t seed;
  std::vector<int> corner;
  std::vector<int> tile;
  std::vector<Scale> scales;
  std::vector<Change> undo;
};

} // namespace

int main(int argc, char** argv) {
  const int colors = argc > 1 ? std::atoi(argv[1]) : 2;
  const int sweeps = argc > 2 ? std::atoi(argv[2]) : 110;
  Search search(colors, argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 2);
  search.run(sweeps);
  search.print();
}
