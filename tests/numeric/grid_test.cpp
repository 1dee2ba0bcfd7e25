#include "tilepack/numeric/grid.h"

#include <catch2/catch.hpp>
#include <numeric>

using namespace tilepack;

TEST_CASE("a grid holds its rows one after another") {
  Grid<int> grid(3, 2);
  REQUIRE(grid.values == std::vector<int>(6, 0));
  std::iota(grid.values.begin(), grid.values.end(), 0);
  CHECK(grid.at(2, 0) == 2);
  CHECK(grid.at(0, 1) == 3);
  CHECK(grid.index(1, 1) == 4);
  const Grid<int>& same = grid;
  CHECK(std::vector<int>(same.row(1).begin(), same.row(1).end()) == std::vector<int>{3, 4, 5});
  for (int& v : grid.row(0)) v = 7;
  CHECK(grid.values == std::vector<int>{7, 7, 7, 3, 4, 5});
  CHECK(grid.size() == Size{3, 2});
}

TEST_CASE("inside is what at() may be asked for") {
  const Grid<char> grid(Size{3, 2}, 'a');
  CHECK(grid.values == std::vector<char>(6, 'a'));
  CHECK(grid.inside(0, 0));
  CHECK(grid.inside(2, 1));
  CHECK_FALSE(grid.inside(3, 1));
  CHECK_FALSE(grid.inside(2, 2));
  CHECK_FALSE(grid.inside(-1, 0));
  CHECK_FALSE(grid.inside(0, -1));
  CHECK(Grid<char>().empty());
  CHECK_FALSE(Grid<char>().inside(0, 0));
}

TEST_CASE("a grid of more than 2^31 values is indexed without overflow") {
  Grid<int> grid;
  grid.width = 1 << 17;
  grid.height = 1 << 17;
  CHECK(grid.index(5, (1 << 17) - 1) == ((std::size_t{1} << 34) - (std::size_t{1} << 17) + 5));
}
