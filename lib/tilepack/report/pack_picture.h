#pragma once

#include "tilepack/pack/pack.h"
#include "tilepack/report/vector_drawing.h"

#include <optional>

namespace tilepack {

/// Pictures of a pack with its colors drawn on: along each edge a band in the edge's color, or at each corner
/// a quarter disc in the corner's, so that one sees at a glance that neighbours match; in the middle the
/// tile's id.
struct PackPictureOptions {
  int map = 0; ///< index into pack.maps
  /// Drawn from this level; unset: the finest that keeps the picture within max_side.
  std::optional<int> level = std::nullopt;
  bool marks = true;      ///< bands, discs and ids; false: the bare picture
  int min_tile_side = 96; ///< smaller tiles are magnified by a whole number
  int max_side = 4096;    ///< of the picture, for the choice of the level
};

/// The packed texture, whatever its layout. Round turned tiles lies a veiled margin that shows how the
/// texture wraps; layers of an array lie side by side, each with its border. Throws Error (usage) if the map
/// or level does not exist.
VectorDrawing pack_picture(const Pack& pack, const PackPictureOptions& options);

/// The corner pack: each cell shows the tile whose south-east corner stands for a lattice point. Throws Error
/// (usage) if the pack has none.
VectorDrawing corner_picture(const Pack& pack, const PackPictureOptions& options);

/// `columns` x `rows` tiles of the virtual texture from cell (0, 0) on.
VectorDrawing expansion_picture(const Pack& pack, int columns, int rows, const PackPictureOptions& options);

/// A map's values as they can be looked at: 3 channels, sRGB-encoded, 0..1. Grey is repeated, alpha laid over
/// grey; light beyond 1 is scaled so that 99 % of the values fit, other values outside 0..1 are stretched to
/// their range.
Image viewable(const Image& image, Role role, Encoding encoding);

/// Eight colors that stay apart for color-blind eyes: those of Okabe and Ito.
Paint color_paint(int color);

/// The parallelogram a tile is drawn in: its north-west corner, and the vectors along its north and west
/// edges. So layouts that turn tiles draw them by the same routine.
struct TileOutline {
  DrawingPoint corner;
  DrawingPoint along;
  DrawingPoint down;
};

/// Adds the marks of one tile.
void draw_marks(VectorDrawing& drawing, const TileColors& tiles, int tile, const TileOutline& frame);

} // namespace tilepack
