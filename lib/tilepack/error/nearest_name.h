#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tilepack {

/// The name in `known` closest to `name` by edit distance (insert, delete, replace, swap of neighbours), for
/// "did you mean" messages; or the shortest that begins with `name`, if that has two letters or more. Empty if
/// none is near: within a quarter of the longer length, to the nearest whole number. Dashes in front and capitals
/// have no say.
std::string nearest_name(std::string_view name, std::span<const std::string> known);

} // namespace tilepack
