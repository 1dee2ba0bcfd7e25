#include "tilepack/image/channel_choice.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>

namespace tilepack {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

// What stands before the last letter of every name, if it is the same: "Le" of LeR LeG LeB.
std::string common_prefix(std::span<const std::string> names) {
  const auto before_last = [](const std::string& name) { return name.substr(0, name.size() - 1); };
  for (const std::string& name : names)
    if (name.empty() || before_last(name) != before_last(names.front())) return "";
  return before_last(names.front());
}

int number_of(const std::string& name, std::span<const std::string> names) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (lower(names[i]) == lower(name)) return static_cast<int>(i);
  return -1;
}

std::string listed(std::span<const std::string> names) {
  constexpr std::size_t most = 12;
  const auto shown = names.first(std::min(most, names.size()));
  return fmt::format("{}{}", fmt::join(shown, ", "), names.size() > most ? ", …" : "");
}

// The way out to offer: the color of the first layer that has one, else the first channel.
std::string proposal(std::span<const std::string> names) {
  for (const std::string& name : names) {
    if (name.empty() || lower(name).back() != 'r') continue;
    const std::string prefix = name.substr(0, name.size() - 1);
    const int g = number_of(prefix + "G", names), b = number_of(prefix + "B", names);
    if (g >= 0 && b >= 0)
      return fmt::format("{},{},{}", name, names[static_cast<std::size_t>(g)],
                         names[static_cast<std::size_t>(b)]);
  }
  return names.front();
}

} // namespace

ChannelChoice channels_by_name(std::span<const std::string> names, const std::string& file) {
  if (names.size() == 1) return {{0}, -1};
  const std::string prefix = common_prefix(names);
  for (const std::string_view set : {"RGBA", "RGB", "RG", "YA", "XYZ", "XY"}) {
    if (set.size() != names.size()) continue;
    ChannelChoice choice;
    for (const char letter : set) choice.from.push_back(number_of(prefix + letter, names));
    if (std::count(choice.from.begin(), choice.from.end(), -1) > 0) continue;
    if (set.back() == 'A') choice.alpha = static_cast<int>(set.size()) - 1;
    return choice;
  }
  throw Error(ErrorKind::invalid_content, file,
              fmt::format("has the channels {}, and which of them are the map can't be told: choose up to 4, "
                          "such as {}",
                          listed(names), field("channels", proposal(names))));
}

ChannelChoice channels_asked(std::string_view asked, std::span<const std::string> names,
                             const std::string& file) {
  ChannelChoice choice;
  std::string last;
  for (std::size_t at = 0; at <= asked.size();) {
    const std::size_t comma = std::min(asked.find(',', at), asked.size());
    last = std::string(asked.substr(at, comma - at));
    at = comma + 1;
    // As it stands first, since a file may have both r and R.
    const auto exact = std::find(names.begin(), names.end(), last);
    const int number =
        exact != names.end() ? static_cast<int>(exact - names.begin()) : number_of(last, names);
    if (number < 0)
      throw Error(ErrorKind::usage, field("channels"),
                  fmt::format("'{}' is no channel of {}; it has {}", last, file, listed(names)));
    choice.from.push_back(number);
  }
  if (choice.from.size() > 4)
    throw Error(ErrorKind::usage, field("channels"),
                fmt::format("'{}' are {} channels; a map has 1 to 4", asked, choice.from.size()));
  if (choice.from.size() % 2 == 0 && lower(last).back() == 'a')
    choice.alpha = static_cast<int>(choice.from.size()) - 1;
  return choice;
}

} // namespace tilepack
