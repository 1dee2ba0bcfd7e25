#pragma once

#include "tilepack/tileset/limits.h"

#include <string>
#include <vector>

namespace tilepack {

/// A way to fill a texture that wraps with equal turned squares, nothing left over.   [DN04]
///
/// `squares` is 1 for a square texture and 2 for one twice as wide as high. Each square texture of side 1
/// holds n² + k² tiles on the lattice spanned by (n, k) / (n² + k²) and (-k, n) / (n² + k²): a tile's east
/// side points along the first, which is turned clockwise (v grows down) by the angle whose tangent is k / n.
///
///   n = 2, k = 1: 5 tiles        k = 0: the plain grid, not turned
///   n = k = 1: 2 tiles at 45°    squares = 2: the same N as turning by 45° more, but on a 2 : 1 texture
///
/// Schemes may be nested, a scheme's square texture standing for each tile of another. That multiplies the
/// complex numbers n + ki, so a nested scheme is again one of these: N is reached by products exactly if it
/// is reached directly.
struct RotatedScheme {
  int n = 1;       ///< 1..
  int k = 0;       ///< 0..n
  int squares = 1; ///< 1 or 2
  bool operator==(const RotatedScheme&) const = default;
};

constexpr int tile_count(const RotatedScheme& scheme) {
  return scheme.squares * (scheme.n * scheme.n + scheme.k * scheme.k);
}

/// Tile counts considered: 1..max_rotated_tiles.
inline constexpr int max_rotated_tiles = limits::most_scheme_tiles;

/// All schemes of exactly `tiles` tiles, square textures first, then by falling n. Empty if there is none:
/// where a prime that is 3 mod 4 divides `tiles` an odd number of times. Throws Error (usage) outside
/// 1..max_rotated_tiles.
std::vector<RotatedScheme> rotated_schemes(int tiles);

/// The nearest reachable counts: the largest <= tiles and the smallest >= tiles; both `tiles` if a scheme
/// exists.
struct ReachableCounts {
  int below = 0;
  int above = 0;
  bool operator==(const ReachableCounts&) const = default;
};
ReachableCounts reachable_counts(int tiles);

/// The smallest schemes whose nesting gives `scheme`: its tile counts, rising, none of which can be split
/// further ("2 · 5" for 10 tiles). Two squares side by side count as a 2.
std::vector<int> nested_counts(const RotatedScheme& scheme);

/// "3² + 1²", "4²", "2 × (2² + 1²)".
std::string formula(const RotatedScheme& scheme);

/// The angle of the tiles in degrees, clockwise, 0..45, from + - * / and square roots only.
double angle_in_degrees(const RotatedScheme& scheme);

} // namespace tilepack
