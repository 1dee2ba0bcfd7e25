#pragma once

#include <cstddef>

namespace tilepack {

/// What every reader of JSON refuses: deeper levels, so that a hostile file can't overflow the stack.
constexpr int deepest_nesting = 32;

/// Bytes of a value or name of a file that a message shows; the rest is cut off.
constexpr std::size_t longest_shown = 48;

} // namespace tilepack
