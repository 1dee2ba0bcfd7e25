#include "tilepack/bake/field_value.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <charconv>

namespace tilepack {

void refuse_value(const std::string& text, const std::string& allowed) {
  throw Error(ErrorKind::usage, "", fmt::format("'{}' is not allowed; it must be {}", text, allowed));
}

// Beyond 64 bits is out of range as well.
bool parse_whole(std::string_view text, std::int64_t lowest, std::int64_t highest, std::int64_t& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && end == text.data() + text.size() && value >= lowest && value <= highest;
}

std::int64_t parsed_whole(const std::string& text, std::int64_t lowest, std::int64_t highest) {
  std::int64_t value = 0;
  if (!parse_whole(text, lowest, highest, value))
    refuse_value(text, fmt::format("a whole number of {} to {}", lowest, highest));
  return value;
}

Extent parsed_extent(const std::string& text, std::int64_t lowest, std::int64_t highest,
                     const std::string& note, const char* form) {
  const std::size_t cross = text.find_first_of("xX");
  Extent e;
  if (!parse_whole(std::string_view(text).substr(0, cross), lowest, highest, e.width) ||
      !parse_whole(std::string_view(text).substr(cross == std::string::npos ? 0 : cross + 1), lowest, highest,
                   e.height))
    refuse_value(text, fmt::format("N or {} with {} to {}{}", form, lowest, highest, note));
  return e;
}

std::string extent_text(std::int64_t width, std::int64_t height) {
  return width == height ? fmt::format("{}", width) : fmt::format("{}x{}", width, height);
}

bool parsed_flag(const std::string& text) {
  if (text != "true" && text != "false") refuse_value(text, "true or false");
  return text == "true";
}

} // namespace tilepack
