#pragma once

#include "tilepack/seam/patch_match.h"
#include "tilepack/seam/seam_repair.h"

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
/// What shows whether a change is one for the better:
///
///     ninja -C build/release quality_figures && build/release/tests/quality_figures    (see tests/quality)
///
/// Units: lengths are texels; a mismatch is a sum of squared differences of features (FeatureImage), so that 255²
/// is one texel of one channel at its most different; weights without a unit are factors.

/// How the frame is searched (searched_frame), and how thoroughly.
struct FrameSearchOptions {
  std::uint64_t seed = 0;
  int starts = 8;      ///< random choices of corner patches; by effort
  int candidates = 12; ///< places considered for each strip; by effort
  int rounds = 3;      ///< passes over all strips; (w)
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
  /// more of the inside is taken. 10 is a difference of 3 in one channel. (q)
  std::int64_t bias = 10;

  std::size_t choices_per_tile = 2'500;   ///< places between which a tile chooses, at most (w)
  std::size_t choices_in_all = 1'000'000; ///< of all tiles together; each takes 16 bytes (w)
  std::size_t fewest_choices = 64;        ///< a tile has so many whatever the size of the set
  std::size_t tiles_in_all_starts = 256; ///< starts · tiles stays below, but for one start: the larger a set,
                                         ///< the less one order differs from another (w)
  int use_squares = 16; ///< uses are counted in squares of which so many make the tile's smaller side (w)
};

/// All that decides how a framed set is made, apart from what the user asked for.
struct FramedSetSettings {
  double reach = 0.125; ///< half the width of a strip, of the tile's smaller side: 16 of 128 texels leave
                        ///< the cut room, and three quarters of the side to the inside (q)
  double corner_reach =
      0.1875; ///< how far corner patches reach along the edges, likewise: half as far again as
              ///< strips, so that cuts between the two do not meet those to the inside (q)
  int smallest_search_tile =
      32; ///< the search is done at the scale at which the tile's smaller side is at least
          ///< this (q)
  std::int64_t most_searched_texels =
      150'000;                           ///< of the sample at that scale; above, a search would take more
                                         ///< memory than the sample itself (w)
  int smallest_tile_of_large_sample = 4; ///< smallest_search_tile where that limit is passed
  int margin = 8;                        ///< texels kept beside a tile while it is repaired, at most the
                                         ///< reach: half a square of PatchMatch at half size, rounded up
  FrameSearchOptions frame;
  FrameRefineOptions refine;
  InteriorOptions interiors;
  SeamRepairOptions repair;       ///< of each strip, and then of each tile
  PatchMatchOptions coarse_match; ///< at half size, before fine_match
  PatchMatchOptions fine_match;
};

/// The settings of an effort of 0..9: more of it means more starts, more places tried, more patches replaced and
/// more passes of PatchMatch.
FramedSetSettings settings_for(int effort, std::uint64_t seed);

} // namespace tilepack
