#pragma once

#include <string>
#include <string_view>

namespace tilepack {

/// `text` on one line and harmless to a terminal, for messages that hold names of files and parts of their
/// content. Control characters, line ends, marks that reverse the direction of writing and bytes that are no
/// UTF-8 are spelled: "\n", "\t", "\x1b", "\u202e". All else stays as it is, a backslash too.
std::string printable(std::string_view text);

} // namespace tilepack
