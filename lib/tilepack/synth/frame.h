#pragma once

#include "tilepack/exemplar/feature_image.h"
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
  int reach = 2;        ///< guard < reach <= half the tile
  int corner_reach = 2; ///< reach <= corner_reach <= half the tile
  int corners = 1;
  PeriodAlignment
      alignment; ///< of the whole periods that a tile holds, and of lattices of the lines that borders lie on
  std::vector<Strip> horizontal;
  std::vector<Strip> vertical;
  std::vector<Tile> tiles; ///< by tile id
};

/// The shape for a complete set; `reach` and `corner_reach` as shares of the tile's smaller side.
FrameShape frame_shape(const SynthOptions& options, const Periodicity& periods, double reach,
                       double corner_reach);

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

/// Cuts the corner patches and strips of `sources` together. In a square of side 2 guard round each lattice
/// point only the corner patch is shown.
Frame joined_frame(const FeatureImage& image, const FrameShape& shape, const FrameSources& sources);

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
