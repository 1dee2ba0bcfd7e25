#include "value_check.h"

#include "tilepack/error/nearest_name.h"

#include <fmt/core.h>

#include <charconv>
#include <sstream>
#include <vector>

namespace tilepack::cli {
namespace {

std::string refusal(const std::string& text, const std::string& allowed) {
  return fmt::format("'{}' is not allowed; it must be {}", text, allowed);
}

std::vector<std::string> split(const std::string& words) {
  std::vector<std::string> list;
  std::istringstream text(words);
  for (std::string word; std::getline(text, word, '|');) list.push_back(word);
  return list;
}

template <typename Number>
bool parse(const std::string& text, Number& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && end == text.data() + text.size();
}

template <typename Condition>
Check number_where(Condition condition, const std::string& allowed) {
  return [=](const std::string& text) {
    double value = 0;
    return parse(text, value) && condition(value) ? std::string() : refusal(text, allowed);
  };
}

} // namespace

Check whole_number(std::int64_t lowest, std::int64_t highest, const std::string& note) {
  const std::string allowed = fmt::format("a whole number of {} to {}{}", lowest, highest, note);
  return [=](const std::string& text) {
    std::int64_t value = 0;
    const bool plain = parse(text, value) && text == fmt::format("{}", value); // CLI11 takes 010 for 8
    return plain && value >= lowest && value <= highest ? std::string() : refusal(text, allowed);
  };
}

Check number(double lowest, double highest, const std::string& note) {
  return number_where([=](double value) { return value >= lowest && value <= highest; },
                      fmt::format("a number of {} to {}{}", lowest, highest, note));
}

Check positive_number(double highest, const std::string& note) {
  return number_where([=](double value) { return value > 0 && value <= highest; },
                      fmt::format("a number above 0, up to {}{}", highest, note));
}

Check one_of(const std::string& words) {
  return [=](const std::string& text) {
    const bool good = !text.empty() && text.find('|') == std::string::npos &&
                      ("|" + words + "|").find("|" + text + "|") != std::string::npos;
    if (good) return std::string();
    const std::string nearest = nearest_name(text, split(words));
    return refusal(text, words) + (nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest));
  };
}

} // namespace tilepack::cli
