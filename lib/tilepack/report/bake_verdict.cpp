#include "tilepack/report/bake_verdict.h"

#include "tilepack/bake/bake_fields.h"
#include "tilepack/error/field.h"
#include "tilepack/report/verdict_thresholds.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace tilepack {
namespace {

using Remarks = std::vector<BakeRemark>;
namespace limit = verdict_thresholds;

// Levels of a tile: both sides are halved as long as they are even.
int mip_levels(Size tile) {
  return 1 + std::countr_zero(static_cast<unsigned>(tile.width | tile.height));
}

double tiles_in_sample(const BakeFacts& facts) {
  const Size tile = facts.synth.tile_size;
  return static_cast<double>(facts.sample.width) / tile.width * static_cast<double>(facts.sample.height) /
         tile.height;
}

// Tiles without a texel in common that could be.
double tiles_possible(const BakeFacts& facts) {
  return std::min(static_cast<double>(facts.tiles), tiles_in_sample(facts));
}

double percent(double share) {
  return share * 100;
}

void add(Remarks& remarks, Grade grade, std::string_view code, std::string text,
         std::optional<Cure> cure = std::nullopt) {
  remarks.push_back({grade, std::string(code), std::move(text), std::move(cure)});
}

// As the text names it.
std::string shown(const Cure& cure) {
  return field(cure.field, cure.value);
}

// Marks that mean something alone: two tones, little ink, in lines.
bool is_writing(const BakeFacts& facts) {
  const SampleTraits& n = facts.nature;
  const bool along_one_axis = (n.periods.x.length > 0) != (n.periods.y.length > 0);
  return n.two_tone > limit::writing_two_tone && n.ink < limit::writing_ink && along_one_axis;
}

double sample_step(const BakeFacts& facts) {
  return std::max(facts.report.figures.sample_step, limit::least_sample_step);
}

double mean_cut(const BakeFacts& facts) {
  return facts.report.figures.cut_mean / sample_step(facts);
}

// How far the side is from whole periods, in texels.
double misfit(const Period& period, int side) {
  return std::abs(side - std::max(1.0, std::round(side / period.length)) * period.length);
}

void judge_periods(const BakeFacts& facts, Remarks& remarks) {
  const Periodicity& periods = facts.nature.periods;
  const Size tile = facts.synth.tile_size;
  const TileSizeAdvice advice = fitting_tile_size(periods, tile, facts.sample);
  const auto judge = [&](const Period& period, int side, int fitting, const char* axis) {
    if (period.length <= 0) return;
    const double off = misfit(period, side);
    if (const int count = whole_periods(period, side); count > 0) {
      add(remarks, Grade::good, "periods-held",
          fmt::format("The sample repeats every {:.2f} texels along {}, and a tile "
                      "holds {} of them.",
                      period.length, axis, count));
      return;
    }
    const Grade grade =
        off > limit::period_misfit_poor * period.length && mean_cut(facts) > limit::cut_mean_fair
            ? Grade::poor
            : Grade::fair;
    const std::string found = fmt::format(
        "The sample repeats every {:.2f} texels along {}, and {} texels are {:.2f} of them: what runs on in "
        "the sample breaks off where parts of it meet.",
        period.length, axis, side, side / period.length);
    const char* const limit = is_writing(facts) ? " Lines then run on, what they say does not." : "";
    if (fitting != side && misfit(period, fitting) < off)
      add(remarks, grade, "periods-broken",
          fmt::format("{} Bake with {}, which {} finds{}.{}", found,
                      field("tile-size", tile_size_value(advice.size)), field("tile-size", "auto"),
                      mip_levels(advice.size) < mip_levels(tile)
                          ? fmt::format(" (tiles of that size have {} mip level{}, these {})",
                                        mip_levels(advice.size), mip_levels(advice.size) == 1 ? "" : "s",
                                        mip_levels(tile))
                          : "",
                      limit),
          Cure{"tile-size", tile_size_value(advice.size)});
    else
      add(remarks, grade, "periods-broken",
          fmt::format("{} No tile that fits holds whole repeats; a larger sample, or one "
                      "scaled so that repeats are whole texels, would help.",
                      found));
  };
  judge(periods.x, tile.width, advice.size.width, "x");
  judge(periods.y, tile.height, advice.size.height, "y");
}

// What hides a cut is how much neighbouring texels differ anyway.
void judge_cuts(const BakeFacts& facts, Remarks& remarks) {
  const SetFigures& f = facts.report.figures;
  if (f.cut_length == 0) {
    add(remarks, Grade::good, "no-cuts", "No tile has a cut inside.");
    return;
  }
  const double mean = mean_cut(facts);
  const double worst = f.cut_p95 / sample_step(facts);
  const std::string found = fmt::format(
      "Along cuts material differs by {:.1f} on average, and by more than {:.1f} in one texel of 20; "
      "neighbouring texels of the sample differ by {:.1f}",
      f.cut_mean, f.cut_p95, f.sample_step);
  if (mean <= limit::cut_mean_fair && worst <= limit::cut_p95_fair) {
    add(remarks, Grade::good, "cuts-hidden", found + ", so cuts hide in the texture.");
    return;
  }
  std::string options;
  std::optional<Cure> first;
  const auto suggest = [&](const Cure& cure, const std::string& before = "", const std::string& after = "") {
    options += (options.empty() ? "" : ", ") + before + shown(cure) + after;
    if (!first) first = cure;
  };
  const SynthOptions& o = facts.synth;
  if (o.interior == Construction::quilt) suggest({"interior", "patch"});
  if (o.effort < limits::highest_effort) suggest({"effort", std::to_string(limits::highest_effort)});
  if (2 * o.tile_size.width <= facts.sample.width / 2 && 2 * o.tile_size.height <= facts.sample.height / 2)
    suggest({"tile-size", tile_size_value(Size{2 * o.tile_size.width, 2 * o.tile_size.height})}, "",
            " (fewer cuts for the area)");
  suggest({"seed", ""}, "another ");
  const int colors =
      o.coloring == Coloring::corner ? o.colors.corner : std::max(o.colors.horizontal, o.colors.vertical);
  if (colors > 2 && facts.material.empty())
    suggest({"colors", "2"}, "", " (fewer parts that must fit one another)");
  add(remarks, mean > limit::cut_mean_poor || worst > limit::cut_p95_poor ? Grade::poor : Grade::fair,
      "cuts-seen", fmt::format("{}: some can be seen. Try {}.", found, options), first);
}

// Steps alone don't tell: a set has few kinds of borders, and where one runs along a joint of bricks its step
// is large and right.
void judge_borders(const BakeFacts& facts, Remarks& remarks) {
  const SetFigures& f = facts.report.figures;
  const double share = f.border_mean / sample_step(facts);
  if (share <= limit::border_fair) {
    add(remarks, Grade::good, "borders-hidden",
        "Across borders tiles show neighbours of the sample: no border can be told.");
    return;
  }
  const bool edge = facts.synth.coloring == Coloring::edge;
  const Cure cure = edge ? Cure{"coloring", "corner"} : Cure{"guard", "4"};
  const std::string way_out = edge ? shown(cure) + ", whose corners agree"
                                   : fmt::format("{}, or another {}", shown(cure), field("seed"));
  add(remarks, share > limit::border_poor ? Grade::poor : Grade::fair, "borders-seen",
      fmt::format(
          "Across borders material differs by {:.1f} on average (neighbouring texels of the sample by "
          "{:.1f}). Try {}.",
          f.border_mean, f.sample_step, way_out),
      cure);
}

void judge_shading(const BakeFacts& facts, Remarks& remarks) {
  const double drift = facts.nature.drift;
  // What is slow in the sample need not be seen in its tiles.
  const bool seen = !facts.report.tones.looked || facts.report.tones.share > limit::tone_breaks_fair ||
                    drift > limit::drift_fair;
  const Grade grade = drift > limit::drift_poor ? Grade::poor : seen ? Grade::fair : Grade::good;
  const std::string found =
      fmt::format("{:.1f} % of the sample's variance lies between areas of a tile's size: brightness or hue "
                  "changes on a larger scale than tiles, which {} as a patchwork of tones.",
                  percent(drift), seen ? "shows" : "may show");
  if (facts.flatten < 100 && facts.flat_drift < limit::flatten_helps * drift)
    add(remarks, grade, "shading",
        fmt::format("{} Bake with {}, which leaves {:.1f} %, or with a larger {}.", found,
                    field("flatten", "100"), percent(facts.flat_drift), field("tile-size")),
        Cure{"flatten", "100"});
  else
    add(remarks, grade, "shading",
        fmt::format("{} Use a larger {}, or a sample that is more even.", found, field("tile-size")),
        Cure{"tile-size", ""});
}

// A drawn pattern of which each tile holds whole repeats: any part of it shows all there is.
bool is_pattern_in_step(const BakeFacts& facts) {
  const auto in_step = [](const Period& period, int side) {
    return period.exact && (period.length == 0 || whole_periods(period, side) > 0);
  };
  return in_step(facts.nature.periods.x, facts.synth.tile_size.width) &&
         in_step(facts.nature.periods.y, facts.synth.tile_size.height);
}

void judge_sample(const BakeFacts& facts, Remarks& remarks) {
  const SampleTraits& n = facts.nature;
  const Size tile = facts.synth.tile_size;
  const double held = tiles_in_sample(facts);
  if (held < limit::tiles_held_fair) {
    const int smaller = std::min(facts.sample.width, facts.sample.height) / 4 / 8 * 8;
    std::optional<Cure> cure;
    if (smaller >= 16 && smaller < std::min(tile.width, tile.height))
      cure = Cure{"tile-size", std::to_string(smaller)};
    add(remarks, held < limit::tiles_held_poor ? Grade::poor : Grade::fair, "sample-small",
        fmt::format("The sample holds {:.1f} tiles, too little for every tile to have an inside of its own. "
                    "Use a larger sample{}.",
                    held, cure ? fmt::format(", or {}", shown(*cure)) : ""),
        cure);
  }
  if (has_shading(n)) judge_shading(facts, remarks);
  if (is_writing(facts))
    add(remarks, Grade::poor, "writing",
        "The sample looks like writing or drawing: two tones in lines. Tiles keep what neighbours "
        "look like, not what marks mean, and cuts must run through marks: no option keeps what "
        "is written whole. Store it as a texture of its own.");
}

// More tiles show more only where the sample has more to show than they hold.
struct WayOut {
  std::string text;
  std::optional<Cure> cure;
};

WayOut way_to_variety(const BakeFacts& facts) {
  const SynthOptions& o = facts.synth;
  const bool corner = o.coloring == Coloring::corner;
  const ColorCounts& k = o.colors;
  const int more = 1 + (corner ? k.corner : std::min(k.horizontal, k.vertical));
  if (o.interior == Construction::quilt) {
    const Cure cure{"interior", "patch"};
    return {fmt::format(" {} gives every tile an inside of its own.", shown(cure)), cure};
  }
  const double held = tiles_in_sample(facts);
  if (held > limit::tiles_held_far * facts.tiles && !facts.size_chosen) {
    const Cure cure{"tile-size", "auto"};
    return {fmt::format(" {} shows more, in tiles as large as the sample has room for.", shown(cure)), cure};
  }
  if (held < facts.tiles)
    return {held < limit::tiles_held_fair ? "" : " A larger sample or smaller tiles show more.",
            std::nullopt};
  if (more > (corner ? limits::most_corner_colors : limits::most_edge_colors)) return {};
  if (!facts.material.empty()) {
    if (k.variants >= limits::most_variants) return {};
    const Cure cure{"variants", std::to_string(limits::most_variants)};
    return {fmt::format(" {} shows more.", shown(cure)), cure};
  }
  const bool sequential = facts.tiles < combinations(k);
  const Cure cure{"colors", std::to_string(more)};
  return {fmt::format(" {} shows more, in {} tiles.", shown(cure),
                      sequential ? 2 * more * more : k.variants * more * more * more * more),
          cure};
}

void judge_variety(const BakeFacts& facts, Remarks& remarks) {
  const SetFigures& f = facts.report.figures;
  if (facts.tiles == 1) {
    const Cure cure{"colors", "2"};
    add(remarks, Grade::fair, "one-tile",
        fmt::format("One tile lies in all cells. {} shows more, in 16 tiles.", shown(cure)), cure);
    return;
  }
  const WayOut way_out = way_to_variety(facts);
  const std::string found = fmt::format(
      "The tiles show {:.0f} % of the sample and are as varied as {:.1f} tiles without a texel in "
      "common, of {}",
      percent(f.coverage), f.distinct_tiles, facts.tiles);
  const double possible = tiles_possible(facts);
  const bool few = f.coverage < limit::coverage_few && f.distinct_tiles < limit::variety_fair * possible;
  if (few)
    add(remarks, f.distinct_tiles < limit::variety_poor * possible ? Grade::poor : Grade::fair, "few-parts",
        found + ": parts come back often, and others are never seen." + way_out.text, way_out.cure);
  else
    add(remarks, Grade::good, "varied", found + ".");
  if (f.shown_often > limit::shown_often_fair) // the way out is said once
    add(remarks, Grade::fair, "shown-often",
        fmt::format("{:.0f} % of the tiles' area shows what half of all tiles show.{}",
                    percent(f.shown_often), few ? "" : way_out.text),
        few ? std::nullopt : way_out.cure);
  if (f.histogram_distance > limit::histogram_fair)
    add(remarks, f.histogram_distance > limit::histogram_poor ? Grade::poor : Grade::fair, "values-differ",
        fmt::format(
            "Values are spread otherwise than in the sample, by {:.1f} % of texels: some brightness or "
            "kind of detail is shown too often. Try another {} or {}.",
            percent(f.histogram_distance), field("seed"),
            facts.synth.interior == Construction::quilt ? field("interior", "patch")
                                                        : fmt::format("more {}", field("colors"))),
        Cure{"seed", ""});
}

void judge_landmark(const BakeFacts& facts, Remarks& remarks) {
  const Landmark& mark = facts.report.landmark;
  if (mark.deviation < limit::landmark_deviation_fair || mark.shown < limit::landmark_shown_fair) return;
  add(remarks,
      mark.shown >= limit::landmark_shown_poor && mark.deviation >= limit::landmark_deviation_poor
          ? Grade::poor
          : Grade::fair,
      "landmark",
      fmt::format(
          "The spot round ({}, {}) of the sample is unlike the rest ({:.1f} standard deviations), and "
          "{:.0f} % of the tiles show it: the eye may find it again and again. Try another {}, or "
          "paint it over in the sample.",
          mark.centre.x, mark.centre.y, mark.deviation, percent(mark.shown), field("seed")),
      Cure{"seed", ""});
}

// What a cut parts may differ little from texel to texel and be of another tone.
void judge_tones(const BakeFacts& facts, Remarks& remarks) {
  const double share = facts.report.tones.share;
  if (share <= limit::tone_breaks_fair) return;
  const std::string found = fmt::format("Along {:.0f} % of the length of borders a tone ends in a straight "
                                        "line where the sample has no such step: "
                                        "it looks pieced together.",
                                        percent(share));
  const Grade grade = share > limit::tone_breaks_poor ? Grade::poor : Grade::fair;
  if (facts.flatten < 100)
    add(remarks, grade, "tones-end",
        fmt::format("{} Try {}, which takes tones out, or another {}.", found, field("flatten", "100"),
                    field("seed")),
        Cure{"flatten", "100"});
  else
    add(remarks, grade, "tones-end",
        fmt::format("{} Try another {}, or a larger {}.", found, field("seed"), field("tile-size")),
        Cure{"seed", ""});
}

// Levels of tiles end where a side is odd.
void judge_levels(const BakeFacts& facts, Remarks& remarks) {
  const Size last = facts.coarsest, tile = facts.synth.tile_size;
  if (std::min(last.width, last.height) <= limit::last_level_side) return;
  const int halvings = mip_levels(tile) - 1;
  add(remarks, Grade::good, "levels-end",
      fmt::format("A tile of {} x {} texels {}, so that its coarsest level has {} x {}: from farther away it "
                  "flickers or turns flat. {} goes on to the mean.",
                  tile.width, tile.height,
                  halvings == 0 ? "can't be halved"
                                : fmt::format("halves evenly {} time{}", halvings, halvings == 1 ? "" : "s"),
                  last.width, last.height, field("full-mips")),
      Cure{"full-mips", "true"});
}

// A sample that shows nothing: no figure of a set means anything then, and no option helps.
BakeRemark nothing_to_tile(const BakeFacts& facts) {
  if (facts.clear)
    return {Grade::fair,
            "clear",
            "The sample is transparent all over: nothing of it is seen, and there is nothing to tile.",
            {}};
  return {Grade::fair,
          "plain",
          "All texels of the sample look alike: there is nothing to tile, and a texture of one texel shows "
          "the same.",
          {}};
}

} // namespace

