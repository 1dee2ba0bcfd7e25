#include "tilepack/synth/framed_set_settings.h"

#include <algorithm>
#include <array>

namespace tilepack {
namespace {

struct Effort {
  int screened;   // corner patches of the frame search
  int starts;     // of these, from which the frame is searched
  int candidates; // for each strip
  int cuts;       // places for each inside
  int patches;    // replaced in each strip and each tile
  int tries;      // windows laid at each
  int passes;     // of PatchMatch at full size
  int sweeps;     // in each pass
  int corners;    // windows laid round each lattice point
  int edges;      // and on each edge
  int rounds;     // over them
};

// By effort; 5 is the default. More time goes to places and cuts than to passes of PatchMatch, which melt what cuts
// leave sharp (j). For where they and the marks come from see the header.
constexpr std::array<Effort, 10> efforts{{
    {1, 1, 6, 0, 0, 0, 0, 0, 0, 0, 0},       // 0: joined by cuts alone
    {1, 1, 8, 0, 0, 0, 1, 3, 0, 0, 0},       // 1
    {2, 1, 8, 24, 2, 1, 1, 4, 1, 1, 1},      // 2
    {4, 1, 12, 32, 4, 1, 1, 5, 1, 1, 1},     // 3
    {6, 2, 12, 48, 6, 2, 1, 6, 2, 2, 1},     // 4
    {8, 2, 12, 64, 8, 2, 1, 6, 2, 3, 1},     // 5
    {12, 3, 12, 96, 12, 2, 1, 8, 3, 4, 1},   // 6
    {16, 3, 12, 128, 16, 2, 1, 10, 4, 6, 1}, // 7
    {24, 4, 16, 192, 24, 3, 2, 10, 6, 6, 2}, // 8
    {32, 6, 16, 256, 32, 3, 2, 16, 8, 8, 2}, // 9
}};

// Orders and rounds of insides at effort 0; InteriorOptions has those of all others.
constexpr int least_interior_starts = 4;
constexpr int least_interior_rounds = 2;

constexpr int usual_side = 128; // of a tile, texels, for which weights and thresholds in texels were set

constexpr int repair_window = 28;           // texels (q)
constexpr double repair_reuse_weight = 4.0; // (q)
constexpr double match_reuse_weight = 0.2;  // (q)
constexpr int fine_reach = 8;               // texels of the sample (q)
constexpr int fine_seam_threshold = 64;     // squared difference (q)

} // namespace

FramedSetSettings settings_for(int effort, std::uint64_t seed) {
  const Effort& row = efforts[static_cast<std::size_t>(effort)];
  FramedSetSettings settings;
  settings.frame.seed = seed;
  settings.frame.screened = row.screened;
  settings.frame.starts = row.starts;
  settings.frame.candidates = row.candidates;
  settings.interiors.seed = seed;
  settings.interiors.cuts = row.cuts;
  if (effort == 0) {
    settings.interiors.starts = least_interior_starts;
    settings.interiors.rounds = least_interior_rounds;
  }
  settings.repair = {row.patches, repair_window, row.tries, repair_reuse_weight};
  settings.set_repair.corner_tries = row.corners;
  settings.set_repair.edge_spots = row.edges;
  settings.set_repair.rounds = row.rounds;
  settings.coarse_match.passes = 0;
  settings.fine_match = {seed, row.passes,         row.sweeps, fine_reach, match_reuse_weight,
                         0.0,  fine_seam_threshold};
  return settings;
}

int halvings_to_usual(Size tile) {
  int halvings = 0;
  while (std::min(tile.width, tile.height) >> halvings >= 2 * usual_side) ++halvings;
  return halvings;
}

FramedSetSettings fitted(FramedSetSettings settings, double object_scale, std::int64_t variance, Size tile,
                         const PeriodAlignment& alignment) {
  const double side = std::min(tile.width, tile.height);
  if (alignment.lattice()) {
    settings.structure.most_strong_share = settings.most_strong_share_of_lattice;
    const auto reach = [&](double period) {
      return std::clamp(settings.reach_of_half_period * period / 2 / side, settings.longest_reach_in_step,
                        settings.longest_reach_of_lattice);
    };
    settings.reach = {reach(alignment.period_x()), reach(alignment.period_y())};
  } else {
    settings.reach = std::clamp(settings.reach_of_scale * object_scale / side, settings.reach.x,
                                alignment.free() ? settings.longest_reach : settings.longest_reach_in_step);
    // Not of a lattice: its variance is that of joints, in which all parts agree, and a bias by it would rather cut
    // bricks in two than go round them.
    settings.interiors.bias = std::max<std::int64_t>(
        settings.interiors.bias,
        static_cast<std::int64_t>(settings.bias_of_variance * static_cast<double>(variance)) >>
            halvings_to_usual(tile));
  }
  const auto corner_reach = [&](double least, double reach) {
    return std::max(least, reach * settings.corner_reach_of_reach);
  };
  settings.corner_reach = {corner_reach(settings.corner_reach.x, settings.reach.x),
                           corner_reach(settings.corner_reach.y, settings.reach.y)};
  settings.set_repair.price =
      static_cast<std::int64_t>(settings.price_of_bias * static_cast<double>(settings.interiors.bias));
  return settings;
}

} // namespace tilepack
