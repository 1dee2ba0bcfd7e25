#include "inspect_mapping.h"

#include "tilepack/measure/mapping_survey.h"

namespace tilepack::cli {
namespace {

constexpr int cells = 32; // a side of each picture, as in the paper
constexpr int pixels = 192;

std::vector<SurveyedMapping> survey_of(const Pack& pack) {
  return mapping_survey(pack.mapping, pack.colors, pack.generator.seed);
}

} // namespace

std::string mapping_report(const Pack& pack, const std::string& format) {
  const std::vector<SurveyedMapping> survey = survey_of(pack);
  return format == "json" ? survey_json(survey) : survey_text(survey);
}

VectorDrawing mapping_drawing(const Pack& pack) {
  const std::vector<SurveyedMapping> survey = survey_of(pack);
  const SurveySheet sheet = survey_sheet(survey, pack.colors, cells, pixels);
  VectorDrawing drawing{sheet.picture, {}, {}};
  for (std::size_t i = 0; i < survey.size(); ++i) {
    const Rect panel = sheet.panels[i];
    const DrawingPoint below{panel.x + panel.width / 2.0, panel.y + panel.height * 1.09};
    const double height = panel.height * 0.1;
    const Paint black{0, 0, 0, 1};
    const Mapping& mapping = survey[i].mapping;
    if (i == 0)
      drawing.words.push_back({below, height, "pack", black});
    else if (mapping.kind == MappingKind::permutation)
      drawing.numbers.push_back({below, height, static_cast<int>(mapping.table.size()), black});
    else
      drawing.words.push_back({below, height, std::string(name_of(mapping.kind)), black});
  }
  return drawing;
}

} // namespace tilepack::cli
