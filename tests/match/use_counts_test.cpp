#include "tilepack/match/use_counts.h"

#include <catch2/catch.hpp>
#include <utility>

using namespace tilepack;

TEST_CASE("uses are the mean over areas, those partly outside too") {
  UseCounts counts(10, 6, 2);
  CHECK(prepared(counts).mean() == 0.0);
  counts.add({0, 0, 4, 4}, 3.0);
  counts.add({2, 2, 2, 2}, -1.0);
  counts.add({-5, -5, 7, 7}, 1.0);
  const UseTable uses = prepared(counts);
  CHECK(uses.mean({0, 0, 2, 2}) == 4.0);
  CHECK(uses.mean({2, 2, 2, 2}) == 2.0);
  CHECK(uses.mean({0, 0, 4, 4}) == Approx((4.0 + 3.0 + 3.0 + 2.0) / 4.0));
  CHECK(uses.mean({8, 4, 50, 50}) == 0.0);
  CHECK(uses.mean() == Approx(12.0 / 15.0));
}

TEST_CASE("areas are rounded to the squares of which they hold half, one at least") {
  const UseCounts none(12, 8, 4);
  UseCounts counts = none;
  counts.add({1, 0, 5, 4}, 1.0); // 1..5: three of four columns of the first square, two of the second
  CHECK(prepared(counts).mean({0, 0, 4, 4}) == 1.0);
  CHECK(prepared(counts).mean({4, 0, 4, 4}) == 1.0);
  CHECK(prepared(counts).mean({8, 0, 4, 4}) == 0.0);
  counts = none;
  counts.add({2, 0, 3, 1}, 1.0); // 2..4: one column of the second square, where its start is rounded to
  CHECK(prepared(counts).mean({4, 0, 4, 4}) == 1.0);
  CHECK(prepared(counts).mean() == Approx(1.0 / 6.0));
  counts = none;
  counts.add({100, 100, 1, 1}, 1.0); // outside: the nearest square
  CHECK(prepared(counts).mean({8, 4, 4, 4}) == 1.0);
}

TEST_CASE("a table holds the state of the moment at which it was prepared") {
  UseCounts counts(4, 4);
  counts.add({0, 0, 2, 2}, 1.0);
  const UseTable before = prepared(counts);
  counts.add({0, 0, 2, 2}, 1.0);
  CHECK(before.mean({0, 0, 2, 2}) == 1.0);
  CHECK(prepared(counts).mean({0, 0, 2, 2}) == 2.0);
}

TEST_CASE("what is added to an area counts as often as its reuse weight says, and only what comes after it") {
  UseCounts counts(10, 6, 2);
  counts.add({0, 0, 4, 2}, 1.0);
  counts.set_reuse_weight({2, 0, 2, 2}, 7);
  counts.add({0, 0, 4, 2}, 2.0);
  counts.add({0, 0, 4, 2}, -1.0);
  const UseTable uses = prepared(counts);
  CHECK(uses.mean({0, 0, 2, 2}) == 2.0);
  CHECK(uses.mean({2, 0, 2, 2}) == 8.0);
}

TEST_CASE("a texel counts its square once, as often as the reuse weight says") {
  UseCounts one(23, 17, 4), other(23, 17, 4);
  for (UseCounts* counts : {&one, &other}) counts->set_reuse_weight({4, 4, 8, 8}, 3);
  for (const auto& [x, y] : {std::pair{0, 0}, {3, 3}, {4, 7}, {22, 16}, {11, 11}}) {
    one.add_texel(x, y);
    other.add({x / 4 * 4, y / 4 * 4, 4, 4}, 1.0);
  }
  for (int y = 0; y < 17; y += 4)
    for (int x = 0; x < 23; x += 4)
      CHECK(prepared(one).mean({x, y, 4, 4}) == prepared(other).mean({x, y, 4, 4}));
}
