#pragma once

/// Where the verdict on a bake changes: every limit, its unit, and what it was set by. They are judgements of
/// people on pictures, so they are set again by looking:
///
///   bench_verdict_figures SAMPLE.png…   (tests/bench/verdict_figures.cpp)
///
/// prints for each sample the figures that are held against these limits, and the verdict beside them. "The
/// photos" below are 22 photographs of natural and built surfaces, baked with tiles of 128 texels at effort 0
/// and looked at; where only judgement set a limit, that is said.
namespace tilepack::verdict_thresholds {

// ---- Cuts: RMS difference a channel across them over that between neighbouring texels of the sample. The
// photos have 1.1 on average (median). For the dearest twentieth, 27 photos and samples at the default settings,
// looked at in views of 1024 texels: up to 2.7 where no cut is seen (roof tiles; leaves 2.4, a rubble wall 2.5,
// pebbles 2.6), 2.8 to 3.3 where stones, bricks, grain or ripples are cut off.
constexpr double cut_mean_fair = 1.4; ///< above: fair
constexpr double cut_mean_poor = 2.0; ///< above: poor (judgement)
constexpr double cut_p95_fair = 2.75; ///< of 95 % of the texels of cuts; above: fair
constexpr double cut_p95_poor = 6.0;  ///< above: poor (judgement)
/// 8-bit units: what a sample's own step counts at least, so that one nearly plain isn't divided by nothing.
constexpr double least_sample_step = 0.5;

// ---- Borders: difference of what lies on both sides over the sample's own step. 0 where tiles show neighbours
// of the sample. (judgement)
constexpr double border_fair = 0.1;
constexpr double border_poor = 0.4;

// ---- Transitions: share of the borders between materials that run where a material is flat, as inside things
// (TransitionGuide::inside of half its range or more). (judgement)
constexpr double border_through_fair = 0.2; ///< above: fair

// ---- Repeats of the sample. (judgement)
/// Of a period: by how much a tile side that holds no whole number of them may be off and be fair all the same.
constexpr double period_misfit_poor = 0.1;

// ---- Amount of sample: its area in tiles.
constexpr double tiles_held_fair = 6.0; ///< below: fair. So many give every tile an inside of its own.
/// Times the tiles of the set: above, larger tiles show more of the sample for the memory than further colors.
constexpr double tiles_held_far = 2.5;
constexpr double tiles_held_poor = 2.5; ///< below: poor (judgement)

// ---- Tones that differ from tile to tile. Shading is 0.019 to 0.063 in the photos whose tiles can be told by
// their tone (wood, sand, clouds, boards, a rubble wall, rust), and 0.017 at most in the others (grass and
// leaves 0.017, gravel 0.004, brick 0).
constexpr double shading_fair =
    0.018; ///< share of the sample's variance that is slow; above: said, and fair if tones end
constexpr double drift_fair = 0.25; ///< share of it between areas of a tile's size; above: fair (judgement)
constexpr double drift_poor = 0.5;  ///< above: poor (judgement)
/// Flattening is advised where it leaves less than this part of the drift. (judgement)
constexpr double flatten_helps = 0.5;

// ---- Writing: marks that mean something alone. A scanned page has 0.83 and repeats along one axis; of the
// photos none has more than 0.71.
constexpr double writing_two_tone = 0.78; ///< share of the variance that two tones explain; above, and:
constexpr double writing_ink = 0.35; ///< share of the sample that the rarer tone covers; below (judgement)

// ---- Variety. (judgement)
constexpr double coverage_few = 0.5;      ///< share of the sample that is shown; below, and:
constexpr double variety_fair = 0.5;      ///< tiles as varied over tiles that could be; below: fair
constexpr double variety_poor = 0.3;      ///< below: poor
constexpr double shown_often_fair = 0.35; ///< share of texels shown by half of all tiles or more; above: fair
constexpr double histogram_fair = 0.06;   ///< RMS difference of distributions, share; above: fair
constexpr double histogram_poor = 0.12;   ///< above: poor

// ---- Landmarks: the most striking spot. (judgement)
constexpr double landmark_deviation_fair = 3.5; ///< standard deviations from the rest; from here, and:
constexpr double landmark_shown_fair = 0.2;     ///< share of tiles that show it; from here: fair
constexpr double landmark_deviation_poor = 4.5; ///< from here, and:
constexpr double landmark_shown_poor = 0.4;     ///< from here: poor

// ---- Levels of tiles: texels of the shorter side of the last one. Farther away a pixel covers more than a texel of it: one of
// this side has a tile or so in a pixel by the time that views have faded to the mean, two levels on. (judgement)
constexpr int last_level_side = 8; ///< above: said

// ---- Tones that end in straight lines (ToneBreaks), share of the length of borders, at the default settings, looked at in views
// of 1024 texels: 0.32 (painted boards as they are), 0.28 (wood as it is) and 0.18 (drawn boards as they are) where
// they are seen at once; 0.16 at most where they are not (sand 0.15, wood flattened 0.16, boards made alike 0.14 and
// 0.01, grass 0.11, a stone wall 0.09, moss 0.07, tiles 0.05, pebbles 0.03).
constexpr double tone_breaks_fair = 0.17; ///< above: fair
constexpr double tone_breaks_poor = 0.25; ///< above: poor

} // namespace tilepack::verdict_thresholds
