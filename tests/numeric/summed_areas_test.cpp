#include "tilepack/numeric/random.h"
#include "tilepack/numeric/summed_areas.h"

#include <catch2/catch.hpp>
#include <cstdint>

using namespace tilepack;

namespace {

Grid<int> numbers(int width, int height) {
  Grid<int> grid(width, height);
  for (std::size_t i = 0; i < grid.values.size(); ++i)
    grid.values[i] = static_cast<int>(random_below(5, "number", i, 2001)) - 1000;
  return grid;
}

} // namespace

TEST_CASE("every rectangle's sum is that of its values, of what lies inside") {
  const Grid<int> grid = numbers(7, 5);
  const SummedAreas<std::int64_t> areas(grid);
  const SummedAreas<double> in_double(7, 5, [&](int x, int y) { return grid.at(x, y); });
  for (int y = -2; y < 7; ++y)
    for (int x = -2; x < 9; ++x)
      for (int height = 0; height < 9; ++height)
        for (int width = 0; width < 11; ++width) {
          std::int64_t sum = 0;
          int count = 0;
          for (int j = y; j < y + height; ++j)
            for (int i = x; i < x + width; ++i)
              if (grid.inside(i, j)) {
                sum += grid.at(i, j);
                ++count;
              }
          const Rect area{x, y, width, height};
          REQUIRE(areas.sum(area) == sum);
          REQUIRE(in_double.sum(area) == static_cast<double>(sum));
          REQUIRE(areas.mean(area) == (count > 0 ? static_cast<double>(sum) / count : 0.0));
          const Rect inside = areas.inside(area);
          REQUIRE(inside.width * inside.height == count);
        }
}

TEST_CASE("the sum of all is that of the whole rectangle") {
  const SummedAreas<std::int64_t> areas(numbers(40, 30));
  CHECK(areas.width() == 40);
  CHECK(areas.height() == 30);
  CHECK(areas.sum() == areas.sum({0, 0, 40, 30}));
  CHECK(areas.mean() == Approx(static_cast<double>(areas.sum()) / 1200).epsilon(1e-15));
}

TEST_CASE("a table of nothing gives nothing") {
  const SummedAreas<double> none;
  CHECK(none.width() == 0);
  CHECK(none.sum() == 0.0);
  CHECK(none.sum({0, 0, 3, 3}) == 0.0);
  CHECK(none.mean() == 0.0);
}
