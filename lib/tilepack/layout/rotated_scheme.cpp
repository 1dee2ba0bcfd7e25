#include "tilepack/layout/rotated_scheme.h"

#include "tilepack/error/error.h"
#include "tilepack/numeric/exact_math.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

int square_root(int x) {
  int root = static_cast<int>(std::sqrt(static_cast<double>(x)));
  while (root * root > x) --root;
  while ((root + 1) * (root + 1) <= x) ++root;
  return root;
}

void check_count(int tiles) {
  if (tiles < 1 || tiles > max_rotated_tiles)
    throw Error(ErrorKind::usage, "layout rotated",
                fmt::format("{} tiles; 1 to {} can be laid out", tiles, max_rotated_tiles));
}

} // namespace

std::vector<RotatedScheme> rotated_schemes(int tiles) {
  check_count(tiles);
  std::vector<RotatedScheme> schemes;
  for (const int squares : {1, 2}) {
    if (tiles % squares != 0) continue;
    const int each = tiles / squares;
    for (int n = square_root(each); 2 * n * n >= each; --n) {
      const int k = square_root(each - n * n);
      if (k * k == each - n * n) schemes.push_back({n, k, squares});
    }
  }
  return schemes;
}

ReachableCounts reachable_counts(int tiles) {
  check_count(tiles);
  ReachableCounts counts{tiles, tiles};
  while (rotated_schemes(counts.below).empty()) --counts.below; // 1 and 65536 = 256² are reachable
  while (rotated_schemes(counts.above).empty()) ++counts.above;
  return counts;
}

// The complex number n + ki splits into primes: 1 + i (2 tiles), one of norm p for each prime p = 1 mod 4,
// and each prime p = 3 mod 4 itself (p² tiles).
std::vector<int> nested_counts(const RotatedScheme& scheme) {
  std::vector<int> counts;
  int rest = tile_count(scheme);
  for (int p = 2; p <= rest; ++p)
    while (rest % p == 0) {
      const int count = p % 4 == 3 ? p * p : p;
      counts.push_back(count);
      rest /= count;
    }
  if (counts.empty()) counts.push_back(1);
  std::sort(counts.begin(), counts.end());
  return counts;
}

std::string formula(const RotatedScheme& scheme) {
  const std::string sum =
      scheme.k == 0 ? fmt::format("{}²", scheme.n) : fmt::format("{}² + {}²", scheme.n, scheme.k);
  if (scheme.squares == 1) return sum;
  return scheme.k == 0 ? fmt::format("2 × {}", sum) : fmt::format("2 × ({})", sum);
}

double angle_in_degrees(const RotatedScheme& scheme) {
  return exact_arctangent_in_degrees(static_cast<double>(scheme.k) / static_cast<double>(scheme.n));
}

} // namespace tilepack
