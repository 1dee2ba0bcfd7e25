#pragma once

#include "tilepack/report/vector_drawing.h"
#include "tilepack/report/worst_places.h"
#include "tilepack/synth/set_report.h"

#include <vector>

namespace tilepack {

/// Pictures of how a set came about. `sample` is the main map as it can be looked at: viewable(), 3 channels.

/// The tiles side by side, greyed, with a band in the color of each edge (or a square in that of each corner)
/// outside, their ids above, and their cuts: dark green where they cost nothing, yellow where they differ as
/// much as neighbouring texels of the sample do, red from three times that on. At most `most_tiles`, then
/// those with the dearest cuts. `marked`: places that are framed, with their numbers from 1.
VectorDrawing cut_picture(const Image& sample, const FeatureImage& features, const SourceMap& sources,
                          const SetReport& report, int most_tiles = 64,
                          const std::vector<WorstPlace>& marked = {});

/// The sample, colored by how many tiles show each texel; what no tile shows is dark.
Image use_picture(const Image& sample, const SourceMap& sources);

/// The color of a texel that `shown` of `tiles` tiles show, 1 and up.
Paint use_paint(int shown, int tiles);

/// The color of a cut, relative to the sample's own step.
Paint cut_paint(double visibility, double sample_step);

/// The sample with the outlines of the pieces that tiles are made of: white with the tile's id for the
/// largest piece of each inside, in the color of the border for pieces that reach one. Small pieces are left
/// out.
VectorDrawing source_picture(const Image& sample, const SourceMap& sources);

} // namespace tilepack
