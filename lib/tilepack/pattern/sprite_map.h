#pragma once

#include "tilepack/pattern/tile_map.h"
#include "tilepack/pattern/tile_transform.h"

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace tilepack {

/// A pattern anywhere in the scene.
struct Sprite {
  int pattern = 0;
  PatternPlace centre;         ///< in cells of the sprite map's grid
  double scale = 1;            ///< its sides, in cells
  double cosine = 1, sine = 0; ///< of the angle it is turned by, clockwise on the screen
};

/// Explicit positioning: sprites anywhere in a grid that each cell of which holds what may be seen in it, so that a
/// pixel asks one cell. A sprite (the box round it, if turned) is no larger than a cell, and lies in at most four: to
/// set or move it, four cells are written.   [LN03, section 3.2, figure 6]
///
/// Stored are the cells that hold any; memory grows with the number of sprites. Of several in a cell the later one
/// (by number) lies over the earlier.
class SpriteMap {
public:
  /// `layers`: how many sprites a cell may hold, 1..64, the n grids of the paper.
  explicit SpriteMap(PatternGrid grid = {}, int layers = 8) : cells(grid), most(layers) {}

  /// Sets sprite `number`, new or moved, 0..2^20-1. Error (usage): larger than a cell, not finite, or a cell is full;
  /// then nothing has changed.
  void set(int number, const Sprite& sprite);
  void remove(int number);

  PatternGrid grid() const { return cells; }
  const Sprite& sprite(int number) const { return sprites[static_cast<std::size_t>(number)].second; }
  std::vector<int> numbers() const; ///< of the sprites that are there, rising
  std::size_t occupied_cells() const { return held.size(); }

  /// The numbers of the sprites that may show in a cell of the grid, rising.
  std::span<const int> in_cell(PatternCell cell) const;

  /// A place of a cell (fractions of it, 0..1) as a place of a sprite that may show there.
  TileTransform::Inside inside(int number, PatternCell cell, double u, double v) const;

  /// The transform of a sprite as seen from a cell of the grid, for TileTransform::overflowed().
  TileTransform seen_from(int number, PatternCell cell) const;

private:
  std::vector<PatternCell> covered(const Sprite& sprite) const;

  PatternGrid cells;
  int most;
  std::vector<std::pair<bool, Sprite>> sprites;                           // there, what
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<int>> held; // row, column → numbers
};

} // namespace tilepack
