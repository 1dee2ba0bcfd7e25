#include "tilepack/error/error.h"
#include "tilepack/layout/rotated_scheme.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <set>

using namespace tilepack;

namespace {

bool has(const std::vector<RotatedScheme>& schemes, RotatedScheme wanted) {
  return std::find(schemes.begin(), schemes.end(), wanted) != schemes.end();
}

} // namespace

TEST_CASE("the table of Decaudin and Neyret 2004, figure 5, up to n = 11") {
  const std::vector<std::vector<int>> table{{1, 2},
                                            {4, 5, 8},
                                            {9, 10, 13, 18},
                                            {16, 17, 20, 25, 32},
                                            {25, 26, 29, 34, 41, 50},
                                            {36, 37, 40, 45, 52, 61, 72},
                                            {49, 50, 53, 58, 65, 74, 85, 98},
                                            {64, 65, 68, 73, 80, 89, 100, 113, 128},
                                            {81, 82, 85, 90, 97, 106, 117, 130, 145, 162},
                                            {100, 101, 104, 109, 116, 125, 136, 149, 164, 181, 200},
                                            {121, 122, 125, 130, 137, 146, 157, 170, 185, 202, 221, 242}};
  for (int n = 1; n <= 11; ++n)
    for (int k = 0; k <= n; ++k) {
      const int count = table[static_cast<std::size_t>(n - 1)][static_cast<std::size_t>(k)];
      CAPTURE(n, k, count);
      CHECK(has(rotated_schemes(count), {n, k, 1}));
    }
}

TEST_CASE("up to 200, products of schemes reach exactly the counts that have a scheme") {
  // Closure of the direct schemes under multiplication, as the paper builds it.
  std::set<int> reached{1};
  for (int n = 1; n <= 14; ++n)
    for (int k = 0; k <= n; ++k) reached.insert(n * n + k * k);
  for (bool grown = true; grown;) {
    grown = false;
    for (const int a : std::set<int>(reached))
      for (const int b : std::set<int>(reached))
        if (a * b <= 200) grown |= reached.insert(a * b).second;
  }
  for (int tiles = 1; tiles <= 200; ++tiles) {
    CAPTURE(tiles);
    const std::vector<RotatedScheme> schemes = rotated_schemes(tiles);
    CHECK(schemes.empty() != reached.contains(tiles));
    bool even_powers = true; // of primes that are 3 mod 4
    int rest = tiles;
    for (int p = 2; p <= rest; ++p) {
      int power = 0;
      for (; rest % p == 0; rest /= p) ++power;
      if (p % 4 == 3 && power % 2 == 1) even_powers = false;
    }
    CHECK(schemes.empty() != even_powers);
    for (const RotatedScheme& scheme : schemes) {
      CHECK(tile_count(scheme) == tiles);
      CHECK((scheme.k >= 0 && scheme.k <= scheme.n));
      const std::vector<int> nested = nested_counts(scheme);
      CHECK(std::accumulate(nested.begin(), nested.end(), 1, std::multiplies<>()) == tiles);
      CHECK(std::is_sorted(nested.begin(), nested.end()) == true);
    }
  }
}

TEST_CASE("a count that no scheme reaches is named with the next ones") {
  CHECK(reachable_counts(5) == ReachableCounts{5, 5});
  CHECK(reachable_counts(7) == ReachableCounts{5, 8});
  CHECK(reachable_counts(23) == ReachableCounts{20, 25});
  CHECK(reachable_counts(max_rotated_tiles - 1).above == max_rotated_tiles);
  CHECK_THROWS_AS(rotated_schemes(0), Error);
  CHECK_THROWS_AS(rotated_schemes(-5), Error);
  CHECK_THROWS_AS(reachable_counts(max_rotated_tiles + 1), Error);
}

TEST_CASE("twelve tiles have no scheme, eighteen have two") {
  CHECK(rotated_schemes(12).empty());
  const std::vector<RotatedScheme> schemes = rotated_schemes(18);
  REQUIRE(schemes.size() == 2);
  CHECK(schemes[0] == RotatedScheme{3, 3, 1});
  CHECK(schemes[1] == RotatedScheme{3, 0, 2});
  CHECK(formula(schemes[0]) == "3² + 3²");
  CHECK(formula(schemes[1]) == "2 × 3²");
  CHECK(formula({2, 1, 2}) == "2 × (2² + 1²)");
  CHECK(nested_counts(schemes[0]) == std::vector<int>{2, 9});
  CHECK(nested_counts({7, 1, 1}) == std::vector<int>{2, 5, 5});
}

TEST_CASE("angles are those of the arc tangent") {
  CHECK(angle_in_degrees({5, 0, 1}) == 0.0);
  CHECK(angle_in_degrees({1, 1, 1}) == Approx(45.0).epsilon(1e-15));
  CHECK(angle_in_degrees({2, 1, 1}) == Approx(26.565051177077989351).epsilon(1e-15));
  CHECK(angle_in_degrees({8, 1, 1}) == Approx(7.125016348901798).epsilon(1e-14));
  CHECK(angle_in_degrees({7, 6, 1}) == Approx(40.60129464500447).epsilon(1e-14));
}