std::string tile_size_value(Size size) {
  return size.width == size.height ? fmt::format("{}", size.width)
                                   : fmt::format("{}x{}", size.width, size.height);
}

std::vector<JudgedFigure> judged_figures(const BakeFacts& facts) {
  const SetFigures& f = facts.report.figures;
  const SampleTraits& n = facts.nature;
  const Landmark& mark = facts.report.landmark;
  return {{"cut mean", mean_cut(facts), limit::cut_mean_fair, limit::cut_mean_poor},
          {"cut p95", f.cut_p95 / sample_step(facts), limit::cut_p95_fair, limit::cut_p95_poor},
          {"border", f.border_mean / sample_step(facts), limit::border_fair, limit::border_poor},
          {"tiles held", tiles_in_sample(facts), limit::tiles_held_fair, limit::tiles_held_poor},
          {"shading", n.shading, limit::shading_fair, {}},
          {"drift", n.drift, limit::drift_fair, limit::drift_poor},
          {"two tones", n.two_tone, {}, limit::writing_two_tone},
          {"ink", n.ink, {}, limit::writing_ink},
          {"coverage", f.coverage, limit::coverage_few, limit::coverage_few},
          {"variety", f.distinct_tiles / tiles_possible(facts), limit::variety_fair, limit::variety_poor},
          {"shown often", f.shown_often, limit::shown_often_fair, {}},
          {"histogram", f.histogram_distance, limit::histogram_fair, limit::histogram_poor},
          {"mark", mark.deviation, limit::landmark_deviation_fair, limit::landmark_deviation_poor},
          {"mark shown", mark.shown, limit::landmark_shown_fair, limit::landmark_shown_poor},
          {"tone breaks", facts.report.tones.share, limit::tone_breaks_fair, limit::tone_breaks_poor}};
}

