#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A JSON document to be written: null, a boolean, a number, a text, an array or an object whose members keep
/// the order in which they came.
///
///   JsonValue tile{{"id", 3}, {"size", JsonValue::array({64, 32})}};   braces with names are an object
///   tile["colors"]["north"] = 1;                                       a null becomes an object, then an array
///   json_text(tile);
///
/// Reading is JsonCursor's; there is no way here to look into a document. The parser's large header stays in
/// json_value.cpp: a file that builds JSON compiles ten seconds faster than one that includes it.
class JsonValue {
public:
  struct Member;

  JsonValue() = default; ///< null
  JsonValue(std::nullptr_t) {}
  template <std::same_as<bool> T>
  JsonValue(T yes) : kind(Kind::boolean), whole(yes ? 1 : 0) {}
  template <std::signed_integral T>
  JsonValue(T number) : kind(Kind::integer), whole(static_cast<std::uint64_t>(std::int64_t{number})) {}
  template <std::unsigned_integral T>
  requires(!std::same_as<T, bool>) JsonValue(T number) : kind(Kind::natural), whole(number) {}
  JsonValue(double number); ///< written with as few digits as give it back; null if it isn't finite
  JsonValue(const char* text);
  JsonValue(std::string_view text); ///< UTF-8; other bytes are written as U+FFFD
  JsonValue(std::string text);
  /// An array of what such a vector holds.
  template <class T>
  JsonValue(const std::vector<T>& values) : kind(Kind::array), items(values.begin(), values.end()) {}
  /// The value, or null.
  template <class T>
  JsonValue(const std::optional<T>& value) {
    if (value) *this = JsonValue(*value);
  }
  /// An object; of members of one name the first counts.
  JsonValue(std::initializer_list<Member> members);

  static JsonValue array(std::initializer_list<JsonValue> entries = {});
  static JsonValue object();

  /// The member of an object, null and last if it is new; a null becomes an object. Asserts for others.
  JsonValue& operator[](std::string_view name);
  /// Appends to an array; a null becomes an array. Asserts for others.
  void push_back(JsonValue entry);
  JsonValue& back() { return items.back(); }        ///< the last entry or member; there must be one
  std::size_t size() const { return items.size(); } ///< entries or members

private:
  enum class Kind { null, boolean, integer, natural, real, text, array, object };
  friend struct JsonPrinter;

  Kind kind = Kind::null;
  std::uint64_t whole = 0; // of integers two's complement
  double real = 0;
  std::string letters;
  std::vector<std::string> names; // of an object, one for each of `items`
  std::vector<JsonValue> items;
};

struct JsonValue::Member {
  std::string name;
  JsonValue value;
};

enum class JsonLetters {
  utf8,
  ascii, ///< all others as \u and four hexadecimal digits
};

/// One entry or member a line, indented by 2; a newline at the end.
std::string json_text(const JsonValue& value, JsonLetters letters = JsonLetters::utf8);

/// For people: what fits `width` columns stands on one line, else one member or entry a line, and runs of
/// plain numbers are filled up to the width, so that a table of 512 takes 20 lines. A newline at the end.
std::string filled_json_text(const JsonValue& value, std::size_t width = 110);

} // namespace tilepack
