#include "tilepack/bake/depfile.h"

#include <fmt/format.h>

namespace tilepack {
namespace {

std::string escaped(const std::string& path) {
  std::string text;
  for (const char c : path) {
    if (c == '$') text += '$';
    if (c == ' ' || c == '\t' || c == '#' || c == ':') text += '\\';
    text += c;
  }
  return text;
}

} // namespace

std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs) {
  std::string text = escaped(target) + ":";
  for (const std::string& input : inputs) text += fmt::format(" \\\n  {}", escaped(input));
  text += '\n';
  for (const std::string& input : inputs) text += fmt::format("\n{}:\n", escaped(input));
  return text;
}

} // namespace tilepack
