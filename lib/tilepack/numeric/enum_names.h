#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tilepack {

/// One enumerator and its name, as files, options and messages have it.
template <class Enum>
struct EnumName {
  Enum value;
  std::string_view name;
};
template <class Enum>
EnumName(Enum, std::string_view) -> EnumName<Enum>; // clang 14 deduces none
template <class Enum>
EnumName(Enum, const char*) -> EnumName<Enum>;

/// The one table of an enumeration's names: an array of EnumName, which stands beside the enumeration and
/// from which all below follows. Its order is that of messages and help.
///
///   template <> inline constexpr auto enum_names<Encoding> =
///       std::array{EnumName{Encoding::srgb, "srgb"}, EnumName{Encoding::linear, "linear"}};
template <class Enum>
inline constexpr auto enum_names = nullptr;

template <class Enum>
concept NamedEnum = !std::is_same_v<std::remove_cvref_t<decltype(enum_names<Enum>)>, std::nullptr_t>;

/// The name; empty for a value that is no enumerator.
template <NamedEnum Enum>
constexpr std::string_view name_of(Enum value) {
  for (const EnumName<Enum>& entry : enum_names<Enum>)
    if (entry.value == value) return entry.name;
  return {};
}

/// The enumerator of that name, if there is one.
template <NamedEnum Enum>
constexpr std::optional<Enum> enum_named(std::string_view name) {
  for (const EnumName<Enum>& entry : enum_names<Enum>)
    if (entry.name == name) return entry.value;
  return std::nullopt;
}

/// All names, in the order of the table.
template <NamedEnum Enum>
std::vector<std::string> names_of() {
  std::vector<std::string> names;
  for (const EnumName<Enum>& entry : enum_names<Enum>) names.emplace_back(entry.name);
  return names;
}

/// "a|b|c", as help has it.
std::string alternatives(const std::vector<std::string>& names);
template <NamedEnum Enum>
std::string alternatives_of() {
  return alternatives(names_of<Enum>());
}

/// Throws Error (usage): `where`: 'x' is no `noun`, did you mean 'y'?; there are a, b and c.
[[noreturn]] void refuse_name(std::string_view name, const std::string& where, std::string_view noun,
                              const std::vector<std::string>& known);

/// As enum_named, where a name that is unknown is the user's fault. `where` as in Error, `noun` what the
/// names are names of: "filter".
template <NamedEnum Enum>
Enum enum_called(std::string_view name, const std::string& where, std::string_view noun) {
  if (const std::optional<Enum> value = enum_named<Enum>(name)) return *value;
  refuse_name(name, where, noun, names_of<Enum>());
}

} // namespace tilepack
