#pragma once

#include "tilepack/exemplar/structure.h"
#include "tilepack/image/image.h"
#include "tilepack/match/period_alignment.h"
#include "tilepack/seam/patch_match.h"
#include "tilepack/seam/seam_repair.h"
#include "tilepack/synth/frame.h"
#include "tilepack/synth/set_repair.h"

#include <cstddef>
#include <cstdint>

namespace tilepack {

/// The weights and thresholds that decide how good a framed set is: this header and its .cpp are the one table.
///
/// Where the values come from. None of them is derived. Rows marked (q) weigh quality and were set by paired runs
/// (the same samples and seeds with the old and with the new value) over six photos; neither photos nor runs are
/// in the repository, and all that tells of them is the project's history (CHANGELOG.md, git log). Rows marked (w)
/// bound work or memory, and were chosen by timing bakes in the same way. Rows without a mark follow from what
/// stands beside them. So none of these numbers is sacred; what is asked of another one is a better figure.
///
/// Rows marked (j) weigh how visible joins are against how varied a set is. They were set together, by two figures
/// of six photos and a drawn sample of pebbles: texels in joins that stay visible, and how many freely placed
/// windows a set is as varied as. Before (strips of a fixed reach 1/8, insides by likeness, two levels of
/// PatchMatch) and with the values here, one seed, effort 5:
///
///                     pebbles  stone wall  drawn pebbles  cracked mud  leaves  gravel  grass
///     joins, before      86        67           84            37         57      48      58
///     joins, now         34        36           50            36         39      28      36
///     varied, before     8.5       8.4          8.5           8.9        8.3     9.0     9.5
///     varied, now        6.7       6.6          6.8           6.5        7.2     8.6     7.9
///
/// Each one's own share, where it was measured, stands beside it. Since then StructureOptions::sensitivity_floor, a bias of
/// 0.08 instead of 0.06 and SetRepairOptions came in: drawn pebbles 54 → 36, stone wall 32 → 36, cracked mud 26 → 25
/// (without the first two), leaves 32 → 42, variety as before to within half a window, one seed each and differences of
/// 12 a tie; their time is a fifth of a bake.
///
/// What shows whether a change is one for the better:
///
///     ninja -C build/release quality_figures && build/release/tests/quality_figures    (see tests/quality)
///
/// Units: lengths are texels; a mismatch is a sum of squared differences of features (FeatureImage), so that 255²
/// is one texel of one channel at its most different; weights without a unit are factors.

/// How the frame is searched (searched_frame), and how thoroughly.
struct FrameSearchOptions {
  std::uint64_t seed = 0;
  /// Random choices of corner patches, judged by how well strips can be cut to them (end_cost), which takes far
  /// less time than a search; by effort. (j)
  int screened = 8;
  int starts = 8;              ///< the best of these, from which the whole frame is searched; by effort
  int candidates = 12;         ///< places considered for each strip; by effort
  int screened_candidates = 6; ///< of these, the first so many are cut while starts are screened (w)
  int rounds = 3;              ///< passes over all strips; (w)
  /// Mismatch for each texel of length of a strip whose mean color is off the sample's by 1 (of 255). (q)
  double mean_color_weight = 2;
  /// At w, a strip whose step across its edge is off the usual by the share e fits 1 + w · e² times as badly. (q)
  double step_weight = 4;
  /// At w, a strip that shows a part that deviates by salient_deviation + d (Saliency) fits 1 + w · d times as
  /// badly. (q; tests/exemplar/saliency_test.cpp)
  double saliency_weight = 1.0;
  /// Of the distance (SampleStatistics) between all strips together and the sample, times the mismatch at the
  /// start: at 1500, a distance of 0.003, that of a random tenth, weighs 4.5 times all mismatches. (q)
  double statistics_weight = 1500;

