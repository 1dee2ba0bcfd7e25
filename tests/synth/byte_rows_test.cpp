#include "tilepack/synth/byte_rows.h"
#include "tilepack/tileset/random.h"

#include <catch2/catch.hpp>
#include <limits>
#include <vector>

using namespace tilepack;

namespace {

// Bytes of all values, the extremes often.
std::vector<std::uint8_t> bytes(std::size_t count, std::uint64_t seed) {
  std::vector<std::uint8_t> result;
  for (std::size_t i = 0; i < count + byte_row_slack; ++i) {
    const auto value = static_cast<std::uint8_t>(random_below(seed, "byte", i, 256));
    result.push_back(i % 3 == 0 ? static_cast<std::uint8_t>(value < 128 ? 0 : 255) : value);
  }
  return result;
}

std::int64_t plain_difference(const std::uint8_t* a, const std::uint8_t* b, std::size_t count) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

} // namespace

TEST_CASE("blocks of bytes are compared as by the plain sum, for every width") {
  for (std::size_t width = 1; width <= 150; ++width) {
    const int rows = 1 + static_cast<int>(width % 8);
    const std::size_t a_stride = width + 3;
    const std::size_t b_stride = width + 11;
    const auto a = bytes(a_stride * static_cast<std::size_t>(rows), width);
    const auto b = bytes(b_stride * static_cast<std::size_t>(rows), width + 1000);
    std::int64_t expected = 0;
    for (std::size_t y = 0; y < static_cast<std::size_t>(rows); ++y)
      expected += plain_difference(a.data() + y * a_stride, b.data() + y * b_stride, width);
    const auto difference = [&](int limit) {
      return squared_difference_of_rows(a.data(), static_cast<std::ptrdiff_t>(a_stride), b.data(),
                                        static_cast<std::ptrdiff_t>(b_stride), width, rows, limit);
    };
    INFO(width << " bytes, " << rows << " rows");
    CHECK(difference(std::numeric_limits<int>::max()) == expected);
    // With a limit: the truth where it is below, and something that is not below elsewhere.
    CHECK(difference(static_cast<int>(expected) + 1) == expected);
    CHECK(difference(static_cast<int>(expected / 2)) >= expected / 2);
  }
}

TEST_CASE("runs laid along a row are compared as by the plain sum, however long they are") {
  const auto image = bytes(200'000, 1);
  const auto values = bytes(70'000, 2);
  const std::vector<ByteRun> runs{{values.data(), 21, 0},
                                  {values.data() + 21, 64, 500},
                                  {values.data() + 100, 1, 7},
                                  {values.data() + 101, 0, 0},
                                  {values.data(), 70'000, 40'000}};
  for (const std::ptrdiff_t step : {1, 3, 12}) {
    std::vector<std::int64_t> sums(40);
    squared_differences_along(image.data(), step, runs, sums);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      std::int64_t expected = 0;
      for (const ByteRun& run : runs)
        expected += plain_difference(
            run.values, image.data() + static_cast<std::ptrdiff_t>(i) * step + run.offset, run.count);
      INFO("step " << step << ", place " << i);
      CHECK(sums[i] == expected);
    }
  }
}

TEST_CASE("sums of the largest differences do not overflow") {
  const std::vector<std::uint8_t> none(100'000 + byte_row_slack, 0);
  const std::vector<std::uint8_t> full(100'000 + byte_row_slack, 255);
  const std::vector<ByteRun> runs{{none.data(), 100'000, 0}};
  std::vector<std::int64_t> sum(1);
  squared_differences_along(full.data(), 1, runs, sum);
  CHECK(sum[0] == 255LL * 255 * 100'000);
}
