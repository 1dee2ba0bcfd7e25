#pragma once

#include <string>
#include <vector>

namespace tilepack {

/// A rule for make and ninja: `target` depends on `inputs`. Blanks, '#', '$' and ':' are escaped as both
/// read them. An empty rule for each input follows, so that make does not fail once an input is gone.
std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs);

} // namespace tilepack