  int places_per_candidate = 60; ///< best positions looked at for each candidate wanted (w)
  int spares_per_candidate = 4;  ///< kept of them before evenness and saliency decide (w)
  int apart = 3;         ///< two candidates are so far apart, along x or y; nearer ones show much the same
  int corner_trials = 4; ///< random places tried for each corner patch
  std::size_t judged_tiles = 128;        ///< larger sets are judged by so many of their tiles (w)
  std::size_t inside_positions = 10'000; ///< at which insides are held against strips, at most (w)
};

/// How a frame is brought from one scale to the next larger one (refine_frame).
struct FrameRefineOptions {
  int distance = 2;      ///< a strip moves so far, in x and in y: the rounding of the scale before, and one
  int full_distance = 3; ///< at full size, where there is a choice to be made by steps
  /// Against a mismatch as that of the best place, for each strip, of the squared deviation of the mean step
  /// from the wanted one: at 400, a deviation of 1/20 weighs as much as a fit twice as bad. (q)
  double step_weight = 400.0;
  /// The mean step across edges, of the sample's own. Joining smooths what lies inside the tiles a little, so
  /// borders have to be smoother as well. (q; `border_step` of tests/quality)
  double wanted_step = 0.98;
  int rounds = 4; ///< passes over all strips (w)
};

/// How insides are chosen and joined (chosen_interiors, join_interiors).
struct InteriorOptions {
  std::uint64_t seed = 0;
  /// At f, a part shown as often as the average makes a fit count 1 + f times as bad. (q; `coverage` and `fresh`
  /// of tests/quality)
  double reuse_weight = 8.0;
  /// Of the distance between what the set shows and the sample's statistics, times the sum of the least
  /// mismatches of all tiles; see FrameSearchOptions. (q; `histogram_distance`)
  double statistics_weight = 1500.0;
  /// Showing a part again that deviates by salient_deviation + d (Saliency) is 1 + w · d times as bad. (q)
  double saliency_weight = 4.0;
  /// Orders in which tiles choose, the best outcome of which is taken (w); fewer for sets of more than 16 tiles,
  /// see tiles_in_all_starts.
  int starts = 16;
  int rounds = 6; ///< passes over all tiles (w)
  /// Paid in the closed cut for each texel that stays the strip's: of two cuts of like cost the one that shows
  /// more of the inside is taken. 10 is a difference of 3 in one channel; the least, see
  /// FramedSetSettings::bias_of_variance. (q)
  std::int64_t bias = 10;
  /// Places between which a tile chooses, evenly spread, judged by the cut that would join them (InsideCuts); by
  /// effort. 64 by cuts show 4 to 6 points of a hundred more of the sample than 2500 by likeness, at equal
  /// joins (j). 0: choices_per_tile places, by their likeness to the strips.
  int cuts = 64;

  std::size_t choices_per_tile = 2'500;   ///< places between which a tile chooses without cuts, at most (w)
  std::size_t choices_in_all = 1'000'000; ///< of all tiles together; each takes 16 bytes (w)
  std::size_t fewest_choices = 64;        ///< a tile has so many whatever the size of the set
  std::size_t tiles_in_all_starts = 256; ///< starts · tiles stays below, but for one start: the larger a set,
                                         ///< the less one order differs from another (w)
  double most_squares = 65'536; ///< of the sample, of which larger ones are counted in larger squares (w)
  int use_squares = 16; ///< uses are counted in squares of which so many make the tile's smaller side (w)
};

/// All that decides how a framed set is made, apart from what the user asked for.
struct FramedSetSettings {
  StructureOptions structure; ///< of the channel that tells outlines from the middles of things (j)

