#pragma once

#include <string_view>

namespace tilepack {

/// The line, counted from 1, on which the value at `place` begins in a JSON document: the place as JsonCursor
/// names it, "jobs[3].options.seed". Where the place leads nowhere, the line of what encloses it; of a member
/// that stands twice, the first. The document must be one that can be parsed; for others it is some line of it.
int json_line(std::string_view document, std::string_view place);

} // namespace tilepack
