#include "tilepack/layout/rotated_lattice.h"

#include "tilepack/numeric/wrap.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tilepack {
namespace {

struct Divided {
  std::int64_t quotient;
  std::int64_t rest; // 0 <= rest < divisor
};

Divided divided(std::int64_t a, std::int64_t divisor) {
  const std::int64_t rest = wrapped(a, divisor);
  return {(a - rest) / divisor, rest};
}

} // namespace

// With m = n² + k² and `squares` s, the step (a, b) ends at
//
//   u = (n a - k b) / (s m) of the width,   v = (k a + n b) / m of the height.
//
// Two steps lead to one place if their numerators agree modulo s m and m.
RotatedLattice::RotatedLattice(const RotatedScheme& of_scheme) : scheme(of_scheme) {
  const int m = scheme.n * scheme.n + scheme.k * scheme.k;
  column_count = scheme.squares * m;
  row_count = m;
  // With g = gcd(n, k), steps east return to the start after s m / g of them, and g rows of these (m / g
  // steps for one square) hold every site once. Going on until N are found spares the case distinction.
  std::vector<std::pair<std::int64_t, LatticeStep>> found;
  for (std::int64_t south = 0; static_cast<int>(found.size()) < tile_count(scheme); ++south) {
    const std::int64_t first = key({0, south});
    const auto known = [&](std::int64_t k) {
      return std::any_of(found.begin(), found.end(), [&](const auto& f) { return f.first == k; });
    };
    if (known(first)) continue;
    std::int64_t east = 0;
    do {
      found.push_back({key({east, south}), {east, south}});
      ++east;
    } while (key({east, south}) != first);
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [k, step] : found) {
    keys.push_back(k);
    steps.push_back(step);
  }
}

std::int64_t RotatedLattice::key(LatticeStep step) const {
  const std::int64_t column =
      wrapped(scheme.n * step.east - scheme.k * step.south, static_cast<std::int64_t>(column_count));
  const std::int64_t row =
      wrapped(scheme.k * step.east + scheme.n * step.south, static_cast<std::int64_t>(row_count));
  return row * column_count + column;
}

int RotatedLattice::site_at(LatticeStep step) const {
  return static_cast<int>(std::lower_bound(keys.begin(), keys.end(), key(step)) - keys.begin());
}

Cell RotatedLattice::cell_of(int site) const {
  const std::int64_t k = keys[static_cast<std::size_t>(site)];
  return {0, static_cast<int>(k % column_count), static_cast<int>(k / column_count)};
}

int RotatedLattice::site_with(int column, int row) const {
  if (column < 0 || column >= column_count || row < 0 || row >= row_count) return -1;
  const std::int64_t wanted = static_cast<std::int64_t>(row) * column_count + column;
  const auto at = std::lower_bound(keys.begin(), keys.end(), wanted);
  return at != keys.end() && *at == wanted ? static_cast<int>(at - keys.begin()) : -1;
}

int RotatedLattice::neighbour(int site, int east, int south) const {
  const LatticeStep step = step_to(site);
  return site_at({step.east + east, step.south + south});
}

// Inverting the step's end: a = n s u + k v, b = -k s u + n v, with u = (2x + 1) / 2W and v = (2y + 1) / 2H.
RotatedLattice::Owner RotatedLattice::owner_of(Size texture, int texel_x, int texel_y) const {
  const std::int64_t whole = 2LL * texture.width * texture.height;
  const std::int64_t u = (2LL * texel_x + 1) * texture.height * scheme.squares;
  const std::int64_t v = (2LL * texel_y + 1) * texture.width;
  const Divided a = divided(scheme.n * u + scheme.k * v, whole);
  const Divided b = divided(scheme.n * v - scheme.k * u, whole);
  return {site_at({a.quotient, b.quotient}), static_cast<double>(a.rest) / static_cast<double>(whole),
          static_cast<double>(b.rest) / static_cast<double>(whole)};
}

} // namespace tilepack
