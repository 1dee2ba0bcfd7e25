#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tilepack {

/// The name in `known` closest to `name` by edit distance (insert, delete, replace, swap of neighbours), for
/// "did you mean" messages. Empty if none is within a third of the longer length, rounded up.
std::string nearest_name(std::string_view name, std::span<const std::string> known);

} // namespace tilepack
