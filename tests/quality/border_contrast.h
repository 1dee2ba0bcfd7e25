#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/tileset/source_map.h"

namespace tilepack::quality {

/// How lively tiles are near their borders, where parts are joined: the mean step between neighbouring texels
/// within an eighth of a tile of its border, over that of the whole sample. 1: as lively as the sample; below
/// it, what was joined is washed out.
double border_contrast(const FeatureImage& sample, const SourceMap& sources);

} // namespace tilepack::quality
