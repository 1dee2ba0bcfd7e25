#include "tilepack/mapping/even_variants.h"

#include "tilepack/mapping/even_pattern.h"
#include "tilepack/numeric/random.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace tilepack {
namespace {

constexpr int side = even_pattern_side;
constexpr int cells = side * side;
constexpr int window = 8;   // tiles that the eye takes in at once
constexpr int stride = 2;   // from one window to the next
constexpr int farthest = 4; // displacement
constexpr int windows_across = side / stride;
constexpr int sweeps = 30;

// What a pair of tiles with equal colors counts, of 10: its frame; and besides if its variants are equal too.
constexpr int equal_colors = 3;
constexpr int equal_tiles = 7;

// Shares are counted in 1/1024, and their fourth powers summed.
constexpr int share_bits = 10;
constexpr int norm_bits = 32;
constexpr std::int64_t side_by_side = std::int64_t{1} << 36; // as much as a share of a half
constexpr std::int64_t uneven = std::int64_t{1}
                                << 27; // of the square of how often a tile stands in the pattern
constexpr std::int64_t first_threshold = std::int64_t{1} << 33;

// Of the places of a window along one axis, those at the middle more: whoever sees a repeat looks at both places at
// once. 32 times the squared sine at the places' middles.
constexpr std::array<int, window> weights{1, 10, 22, 31, 31, 22, 10, 1};

int wrapped_cell(int x, int y) {
  return (y & (side - 1)) * side + (x & (side - 1));
}

struct Lag {
  int dx = 0, dy = 0;
  std::int64_t norm = 0; // of a sum of weights, to a share in 2^-(share_bits + norm_bits)
};

// Two cells of equal colors a lag apart; (x, y) the one that the lag leads away from.
struct Pair {
  int lag = 0;
  int x = 0, y = 0;
  int other = 0;
};

class Search {
public:
  Search(const std::vector<int>& pattern, int colors, int count)
      : variants(count), tile(cells), chosen(cells), pairs(cells) {
    const auto corner = [&](int x, int y) { return pattern[static_cast<std::size_t>(wrapped_cell(x, y))]; };
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        tile[index(wrapped_cell(x, y))] =
            ((corner(x, y) * colors + corner(x + 1, y)) * colors + corner(x, y + 1)) * colors +
            corner(x + 1, y + 1);
    for (int i = 0; i < cells; ++i)
      chosen[index(i)] = static_cast<int>(random_below(0, "even variant", static_cast<std::uint64_t>(i),
                                                       static_cast<std::uint32_t>(variants)));
    times.assign(index(colors * colors * colors * colors * variants), 0);
    for (int i = 0; i < cells; ++i) ++times[index(tile[index(i)] * variants + chosen[index(i)])];
    for (int dy = 0; dy <= farthest; ++dy)
      for (int dx = -farthest; dx <= farthest; ++dx)
        if (dy > 0 || dx > 0)
          lags.push_back(
              {dx, dy,
               (std::int64_t{1} << (share_bits + norm_bits)) /
                   (std::int64_t{total(std::abs(dx))} * total(dy) * (equal_colors + equal_tiles))});
    shown.assign(lags.size() * windows_across * windows_across, 0);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        for (int l = 0; l < static_cast<int>(lags.size()); ++l) {
          const int here = wrapped_cell(x, y);
          const int there = wrapped_cell(x + lags[index(l)].dx, y + lags[index(l)].dy);
          if (tile[index(here)] != tile[index(there)]) continue;
          pairs[index(here)].push_back({l, x, y, there});
          pairs[index(there)].push_back({l, x, y, here});
          count_pair({l, x, y, there}, equal_colors);
          if (chosen[index(here)] == chosen[index(there)]) count_pair({l, x, y, there}, equal_tiles);
        }
  }

  std::vector<int> run() {
    constexpr std::uint64_t steps = std::uint64_t{sweeps} * cells;
    for (std::uint64_t n = 0; n < steps; ++n) {
      const std::uint64_t bits = random_bits(0, "even variant step", n);
      const int cell = static_cast<int>(bits % cells);
      const int before = chosen[index(cell)];
      const int by = 1 + static_cast<int>((bits >> 32) % static_cast<std::uint64_t>(variants - 1));
      const auto left = static_cast<std::int64_t>((steps - n) * 256 / steps);
      if (change(cell, (before + by) % variants) > (first_threshold >> 16) * left * left)
        change(cell, before);
    }
    return chosen;
  }

private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  // The sum of the weights of all pairs this far apart along one axis.
  static int total(int distance) {
    int sum = 0;
    for (int i = 0; i + distance < window; ++i) sum += weights[index(i)] * weights[index(i + distance)];
    return sum;
  }

  // What giving the cell this variant costs more, which is done.
  std::int64_t change(int cell, int variant) {
    const int old = chosen[index(cell)];
    std::int32_t& before = times[index(tile[index(cell)] * variants + old)];
    std::int32_t& now = times[index(tile[index(cell)] * variants + variant)];
    std::int64_t more = uneven * 2 * (now - before + 1);
    --before;
    ++now;
    for (const Pair& pair : pairs[index(cell)]) {
      const int other = chosen[index(pair.other)];
      if (other == old) more += count_pair(pair, -equal_tiles);
      if (other == variant) more += count_pair(pair, equal_tiles);
    }
    chosen[index(cell)] = variant;
    return more;
  }

  // Counts a pair in every window that holds both its cells; what that costs more.
  std::int64_t count_pair(const Pair& pair, int points) {
    const Lag& lag = lags[index(pair.lag)];
    const int across = std::abs(lag.dx), down = lag.dy;
    const int west = std::min(pair.x, pair.x + lag.dx);
    std::int32_t* windows = &shown[index(pair.lag) * windows_across * windows_across];
    std::int64_t more = across + down == 1 ? (points == equal_tiles ? side_by_side : -side_by_side) : 0;
    for (int j = pair.y & (stride - 1); j + down < window; j += stride) {
      const int row = ((pair.y - j) & (side - 1)) / stride * windows_across;
      for (int i = west & (stride - 1); i + across < window; i += stride) {
        std::int32_t& sum = windows[row + ((west - i) & (side - 1)) / stride];
        more -= cost(sum, lag);
        sum += points * weights[index(i)] * weights[index(i + across)] * weights[index(j)] *
               weights[index(j + down)];
        more += cost(sum, lag);
      }
    }
    return more;
  }

  static std::int64_t cost(std::int32_t sum, const Lag& lag) {
    const std::int64_t share = (sum * lag.norm) >> norm_bits;
    return share * share * share * share;
  }

  int variants;
  std::vector<int> tile;                // by cell: its colors as one number
  std::vector<int> chosen;              // by cell: its variant
  std::vector<std::vector<Pair>> pairs; // by cell: all it is one of
  std::vector<Lag> lags;
  std::vector<std::int32_t> shown; // by lag and window: weighed points of equal pairs
  std::vector<std::int32_t> times; // by colors and variant: cells
};

} // namespace

std::vector<int> even_variants(const std::vector<int>& pattern, int colors, int variants) {
  if (variants <= 1) return std::vector<int>(cells, 0);
  return Search(pattern, colors, variants).run();
}

} // namespace tilepack
