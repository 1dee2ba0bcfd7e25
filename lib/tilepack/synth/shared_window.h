#pragma once

#include "tilepack/seam/graph_cut.h"
#include "tilepack/seam/source_canvas.h"
#include "tilepack/synth/frame.h"
#include "tilepack/synth/strip_axes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tilepack {

/// The part of a shared window that lies in one tile.
struct WindowPart {
  std::size_t tile = 0;
  Rect area;            ///< of the tile
  SourceTexel at;       ///< where the area's north-west texel lies in the window
  std::size_t pane = 0; ///< parts of one pane lie at the same place; the panes fill the window
};

/// Two parts that meet at an edge, for all pairs of tiles that may.
struct PaneBorder {
  std::size_t before = 0;                      ///< indices of parts: the one north or west of the edge …
  std::size_t after = 0;                       ///< … and the one south or east of it
  Direction direction = Direction::horizontal; ///< of the edge
  int from = 0, to = 0;                        ///< along the edge, in texels of the window
  int tiles = 0; ///< that have the edge at one of their sides: how often the pair is met
};

/// A window of the virtual texture in all its guises: what a set shows round a lattice point of one color, or across
/// an edge of one color. Tiles show different things in it, and what they share they share: a
/// window of the sample laid over it (cut_of_window) is laid over all of them, each along its own cut, with one
/// decision for each texel that is in several tiles.
///
///        ┌───────┬───────┐  pane 0: all tiles with the color at their south-east corner
///        │ pane 0│ pane 1│  pane 1: … at their south-west corner
///        │      ┌┼┐      │
///        ├──────┼●┼──────┤  strips and the corner patch within the guard are in many tiles, and have one node
///        │      └┼┘      │  each in the graph; all else is a tile's own
///        │ pane 2│ pane 3│
///        └───────┴───────┘
struct SharedWindow {
  Size size;
  std::size_t panes = 2;         ///< 4 round a lattice point
  std::vector<WindowPart> parts; ///< pane by pane
  std::vector<PaneBorder> borders;
};

/// `area`: relative to the lattice point, which must lie in it; it must not reach further than half a tile.
SharedWindow window_at_corner(const FrameShape& shape, int color, Rect area);

/// `area`: relative to the north or west end of the edge, which must run through it; between the two ends.
SharedWindow window_on_edge(const FrameShape& shape, Direction direction, std::size_t strip, Rect area);

/// What one of the neighbourhoods of tiles shows in the window: of each pane the part with this number, counted
/// round.
SourceCanvas shown_in_window(const SharedWindow& window, const std::vector<SourceCanvas>& tiles,
                             std::size_t guise);

/// How many guises there are in which every part is shown at least once.
std::size_t guises(const SharedWindow& window);

/// For each texel of each part, row by row: whether it keeps what it shows, takes the window's, or the cut decides.
using WindowDecisions = std::vector<std::vector<CutConstraint>>;

/// A window of the sample to be laid over all parts of a shared window.
struct LaidWindow {
  const SharedWindow& window;
  SourceTexel place; ///< of the sample's texel that comes to the north-west texel of the window
  /// Paid for each texel that only one tile shows and that takes: what tiles share is less varied.
  std::int64_t price = 0;
};

/// What a window that is laid along its best cuts brings: of all ways to keep or take each texel that with the least
/// seam energy of the whole set, each tile and each border between tiles counted as often as the virtual texture shows
/// it. Texels that tiles share outside of the window's tiles stay.
struct WindowCut {
  std::int64_t gain =
      0; ///< by how much the energy falls, what is paid taken off; less than 0 only where `decided`
         ///< forces it
  std::int64_t before = 0;   ///< the energy of all seams that the window could change
  WindowDecisions decisions; ///< keep or take
};

/// `decided`: what is settled before; none: nothing is.
WindowCut cut_of_window(const FeatureImage& image, const FrameShape& shape, const LaidWindow& laid,
                        const std::vector<SourceCanvas>& tiles, const WindowDecisions& decided = {});

/// Lays the texels that take. Returns whether anything changed.
bool apply(const LaidWindow& laid, const WindowDecisions& decisions, std::vector<SourceCanvas>& tiles);

/// The decisions of a window of which this is the image at 1 / scale: near the lines between what keeps and what takes
/// the cut decides anew.
WindowDecisions enlarged(const WindowDecisions& decisions, const SharedWindow& window, int scale);

/// The window at 1 / scale of its size.
SharedWindow shrunk(SharedWindow window, int scale);

} // namespace tilepack
