#pragma once

#include "tilepack/measure/mapping_survey.h"
#include "tilepack/report/vector_drawing.h"

#include <vector>

namespace tilepack {

/// Surveyed mappings as pictures of 32 x 32 cells, a block of pixels a cell, each tile its own color; four
/// abreast in the order of the survey. Below each what it is: "pack" for the first, which is the pack's own,
/// the number of entries for tables, else the kind.
VectorDrawing mapping_survey_picture(const std::vector<SurveyedMapping>& survey, const ColorCounts& colors);

} // namespace tilepack
