#pragma once

#include "tilepack/exemplar/feature_pyramid.h"
#include "tilepack/match/period_alignment.h"
#include "tilepack/seam/graph_cut.h"
#include "tilepack/seam/source_canvas.h"
#include "tilepack/synth/synth_options.h"

#include <vector>

namespace tilepack {

/// What the tiles of a set share: a patch of the sample round each color of lattice point, and a strip along
/// each color of edge. With corner coloring a strip's color is the pair of its end corners, so edges and
/// corners agree; with edge coloring all lattice points show one patch, for four free edges can't agree in
/// anything else.
///
///      ●─────strip─────●      ● corner patches, reaching corner_reach texels from the lattice point
///      │ ╲           ╱ │      strips reach `reach` texels to either side of their edge; the texels nearer
///     strip  inside  strip    than `guard` are the strip's in every tile, the rest is where the cut to the
///      │ ╱           ╲ │      tile's inside may run
///      ●─────strip─────●
struct FrameShape {
  /// How far something reaches, along x and along y, texels: vertical strips to either side of their edge by x,
  /// horizontal ones by y; corner patches from their lattice point along horizontal edges by x, along vertical ones by y.
  struct Reach {
    int x = 2;
    int y = 2;
  };
  struct Strip {
    int first = 0;  ///< corner patch at its west or north end
    int second = 0; ///< at its east or south end
  };
  struct Tile { ///< indices of strips
    int north = 0;
    int east = 0;
    int south = 0;
    int west = 0;
  };
  Size tile;
  int guard = 1;
  Reach reach;        ///< along each axis guard < reach <= half the tile
  Reach corner_reach; ///< along each axis reach <= corner_reach <= half the tile
  int corners = 1;
  PeriodAlignment
      alignment; ///< of the whole periods that a tile holds, and of lattices of the lines that borders lie on
  std::vector<Strip> horizontal;
  std::vector<Strip> vertical;
  std::vector<Tile> tiles; ///< by tile id
};

/// How far strips or corner patches reach along x and along y, as shares of the tile's smaller side.
struct ReachShares {
  ReachShares(double along_both) : x(along_both), y(along_both) {}
  ReachShares(double along_x, double along_y) : x(along_x), y(along_y) {}
  double x;
  double y;
};

/// The shape for a complete set.
FrameShape frame_shape(const SynthOptions& options, const Periodicity& periods, ReachShares reach,
                       ReachShares corner_reach);

/// The same frame for an image `times` halved.
FrameShape halved(const FrameShape& shape, int times);

/// Where the frame's parts are taken from.
struct FrameSources {
  PeriodAlignment alignment;        ///< all parts are in step with it
  std::vector<SourceTexel> corners; ///< the texel south-east of the lattice point
  std::vector<SourceTexel>
      horizontal; ///< north-west texel of a window of tile.width × 2 reach, edge in the middle
  std::vector<SourceTexel> vertical; ///< of 2 reach × tile.height
};

/// The strips with their corner patches joined by cuts: canvases of the windows' sizes.
struct Frame {
  std::vector<SourceCanvas> horizontal;
  std::vector<SourceCanvas> vertical;
};

/// Cuts the corner patches and strips of `sources` together, at the scale of the first level. In a square of side 2 guard round each lattice
/// point only the corner patch is shown.
Frame joined_frame(const FeaturePyramid& pyramid, const FrameShape& shape, const FrameSources& sources);

/// What a texel of a tile stems from while nothing is chosen for it.
constexpr SourceTexel no_source{-1, -1};

/// Whether a texel lies within `guard` of a border of its tile: it shows the strip in every tile. Also of texels
/// outside of the tile.
bool in_guard(const FrameShape& shape, int x, int y);

/// Cuts are drawn outward by InteriorOptions::bias but for the nearest part of the reach to a border, one in so
/// many: with the bias there too, cuts hug the border as straight hairlines (seen on pebbles). (j)
constexpr int unbiased_part = 3;

/// What the cut that joins an inside may do with a texel of its tile that a strip reaches: it is drawn outward by the
/// bias, but not within a part of the reach (unbiased_part) of a border, which it would hug as a line.
CutConstraint constraint_at(const FrameShape& shape, int x, int y);

} // namespace tilepack
