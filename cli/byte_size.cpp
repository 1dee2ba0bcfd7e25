#include "byte_size.h"

#include "tilepack/error/error.h"

#include <fmt/core.h>

#include <charconv>
#include <string_view>

namespace tilepack::cli {

std::int64_t parsed_byte_size(const std::string& option, const std::string& text) {
  constexpr std::int64_t most = std::int64_t{1} << 60;
  constexpr std::string_view units = "KMGT";
  std::int64_t number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  const std::size_t power = unit.empty() ? 0 : units.find(unit.front()) + 1; // 0 if it is none of them
  const std::int64_t factor = std::int64_t{1} << (10 * power);
  if (fault != std::errc() || unit.size() > 1 || (unit.size() == 1 && power == 0) || number < 1 ||
      number > most / factor)
    throw Error(
        ErrorKind::usage, option,
        fmt::format(
            "'{}' is not allowed; it must be a number of bytes, or one with K, M, G or T behind it: 500M, 4G",
            text));
  return number * factor;
}

} // namespace tilepack::cli
