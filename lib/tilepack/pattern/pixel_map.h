#pragma once

#include "tilepack/numeric/grid.h"
#include "tilepack/pattern/tile_map.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tilepack {

/// An outline: all pixels whose centre lies inside (even-odd rule) are of `material`. Points in pixels, x then y.
struct MaterialOutline {
  int material = 0;
  std::vector<double> points; ///< 2 a point, 3 points at least; closed by itself
};

/// A pixel map: which material each pixel is, sharp, up to the resolution of the virtual texture itself.
///   [LN03, section 3.3]
///
/// Stored as a quadtree whose squares of one material are leaves, so memory grows with the length of the boundary, not
/// with the area ([LN03] has two levels of indirection; with one more a doubling it holds at every size). Each square
/// knows the share of each material in it, for filtering.
class PixelMap {
public:
  /// Materials 0..materials-1 (1..16), a row a line (Error, invalid_content, for others).
  PixelMap(const Grid<std::uint8_t>& pixels, int materials);

  /// width x height pixels (1..2^24 a side), `ground` where no outline is, later outlines over earlier ones. Cost and
  /// memory grow with the length of the outlines.
  PixelMap(std::int64_t width, std::int64_t height, int materials, int ground,
           std::span<const MaterialOutline> outlines);

  PatternGrid grid() const { return {width, height}; }
  int materials() const { return count; }
  std::size_t bytes() const { return squares.size() * sizeof(Square) + shares.size() * sizeof(float); }

  /// The material at a pixel, and the end (exclusive) of the run of pixels of this row that surely are of it too.
  struct Run {
    int material = 0;
    std::int64_t end = 0;
  };
  Run at(std::int64_t x, std::int64_t y) const;

  /// The share of each material in the square of 2^level pixels a side that holds pixel (x, y), any integers: the map
  /// wraps. `out` has materials() entries; added with `weight`. Pixels beyond the map count for nothing.
  void add_shares(std::int64_t x, std::int64_t y, int level, double weight, std::span<double> out) const;

  /// Child squares nw, ne, sw, se: >= 0 a square, < 0 of one material, -1 - it; -1 - materials() beyond the map.
  struct Square {
    std::int32_t child[4];
  };
  /// The tree, for programs that walk it elsewhere: the square or material of the whole, whose side is a power of 2.
  std::span<const Square> tree() const { return squares; }
  std::int32_t tree_root() const { return root; }
  std::int64_t tree_side() const { return side; }

private:
  struct Builder;

  std::int32_t joined(const Square& square);
  void share_of(std::int32_t square, double weight, std::span<double> out) const;

  std::int64_t width = 0, height = 0;
  std::int64_t side = 1; ///< power of 2
  int count = 0;
  std::vector<Square> squares;
  std::vector<float> shares; ///< `count` a square
  std::int32_t root = -1;
};

} // namespace tilepack
