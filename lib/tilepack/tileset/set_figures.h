#pragma once

#include "tilepack/tileset/limits.h"

#include <array>
#include <string_view>

namespace tilepack {

/// Figures of a finished set that follow from where its texels come from. They are the same on every machine
/// and rounded to 1e-4, so that they can be stored. A *cut* lies between two neighbouring texels of a tile
/// that come from places of the sample that are not neighbours; how visible it is, is the RMS difference, per
/// channel, between what is shown on both sides and what the other side's material would show there
/// (seam_cost), in 8-bit units of FeatureImage.
struct SetFigures {
  double cut_length = 0;     ///< texels of cut in a tile, on average
  double cut_mean = 0;       ///< visibility of a texel of cut
  double cut_p95 = 0;        ///< 19 of 20 texels of cut are no more visible than this
  double border_mean = 0;    ///< mean visibility across borders of tiles that may meet; 0 where all texels on
                             ///< both sides are neighbours in the sample
  double sample_step = 0;    ///< RMS difference of neighbouring texels of the sample: what hides a cut
  double in_pieces = 0;      ///< share of texels that lie in no 8 x 8 square copied whole
  double coverage = 0;       ///< share of the sample's 16 x 16 cells of which a quarter or more is shown
  double fresh = 0;          ///< share of the tiles' texels that only one tile shows
  double shown_often = 0;    ///< share of the tiles' texels that half of all tiles or more show
  double distinct_tiles = 0; ///< the set is as varied as this many tiles without a texel in common
  double histogram_distance = 0; ///< RMS difference of the distribution functions of SampleStatistics, as
                                 ///< shares of all texels
  bool operator==(const SetFigures&) const = default;
};

/// The figures by name, as files and reports call them, with the largest value that makes sense.
struct SetFigureField {
  std::string_view name;
  double SetFigures::*value;
  double most;
};
inline constexpr std::array<SetFigureField, 11> set_figure_fields{{
    {"cut_length", &SetFigures::cut_length, 1e9},
    {"cut_mean", &SetFigures::cut_mean, 255},
    {"cut_p95", &SetFigures::cut_p95, 255},
    {"border_mean", &SetFigures::border_mean, 255},
    {"sample_step", &SetFigures::sample_step, 255},
    {"in_pieces", &SetFigures::in_pieces, 1},
    {"coverage", &SetFigures::coverage, 1},
    {"fresh", &SetFigures::fresh, 1},
    {"shown_often", &SetFigures::shown_often, 1},
    {"distinct_tiles", &SetFigures::distinct_tiles, limits::most_tiles},
    {"histogram_distance", &SetFigures::histogram_distance, 1},
}};

} // namespace tilepack
