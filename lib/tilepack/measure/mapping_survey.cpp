#include "tilepack/measure/mapping_survey.h"

#include "tilepack/json/json_value.h"
#include "tilepack/mapping/even_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

std::string title(const Mapping& m) {
  if (m.kind == MappingKind::permutation) return fmt::format("permutation {}", m.table.size());
  return std::string(name_of(m.kind));
}

// The strongest of the four directions.
const PairCorrelation& strongest(const FamilyStatistics& f) {
  const PairCorrelation* all[] = {&f.along_rows, &f.along_columns, &f.along_diagonals, &f.against_diagonals};
  return **std::max_element(std::begin(all), std::end(all), [](const auto* a, const auto* b) {
    return std::abs(a->sigmas) < std::abs(b->sigmas);
  });
}

std::string run_text(const RepeatedRun& run) {
  return fmt::format("{} ({:.0f})", run.length, run.by_chance);
}

std::string period_text(int period) {
  return period == 0 ? "-" : std::to_string(period);
}

std::string pairs_text(const char* direction, const PairCorrelation& c) {
  return fmt::format("    {:18} {:6.2f} % equal at lag {}, expected {:.2f} % ({:+.1f} sigma)\n", direction,
                     100 * c.equal, c.lag, 100 * c.expected, c.sigmas);
}

std::string family_text(const FamilyStatistics& f) {
  std::string text =
      fmt::format("  {}\n    counts             chi-square {:.1f} of {} degrees ({:+.1f} sigma)\n", f.name,
                  f.chi_square, f.degrees, f.chi_square_sigmas);
  text += pairs_text("along rows", f.along_rows);
  text += pairs_text("along columns", f.along_columns);
  text += pairs_text("along diagonals", f.along_diagonals);
  text += pairs_text("against diagonals", f.against_diagonals);
  text +=
      fmt::format("    longest repeat     {} cells in rows, {} in columns (by chance about {:.0f}, {:.0f})\n",
                  f.longest_in_rows.length, f.longest_in_columns.length, f.longest_in_rows.by_chance,
                  f.longest_in_columns.by_chance);
  text += fmt::format("    shortest period    {} in rows, {} in columns\n", period_text(f.row_period),
                      period_text(f.column_period));
  return text;
}

JsonValue pairs_json(const PairCorrelation& c) {
  return {{"lag", c.lag}, {"equal", c.equal}, {"expected", c.expected}, {"sigmas", c.sigmas}};
}

JsonValue run_json(const RepeatedRun& run) {
  JsonValue starts = JsonValue::array();
  for (int k = 0; k < 2; ++k) starts.push_back(JsonValue::array({run.x[k], run.y[k]}));
  return {{"length", run.length}, {"by_chance", run.by_chance}, {"starts", starts}};
}

JsonValue family_json(const FamilyStatistics& f) {
  return {{"name", f.name},
          {"counts", f.counts},
          {"chi_square", f.chi_square},
          {"degrees", f.degrees},
          {"chi_square_sigmas", f.chi_square_sigmas},
          {"pairs",
           {{"rows", pairs_json(f.along_rows)},
            {"columns", pairs_json(f.along_columns)},
            {"diagonals", pairs_json(f.along_diagonals)},
            {"antidiagonals", pairs_json(f.against_diagonals)}}},
          {"longest_repeat",
           {{"rows", run_json(f.longest_in_rows)}, {"columns", run_json(f.longest_in_columns)}}},
          {"period", {{"rows", f.row_period}, {"columns", f.column_period}}}};
}

} // namespace

std::vector<SurveyedMapping> mapping_survey(const Mapping& mapping, const ColorCounts& colors,
                                            std::uint64_t seed, int largest_window) {
  const VirtualSize size{std::min<std::int64_t>(mapping.size.width, largest_window),
                         std::min<std::int64_t>(mapping.size.height, largest_window)};
  std::vector<Mapping> mappings{mapping};
  const auto compare_with = [&](Mapping other) {
    const Mapping& own = mappings.front();
    if (other.kind == own.kind && other.seed == own.seed && other.table == own.table) return; // not twice
    mappings.push_back(std::move(other));
  };
  std::vector<int> lengths;
  for (int length = 8; length <= 4096; length *= 2) lengths.push_back(length);
  lengths.push_back(static_cast<int>(std::max(size.width, size.height)) + 1);
  std::sort(lengths.begin(), lengths.end());
  for (const int length : lengths) compare_with(permutation_mapping_of_length(size, length, seed));
  if (has_even_pattern(colors.corner)) compare_with(even_mapping(size, colors.corner, seed, colors.variants));
  compare_with(mix_mapping(size, seed));

  std::vector<SurveyedMapping> survey;
  for (Mapping& m : mappings) {
    SurveyedMapping entry{title(m), {}, mapping_statistics(m, colors, largest_window)};
    entry.mapping = std::move(m);
    survey.push_back(std::move(entry));
  }
  return survey;
}

