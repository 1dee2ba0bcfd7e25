#pragma once

#include <cstdint>

namespace tilepack {

/// i modulo n in 0..n-1 for any i, negative too; n > 0.
constexpr std::int64_t wrapped(std::int64_t i, std::int64_t n) {
  const std::int64_t r = i % n;
  return r < 0 ? r + n : r;
}
constexpr int wrapped(int i, int n) {
  const int r = i % n;
  return r < 0 ? r + n : r;
}

} // namespace tilepack
