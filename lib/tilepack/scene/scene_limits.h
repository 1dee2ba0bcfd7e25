#pragma once

#include <cstddef>

namespace tilepack::scene_limits {

/// What a scene file may ask for. Beyond them an error says so before memory is taken.
constexpr double most_cells = 2147483648.0; ///< a side of a grid; nothing of it is stored
constexpr double most_texels =
    4503599627370496.0;                 ///< a side of the texture, 2^52: places keep their fractions
constexpr double most_indices = 65536;  ///< patterns, materials, frames
constexpr double longest_table = 65536; ///< of a permutation
constexpr double most_stored_cells = 268435456.0; ///< of a map that is stored, 2^28
constexpr std::size_t most_nodes = 4096;
constexpr std::size_t most_maps = 16;
constexpr std::size_t most_listed = 65536;          ///< entries of a list
constexpr std::size_t most_written_cells = 1 << 20; ///< of a map written as rows of numbers
constexpr std::size_t longest_path = 4096;
constexpr std::size_t longest_name = 64; ///< of a node: letters, digits, - and _
constexpr double largest_scale = 1024;   ///< of a pattern, in cells

} // namespace tilepack::scene_limits