  /// Half the width of a strip, of the tile's smaller side, at least: 16 of 128 texels leave the cut room, and
  /// three quarters of the side to the inside. (q)
  ReachShares reach = 0.125;
  /// And at most. 0.3 instead shows 0.3 windows more, at 3 joins more. (j)
  double longest_reach = 0.375;
  /// The same where tiles hold whole periods of the sample along one axis (PeriodAlignment): parts in step join well
  /// anyway, and wide strips show less of the sample. (q; planks of tests/quality)
  double longest_reach_in_step = 0.2;
  /// Where they do along both, so many times half the period along each axis: a cut that goes
  /// round bricks, which are laid by half, goes along a joint for half a brick from each course to the next, and wants
  /// a little room; borders lie on joints (cheapest_lines). By eye, at bricks of different tones, which shorter strips cut in two.
  double reach_of_half_period = 1.1;
  double longest_reach_of_lattice = 0.45; ///< and at most: what is left to insides alone is never nothing
  /// There, too: StructureOptions::most_strong_share. Of boards and what repeats along one axis it would make knots
  /// outlines, and cuts go round them until all tiles show one (seen on drawn boards).
  double most_strong_share_of_lattice = 0.35;
  /// Between the two the reach is so many times object_scale(): what is seen as one object is about 4 scales
  /// wide, and a cut has to find a way round it; a fourth more is room to choose. Scales are 3.6 (cracked
  /// asphalt), 3.8 (gravel) … 4.9 (bark), 6.9 (leaves), 9.9 (cracked mud), 10.6 (stone wall), 14.5 (pebbles), 21.5
  /// (bathroom tiles). (j)
  double reach_of_scale = 5.0;
  /// How far corner patches reach along the edges, likewise, at least: half as far again as the shortest strips,
  /// so that cuts between the two do not meet those to the inside. (q)
  ReachShares corner_reach = 0.1875;
  double corner_reach_of_reach = 1.07; ///< and at least so many times the reach: 3/8 becomes 0.4 (j)
  /// InteriorOptions::bias as a share of the sample's variance (variance_of), for tiles of less than 256 texels; half of it
  /// for twice as large ones and so on, for it is paid by the texel, and a cut by its length. More of it shows more of the
  /// sample, at the price of hairlines. Not where tiles hold whole periods along both axes. (j)
  double bias_of_variance = 0.08;
  /// SetRepairOptions::price as a share of that bias: what tiles share should not grow where little is mended. (j)
  double price_of_bias = 1.0;
  int smallest_search_tile =
      32; ///< the search is done at the scale at which the tile's smaller side is at least
          ///< this (q)
  /// Of the sample at that scale; of larger ones parts are searched (PatchSearch), so that time and memory do not
  /// grow with the sample. (w)
  std::int64_t most_searched_texels = 150'000;
  int margin = 8; ///< texels kept beside a tile while it is repaired, at most the
                  ///< reach: half a square of PatchMatch at half size, rounded up
  FrameSearchOptions frame;
  FrameRefineOptions refine;
  InteriorOptions interiors;
  SeamRepairOptions repair;    ///< of each strip, and then of each tile
  SetRepairOptions set_repair; ///< of all tiles together, in between
  PatchMatchOptions
      coarse_match; ///< at half size, before fine_match; off, it would melt what cuts leave sharp
  PatchMatchOptions fine_match;
};

/// The settings of an effort of 0..9: more of it means more starts, more places tried, more patches replaced and
/// more passes of PatchMatch.
FramedSetSettings settings_for(int effort, std::uint64_t seed);

/// How often a tile and its sample are halved until its smaller side is less than 256 texels: what is counted in texels
/// was set for tiles of 128 to 160, and means the same there.
int halvings_to_usual(Size tile);

/// The settings for a sample of this object_scale() and variance_of(), and this tile size: strips reach so far that
/// a cut can go round what the sample shows, and cuts are drawn outward so strongly that insides show as much as
/// they can. `alignment`: of the whole periods that tiles hold.
FramedSetSettings fitted(FramedSetSettings settings, double object_scale, std::int64_t variance, Size tile,
                         const PeriodAlignment& alignment);

} // namespace tilepack
