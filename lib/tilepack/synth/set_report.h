#pragma once

#include "tilepack/exemplar/sample_analysis.h"
#include "tilepack/synth/set_faults.h"
#include "tilepack/tileset/set_figures.h"
#include "tilepack/tileset/source_map.h"

#include <vector>

namespace tilepack {

/// Figures of one tile, as in SetFigures.
struct TileFigures {
  int cut_length = 0;
  double cut_mean = 0;
  double cut_p95 = 0;
  double in_pieces = 0;
  double fresh = 0;
};

struct SetReport {
  SetFigures figures;
  std::vector<TileFigures> tiles; ///< by id
  Landmark landmark;              ///< deviation 0 if nothing stands out and is shown
  ToneBreaks tones;
};

/// `sample`: as synthesis saw it. `repeat`: where that shows itself again from this width and height on, so that
/// texels so far apart are one (exemplar/sample_wrap.h); else {}.
SetReport set_report(const SampleAnalysis& sample, const SourceMap& sources, Size repeat = {});

/// One texel of cut, for drawing.
struct Cut {
  int x = 0; ///< the west or north one of the two texels
  int y = 0;
  bool to_south = false; ///< the other one is its neighbour in the south, else in the east
  double visibility = 0;
};
std::vector<Cut> cuts_of_tile(const FeatureImage& image, const SourceMap& sources, int tile);

/// How many tiles show each texel of the sample, row by row; of sources beyond it, that of the sample's repeat.
std::vector<int> tiles_showing(const SourceMap& sources, Size sample);

/// Areas of a tile that were copied in one piece: a number for each texel, row by row, counting up from 0 in
/// the order in which pieces are met. Texels of one piece are connected, without a cut between neighbours
/// along some way, and have one offset to the sample.
std::vector<int> pieces_of_tile(const SourceMap& sources, int tile);

} // namespace tilepack
