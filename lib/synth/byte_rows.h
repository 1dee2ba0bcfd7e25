#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tilepack {

/// How far past the last byte asked for the functions below may read (never write). What lies there doesn't
/// matter.
constexpr std::size_t byte_row_slack = 64;

/// The sum of squared differences of two blocks of `rows` rows of `bytes` bytes; `stride` bytes from row to
/// row. Stops once the sum is at least `limit`, and returns what it has. The sum must stay below 2^31: bytes
/// * rows
/// <= 33'000.
int squared_difference_of_rows(const std::uint8_t* a, std::ptrdiff_t a_stride, const std::uint8_t* b,
                               std::ptrdiff_t b_stride, std::size_t bytes, int rows, int limit);

/// Bytes that are compared with those at `offset` from some place.
struct ByteRun {
  const std::uint8_t* values = nullptr;
  std::size_t count = 0;
  std::ptrdiff_t offset = 0;
};

/// For i in 0..sums.size() - 1: the sum of squared differences of all runs laid at first + i * step.
void squared_differences_along(const std::uint8_t* first, std::ptrdiff_t step, std::span<const ByteRun> runs,
                               std::span<std::int64_t> sums);

} // namespace tilepack
