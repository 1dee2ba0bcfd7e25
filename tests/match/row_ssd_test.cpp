#include "tilepack/match/row_ssd.h"
#include "tilepack/numeric/random.h"

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

TEST_CASE("rows of any length are compared as by the plain sum, and nothing past them is read") {
  for (const std::size_t width : {0, 1, 63, 64, 65, 127, 128, 1000, 32'768, 70'001}) {
    std::vector<std::uint8_t> a = bytes(width, 5), b = bytes(width, 6);
    a.resize(width); // so that sanitizers see what is read past them
    b.resize(width);
    a.shrink_to_fit();
    b.shrink_to_fit();
    INFO(width << " bytes");
    CHECK(squared_difference_of_bytes(a.data(), b.data(), width) ==
          plain_difference(a.data(), b.data(), width));
  }
  const std::vector<std::uint8_t> black(40'000, 0), white(40'000, 255); // more than 31 bits
  CHECK(squared_difference_of_bytes(black.data(), white.data(), 40'000) == std::int64_t{40'000} * 255 * 255);
}
