#pragma once

#include <string>
#include <string_view>

namespace tilepack {

/// How the library names an option in a message. It does not know who will read it: to a person at a command
/// line the option is --tile-size, in a manifest or preset it is the key "tile-size". So messages hold marked
/// fields, and whoever shows them has them spelled.
///
///   "take tiles of 64 at most (" + field("tile-size", "64") + ")"
///     plain    take tiles of 64 at most (tile-size 64)
///     option   take tiles of 64 at most (--tile-size 64)
///     json     take tiles of 64 at most ("tile-size": "64")
std::string field(std::string_view name, std::string_view value = {});

enum class FieldSpelling { plain, option, json };

/// `text` with its marked fields spelled; what is not marked stays as it is.
std::string spelled(std::string_view text, FieldSpelling spelling);

/// The name of the field that `text` is, whole; empty if it is anything else.
std::string field_name(std::string_view text);

} // namespace tilepack
