#pragma once

#include <string>
#include <string_view>

namespace tilepack {

/// All bytes of `file`. Throws Error (cannot_read) saying that `what` ("the preset") can't be read.
std::string read_text_file(const std::string& file, std::string_view what);

/// Writes `text`, all or nothing. Throws Error (cannot_write).
void write_text_file(const std::string& file, std::string_view text);

} // namespace tilepack
