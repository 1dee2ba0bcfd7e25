#pragma once

#include <string>
#include <vector>

namespace tilepack {

/// A rule for make and ninja: `target` depends on `inputs`. Blanks, '#', '$', ':' and '|' are escaped, and
/// backslashes before them, as both read them. An empty rule for each input follows, so that make does not fail
/// once an input is gone.
///
/// What no such file can say is left out: names with ';' or a line break and names that end in a backslash, for
/// which make would stop, and, where no other name stands before it, one with '=', which make takes for a variable.
/// Ninja 1.11 does not take names with any of & ' " * ? | < > ` ^ from a depfile.
std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs);

} // namespace tilepack
