#pragma once

#include "tilepack/pattern/grid_walk.h"
#include "tilepack/pattern/source_samples.h"
#include "tilepack/pattern/tile_transform.h"

#include <functional>

namespace tilepack {

/// A pattern and its place in a cell, for TileTransform::overflowed(). -1: none.
struct PatternInstance {
  std::int32_t pattern = -1;
  TileTransform transform;
};

/// The largest scale of a pattern that overflows its cell.
inline constexpr double largest_scale = 1.4;

/// The smallest box round the pixels of a stretch, in cells from the first of the walk.
struct PixelBox {
  double west = 0, east = 0, north = 0, south = 0;
};
PixelBox pixel_box(const GridWalk& walk, std::size_t first, std::size_t end);

/// Draws patterns of a set along a run. Pixel i of the run is entry i of what is drawn to.
struct PatternDrawing {
  SourceLookup lookup;
  double level = 0; ///< of a pixel, in texels of a pattern that fills a cell

  /// Each cell filled by its pattern: `pattern_of` a cell of the grid, -1 blank. `seamless`: filters read on in the
  /// neighbours where they cross a border, so that what continues there does so without a seam at every level, down
  /// to one texel a tile; a blank neighbour is clear.
  void tile(const GridWalk& walk, std::size_t count,
            const std::function<std::int32_t(PatternCell)>& pattern_of, bool seamless,
            const RunValues& out) const;

  /// Pixels i..end-1, which lie in one cell, filled with the part of a pattern that fills the cell; -1: blank.
  void fill(std::int32_t pattern, const GridWalk& walk, std::size_t i, std::size_t end,
            const RunValues& out) const;

  /// An instance laid over pixels i..end-1. Its cell lies (x, y) cells from the first of the walk. It ends as if a margin of
  /// clear texels were round it, half a texel beyond its border [LN03, section 5.2]. `clipped`: nothing beyond its cell.
  struct CellOffset {
    std::int64_t x = 0, y = 0;
  };
  void draw(const PatternInstance& instance, const GridWalk& walk, CellOffset cell, std::size_t i,
            std::size_t end, bool clipped, const RunValues& out) const;

  /// How many cells beyond its own a pattern of that scale may show in, turned anyhow and its filter included: 1 or 2.
  std::int64_t cells_reached(double scale) const;

  /// Whether a pattern of a cell may show in any of the pixels: by its largest scale alone, and by its transform.
  bool may_reach(double scale, CellOffset cell, const PixelBox& pixels) const;
  bool may_show(const TileTransform& transform, CellOffset cell, const PixelBox& pixels) const;

private:
  struct Sharpness;
  Sharpness sharpness(double scale) const;
  void mend_seams(const GridWalk& walk, std::size_t count,
                  const std::function<std::int32_t(PatternCell)>& pattern_of, const RunValues& out) const;
};

} // namespace tilepack