std::span<const std::string_view> remark_codes() {
  static constexpr std::string_view codes[] = {
      "plain",         "sample-small",   "shading",        "writing",      "periods-held", "periods-broken",
      "no-cuts",       "cuts-hidden",    "cuts-seen",      "varied",       "few-parts",    "shown-often",
      "border-round",  "border-through", "borders-hidden", "borders-seen", "one-tile",     "landmark",
      "values-differ", "fireflies",      "tones-end",      "levels-end",   "clear"};
  return codes;
}

BakeVerdict pack_verdict(const Pack& pack) {
  BakeVerdict verdict;
  if (!pack.synthesis || pack.synthesis->sample_step == 0) return verdict;
  BakeFacts facts;
  try {
    std::vector<BakeSetting> settings;
    for (const auto& [name, value] : pack.generator.options) settings.push_back({name, value, field(name)});
    facts.synth = bake_options(settings).synth;
  } catch (const Error&) {
    return verdict; // made by another version
  }
  facts.report.figures = *pack.synthesis;
  facts.synth.tile_size = pack.tile_size;
  facts.tiles = tile_count(pack.tiles);
  facts.sample = {1 << 20, 1 << 20}; // not known: large enough for every tile to have an inside of its own
  facts.size_chosen = true;          // so no other size is advised for its sake
  judge_cuts(facts, verdict.remarks);
  judge_borders(facts, verdict.remarks);
  judge_variety(facts, verdict.remarks);
  for (const BakeRemark& remark : verdict.remarks) verdict.grade = std::max(verdict.grade, remark.grade);
  return verdict;
}