SurveySheet survey_sheet(const std::vector<SurveyedMapping>& survey, const ColorCounts& colors, int cells,
                         int pixels) {
  constexpr int abreast = 4;
  const int margin = std::max(2, pixels / 8);
  const int count = static_cast<int>(survey.size());
  const int lines = (count + abreast - 1) / abreast;
  SurveySheet sheet;
  sheet.picture =
      Image(abreast * (pixels + margin) + margin, lines * (pixels + 2 * margin) + margin, 3, 1.0f);
  for (int i = 0; i < count; ++i) {
    const Rect panel{margin + i % abreast * (pixels + margin), margin + i / abreast * (pixels + 2 * margin),
                     pixels, pixels};
    const Image small = mapping_picture(survey[static_cast<std::size_t>(i)].mapping, colors, cells);
    for (int y = 0; y < pixels; ++y)
      for (int x = 0; x < pixels; ++x) {
        const int cx = x * cells / pixels;
        const int cy = y * cells / pixels;
        if (cx >= small.width() || cy >= small.height()) continue; // a small virtual texture fills less
        const auto from = small.texel(cx, cy);
        std::copy(from.begin(), from.end(), sheet.picture.texel(panel.x + x, panel.y + y).begin());
      }
    sheet.panels.push_back(panel);
  }
  return sheet;
}

std::string survey_text(const std::vector<SurveyedMapping>& survey) {
  const VirtualSize window = survey.front().statistics.window;
  std::string text = fmt::format("mapping  {}, looked at over {} x {} cells\n", survey.front().name,
                                 window.width, window.height);
  for (const FamilyStatistics& f : survey.front().statistics.families) text += family_text(f);
  const auto& faults = survey.front().statistics.faults;
  text += faults.empty() ? "  no fault found\n" : "  faults\n";
  for (const std::string& fault : faults) text += "    " + fault + "\n";
  text += "\nfor comparison, with the same colors (longest repeat: cells, in brackets by chance)\n";
  text += fmt::format("  {:18} {:>7} {:>9} {:>7} {:>14} {:>14} {:>14} {:>7}\n", "mapping", "chi-sq", "pairs",
                      "period", "repeat, tiles", "rows of edges", "columns of", "faults");
  for (const SurveyedMapping& entry : survey) {
    const FamilyStatistics& tiles = entry.statistics.families.front();
    int period = 0;
    const RepeatedRun* in_rows = &tiles.longest_in_rows;
    const RepeatedRun* in_columns = &tiles.longest_in_columns;
    const auto excess = [](const RepeatedRun& run) {
      return run.by_chance > 0 ? run.length / run.by_chance : 0;
    };
    for (std::size_t f = 1; f < entry.statistics.families.size(); ++f) {
      const FamilyStatistics& family = entry.statistics.families[f];
      if (f == 1 || excess(family.longest_in_rows) > excess(*in_rows)) in_rows = &family.longest_in_rows;
      if (f == 1 || excess(family.longest_in_columns) > excess(*in_columns))
        in_columns = &family.longest_in_columns;
    }
    double pairs = 0;
    for (const FamilyStatistics& family : entry.statistics.families) {
      for (const int p : {family.row_period, family.column_period})
        if (p > 0 && (period == 0 || p < period)) period = p;
      pairs = std::max(pairs, std::abs(strongest(family).sigmas));
    }
    const RepeatedRun& tile_run = tiles.longest_in_rows.length > tiles.longest_in_columns.length
                                      ? tiles.longest_in_rows
                                      : tiles.longest_in_columns;
    text += fmt::format("  {:18} {:>+7.1f} {:>9.1f} {:>7} {:>14} {:>14} {:>14} {:>7}\n", entry.name,
                        tiles.chi_square_sigmas, pairs, period_text(period), run_text(tile_run),
                        run_text(*in_rows), run_text(*in_columns), entry.statistics.faults.size());
  }
  return text + "  chi-sq and pairs in standard deviations from independent fair colors\n";
}

std::string survey_json(const std::vector<SurveyedMapping>& survey) {
  const VirtualSize window = survey.front().statistics.window;
  JsonValue mappings = JsonValue::array();
  for (const SurveyedMapping& entry : survey) {
    JsonValue families = JsonValue::array();
    for (const FamilyStatistics& f : entry.statistics.families) families.push_back(family_json(f));
    mappings.push_back(
        {{"name", entry.name},
         {"kind", name_of(entry.mapping.kind)},
         {"table_size", entry.mapping.kind == MappingKind::permutation ? entry.mapping.table.size() : 0},
         {"families", families},
         {"faults", entry.statistics.faults}});
  }
  const JsonValue all{{"window", JsonValue::array({window.width, window.height})}, {"mappings", mappings}};
  return json_text(all);
}

} // namespace tilepack
