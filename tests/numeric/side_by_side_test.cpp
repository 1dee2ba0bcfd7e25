#include "tilepack/numeric/side_by_side.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <vector>

using namespace tilepack;

TEST_CASE("what one piece of work throws ends no loop of another half-way", "[numeric]") {
  constexpr std::size_t pieces = 64;
  for (int round = 0; round < 20; ++round) {
    std::atomic<int> short_loops = 0, ended = 0;
    const auto work = [&](std::size_t piece) {
      if (piece % 7 == 3) throw std::runtime_error("piece " + std::to_string(piece));
      std::vector<int> results(2000, 0);
      tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t i) { results[i] = 1; });
      for (const int result : results)
        if (result == 0) {
          ++short_loops;
          break;
        }
      ++ended;
    };
    CHECK_THROWS_WITH(each_side_by_side(pieces, work), "piece 3"); // the first, whichever was faster
    CHECK(short_loops == 0);
    CHECK(ended == 64 - 9);
  }
}

TEST_CASE("two works that are not alike both run to their end", "[numeric]") {
  int first = 0;
  CHECK_THROWS_WITH(both_side_by_side([&] { first = 1; }, [] { throw std::runtime_error("second"); }),
                    "second");
  CHECK(first == 1);
  both_side_by_side([&] { first = 2; }, [] {});
  CHECK(first == 2);
}
