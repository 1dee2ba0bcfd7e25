#pragma once

#include "tilepack/measure/mapping_statistics.h"

#include <string>
#include <vector>

namespace tilepack {

/// One mapping of a survey with what was found.
struct SurveyedMapping {
  std::string name; ///< "permutation 512", "mix", "index"
  Mapping mapping;
  MappingStatistics statistics;
};

/// The given mapping, then for comparison, over its size or `largest_window` cells a side if that is smaller:
/// permutations with tables of 8, 16, … 4096 entries and of one entry more than the longer side, an odd
/// length if the side is even; the pattern, of 2 to 4 corner colors; and the mixing hash. One that is the
/// given mapping itself is left out.
std::vector<SurveyedMapping> mapping_survey(const Mapping& mapping, const ColorCounts& colors,
                                            std::uint64_t seed, int largest_window = 256);

/// Where the picture of each surveyed mapping stands on a sheet.
struct SurveySheet {
  Image picture;            ///< 3 channels, sRGB-encoded
  std::vector<Rect> panels; ///< in the survey's order
};

/// The pictures of all mappings (mapping_picture) of `cells` a side, `pixels` each, four abreast on white
/// with a margin below each for its name.   [Wei04, Fig. 3]
SurveySheet survey_sheet(const std::vector<SurveyedMapping>& survey, const ColorCounts& colors, int cells,
                         int pixels);

/// The survey as a table, one mapping a line, and the first one's families and faults in full.
std::string survey_text(const std::vector<SurveyedMapping>& survey);

/// Everything as JSON: {"window", "mappings": [{"name", "kind", "table_size", "families", "faults"}]}.
std::string survey_json(const std::vector<SurveyedMapping>& survey);

} // namespace tilepack