namespace {

// What is wrong with each material by itself, and how the borders between them run.
BakeVerdict transition_verdict(const BakeFacts& facts) {
  BakeVerdict verdict;
  std::string shares;
  for (std::size_t m = 0; m < facts.materials.size(); ++m) {
    const BakeFacts& material = facts.materials[m];
    for (BakeRemark& remark : bake_verdict(material).remarks) {
      if (remark.grade == Grade::good) continue;
      remark.text = fmt::format("{}: {}", material.material, remark.text);
      verdict.remarks.push_back(std::move(remark));
    }
    shares += fmt::format("{}{:.0f} % {}", shares.empty() ? "" : ", ", percent(facts.transition.shown[m]),
                          material.material);
  }
  const TransitionFigures& figures = facts.transition;
  const bool seen = figures.through_things > limit::border_through_fair;
  std::string text = fmt::format("Tiles show {}. {:.0f} % of the borders between them run through the inside "
                                 "of what the materials show; of "
                                 "straight ones {:.0f} % would",
                                 shares, percent(figures.through_things), percent(figures.expected));
  if (seen) {
    const Cure cure{"seed", ""};
    add(verdict.remarks, Grade::fair, "border-through",
        fmt::format("{}: some things look cut. Try another {}, or larger tiles.", text, shown(cure)), cure);
  } else {
    add(verdict.remarks, Grade::good, "border-round", text + ": they run round things.");
  }
  return verdict;
}

BakeVerdict worst_first(BakeVerdict verdict) {
  std::stable_sort(verdict.remarks.begin(), verdict.remarks.end(),
                   [](const BakeRemark& a, const BakeRemark& b) { return a.grade > b.grade; });
  verdict.grade = verdict.remarks.front().grade;
  return verdict;
}

} // namespace

BakeVerdict bake_verdict(const BakeFacts& facts) {
  if (!facts.materials.empty()) {
    BakeVerdict verdict = transition_verdict(facts);
    judge_levels(facts, verdict.remarks);
    return worst_first(std::move(verdict));
  }
  BakeVerdict verdict;
  if (shows_nothing(facts)) {
    verdict.remarks.push_back(nothing_to_tile(facts));
    return worst_first(std::move(verdict));
  }
  const bool pattern = is_pattern_in_step(facts);
  if (!pattern) judge_sample(facts, verdict.remarks);
  judge_periods(facts, verdict.remarks);
  judge_cuts(facts, verdict.remarks);
  judge_borders(facts, verdict.remarks);
  judge_tones(facts, verdict.remarks);
  if (!pattern) judge_variety(facts, verdict.remarks);
  if (!pattern) judge_landmark(facts, verdict.remarks);
  if (!facts.fireflies.empty())
    add(verdict.remarks, Grade::good, "fireflies",
        fmt::format(
            "The sample has {}. They hardly count where tiles are cut, but tiles show them: paint them over.",
            facts.fireflies));
  judge_levels(facts, verdict.remarks);
  return worst_first(std::move(verdict));
}

} // namespace tilepack
