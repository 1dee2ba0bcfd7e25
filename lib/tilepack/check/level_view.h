#pragma once

#include "tilepack/pack/pack.h"

#include <optional>
#include <string>
#include <vector>

namespace tilepack {

/// One level of one map of a pack, with the rectangles its tiles take in the image. Borrows from the pack.
struct LevelView {
  const Pack* pack = nullptr;
  const PackedMap* map = nullptr;
  int level = 0;
  const Image* image = nullptr;
  Size tile;                              ///< of a tile at this level
  std::vector<std::optional<Rect>> rects; ///< by id; absent for turned tiles, and where the layout or the
                                          ///< image is at fault, which other checks tell
};

LevelView view_of(const Pack& pack, const PackedMap& map, int level);

/// The size the layout asks for at this level, and not empty.
bool has_right_size(const Pack& pack, const Image& image, int level);

/// Whether the layout has one place of its own for each of `tiles` tiles, in the order of ids, so that tiles
/// can be cut out of its textures.
bool places_are_sound(const Layout& layout, int tiles);

/// Whether a map's levels are boxes of the finer ones (past borders that are made to fit). Normals are renormalised,
/// roughness takes up what they lose, and alpha may be scaled to keep its coverage: those are the mip stage's own affair.
bool plain_boxes(const PackedMap& map);

/// What texels are measured by: 1 where integers hold them, else the largest value of level 0, which must be there.
double full_range(const PackedMap& map);

/// "map color, level 2".
std::string place_name(const PackedMap& map, int level);

} // namespace tilepack
