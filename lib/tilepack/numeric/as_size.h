#pragma once

#include <cstddef>

namespace tilepack {

/// A count or coordinate that is never negative, as the standard library counts.
constexpr std::size_t as_size(int i) {
  return static_cast<std::size_t>(i);
}

} // namespace tilepack
