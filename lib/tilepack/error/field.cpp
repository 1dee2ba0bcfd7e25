#include "tilepack/error/field.h"

#include <fmt/format.h>

namespace tilepack {
namespace {

// Characters that no file name in a message keeps and no value has: begin, between name and value, end.
constexpr char begin = '\x1c';
constexpr char between = '\x1d';
constexpr char end = '\x1e';

std::string spelled_field(const std::string& name, const std::string& value, FieldSpelling spelling) {
  if (spelling == FieldSpelling::json)
    return value.empty() ? fmt::format("\"{}\"", name) : fmt::format("\"{}\": \"{}\"", name, value);
  const char* dashes = spelling == FieldSpelling::option ? "--" : "";
  return value.empty() ? fmt::format("{}{}", dashes, name) : fmt::format("{}{} {}", dashes, name, value);
}

} // namespace

std::string field(std::string_view name, std::string_view value) {
  return fmt::format("{}{}{}{}{}", begin, name, between, value, end);
}

std::string spelled(std::string_view text, FieldSpelling spelling) {
  std::string result;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t first = text.find(begin, at);
    const std::size_t middle = first == text.npos ? first : text.find(between, first);
    const std::size_t last = middle == text.npos ? middle : text.find(end, middle);
    if (last == text.npos) break;
    result.append(text, at, first - at);
    result += spelled_field(std::string(text.substr(first + 1, middle - first - 1)),
                            std::string(text.substr(middle + 1, last - middle - 1)), spelling);
    at = last + 1;
  }
  result.append(text, at, text.npos);
  return result;
}

std::string field_name(std::string_view text) {
  const std::size_t middle = text.find(between);
  if (text.size() < 3 || text.front() != begin || text.find(end) != text.size() - 1 ||
      middle == std::string_view::npos)
    return "";
  return std::string(text.substr(1, middle - 1));
}

} // namespace tilepack
