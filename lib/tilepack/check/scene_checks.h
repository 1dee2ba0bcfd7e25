#pragma once

#include "tilepack/check/check_report.h"

#include <string>

namespace tilepack {

/// Checks a scene: the text, its nodes and their inputs, and where these are sound the files that they name, and the
/// sizes and numbers of what was found there. Lists all that is wrong in one go, TP801 to TP813; what one fault makes
/// meaningless is left out. Images of packs and pictures are not read, but for maps of pixels.
///
/// Throws Error (cannot_read) if there is no such file.
Report check_scene(const std::string& file);

} // namespace tilepack
