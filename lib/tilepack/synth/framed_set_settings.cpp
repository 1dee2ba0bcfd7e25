#include "tilepack/synth/framed_set_settings.h"

#include <array>

namespace tilepack {
namespace {

struct Effort {
  int starts;     // of the frame search
  int candidates; // for each strip
  int patches;    // replaced in each strip and each tile
  int tries;      // windows laid at each
  int passes;     // of PatchMatch at full size; one more at half size, which costs a quarter
  int sweeps;     // in each pass; likewise
};

// By effort; 5 is the default. For where they and the marks (q) below come from see the header.
constexpr std::array<Effort, 10> efforts{{
    {1, 6, 0, 0, 0, 0},    // 0: joined by cuts alone
    {1, 8, 0, 0, 1, 3},    // 1
    {1, 8, 2, 1, 2, 3},    // 2
    {2, 12, 3, 1, 2, 4},   // 3
    {2, 12, 4, 2, 2, 5},   // 4
    {3, 12, 4, 2, 4, 6},   // 5
    {3, 12, 6, 2, 5, 8},   // 6
    {3, 12, 8, 2, 6, 10},  // 7
    {3, 12, 8, 2, 10, 12}, // 8
    {3, 12, 8, 2, 16, 16}, // 9
}};

// Orders and rounds of insides at effort 0; InteriorOptions has those of all others.
constexpr int least_interior_starts = 4;
constexpr int least_interior_rounds = 2;

constexpr int repair_window = 28;           // texels (q)
constexpr double repair_reuse_weight = 4.0; // (q)
constexpr double match_reuse_weight = 0.2;  // (q)
constexpr int fine_reach = 8;               // texels of the sample (q)
constexpr int fine_seam_threshold = 64;     // squared difference (q)
constexpr int coarse_reach = 6;             // texels at half size: 12 of the sample
constexpr int coarse_seam_threshold = 500;  // higher: what changes here comes back as 2 × 2 texels (q)
constexpr double coarse_contrast_weight =
    1.5; // at half size only, where most matches are made: at full size the
         // same contrast costs more likeness (q; `border_contrast`)

} // namespace

FramedSetSettings settings_for(int effort, std::uint64_t seed) {
  const Effort& row = efforts[static_cast<std::size_t>(effort)];
  FramedSetSettings settings;
  settings.frame.seed = seed;
  settings.frame.starts = row.starts;
  settings.frame.candidates = row.candidates;
  settings.interiors.seed = seed;
  if (effort == 0) {
    settings.interiors.starts = least_interior_starts;
    settings.interiors.rounds = least_interior_rounds;
  }
  settings.repair = {row.patches, repair_window, row.tries, repair_reuse_weight};
  const int more = row.passes > 0 ? 1 : 0;
  settings.coarse_match = {seed,
                           row.passes + more,
                           row.sweeps + more,
                           coarse_reach,
                           match_reuse_weight,
                           coarse_contrast_weight,
                           coarse_seam_threshold};
  settings.fine_match = {seed, row.passes,         row.sweeps, fine_reach, match_reuse_weight,
                         0.0,  fine_seam_threshold};
  return settings;
}

} // namespace tilepack
