#include "tilepack/report/mapping_picture.h"

namespace tilepack {

VectorDrawing mapping_survey_picture(const std::vector<SurveyedMapping>& survey, const ColorCounts& colors) {
  constexpr int cells = 32; // a side of each picture, as in the paper
  constexpr int pixels = 192;
  const Paint black{0, 0, 0, 1};
  const SurveySheet sheet = survey_sheet(survey, colors, cells, pixels);
  VectorDrawing drawing{sheet.picture, {}, {}};
  for (std::size_t i = 0; i < survey.size(); ++i) {
    const Rect panel = sheet.panels[i];
    const DrawingPoint below{panel.x + panel.width / 2.0, panel.y + panel.height * 1.09};
    const double height = panel.height * 0.1;
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

} // namespace tilepack
