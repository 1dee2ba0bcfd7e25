#pragma once

#include "tilepack/tileset/limits.h"

#include <cstdint>

namespace tilepack {

/// The side of the largest square index map whose side is a power of two, for messages: what fits.
constexpr std::int64_t largest_index_square() {
  std::int64_t side = 1;
  while (2 * side <= limits::longest_index_side && 4 * side * side <= limits::most_index_cells) side *= 2;
  return side;
}

} // namespace tilepack
