#pragma once

#include <cstddef>
#include <cstdint>

namespace tilepack {

/// How far past the last byte asked for the function below may read (never write). What lies there doesn't
/// matter.
constexpr std::size_t byte_row_slack = 64;

/// The sum of squared differences of two blocks of `rows` rows of `bytes` bytes; `stride` bytes from row to
/// row. Stops once the sum is at least `limit`, and returns what it has. The sum must stay below 2^31: bytes
/// * rows
/// <= 33'000.
int squared_difference_of_rows(const std::uint8_t* a, std::ptrdiff_t a_stride, const std::uint8_t* b,
                               std::ptrdiff_t b_stride, std::size_t bytes, int rows, int limit);

/// The sum of squared differences of two rows of `bytes` bytes, any number. Reads nothing past them.
std::int64_t squared_difference_of_bytes(const std::uint8_t* a, const std::uint8_t* b, std::size_t bytes);

} // namespace tilepack
