#include "tilepack/bake/depfile.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace tilepack {
namespace {

constexpr std::string_view escaped_by_backslash = " \t#:|";

std::string escaped(const std::string& path) {
  std::string text;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const char c = path[i];
    if (c == '$') text += '$';
    if (escaped_by_backslash.find(c) != std::string_view::npos) {
      for (std::size_t before = i; before > 0 && path[before - 1] == '\\'; --before) text += '\\';
      text += '\\';
    }
    text += c;
  }
  return text;
}

bool has_equals(const std::string& path) {
  return path.find('=') != std::string::npos;
}

std::vector<std::string> sayable(std::vector<std::string> paths) {
  std::erase_if(paths, [](const std::string& path) {
    return path.empty() || path.find_first_of(";\n\r") != std::string::npos || path.back() == '\\';
  });
  std::stable_partition(paths.begin(), paths.end(),
                        [](const std::string& path) { return !has_equals(path); });
  if (!paths.empty() && has_equals(paths.front())) paths.clear();
  return paths;
}

} // namespace

std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs) {
  const std::vector<std::string> paths = sayable(inputs);
  std::string text = escaped(target) + ":";
  for (const std::string& input : paths) text += fmt::format(" \\\n  {}", escaped(input));
  text += '\n';
  for (const std::string& input : paths)
    if (!has_equals(input)) text += fmt::format("\n{}:\n", escaped(input));
  return text;
}

} // namespace tilepack
