#pragma once

#include <string>

namespace tilepack::cli {

/// A script that completes verbs, options, and their values where there is a list of them or a file is meant, from
/// what verbs declare of themselves. `shell`: "bash", "zsh" or "fish".
std::string completion_for(const std::string& shell);

} // namespace tilepack::cli
