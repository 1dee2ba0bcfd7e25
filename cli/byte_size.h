#pragma once

#include <cstdint>
#include <string>

namespace tilepack::cli {

/// "500M", "4G", "1T", "65536": bytes, with K, M, G and T for powers of 1024. Throws Error (usage), which names
/// `option` and the value, for anything else and for less than 1 byte or more than 2^60.
std::int64_t parsed_byte_size(const std::string& option, const std::string& text);

} // namespace tilepack::cli
