#include "tilepack/json/json_cursor.h"

#include "tilepack/error/error.h"
#include "tilepack/error/nearest_name.h"
#include "tilepack/json/json_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace tilepack {
namespace {

using nlohmann::json;

const json& value_at(const void* node) {
  return *static_cast<const json*>(node);
}

const char* kind_of(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array";
  return value.type_name();
}

// nlohmann-json keeps the last of two members of one name; which one another reader keeps is anyone's guess,
// so neither is accepted.
class MemberNames {
public:
  explicit MemberNames(const std::string& file_name) : file(file_name) {}

  bool operator()(int depth, json::parse_event_t event, json& parsed) {
    if (depth > deepest_nesting)
      throw Error(ErrorKind::invalid_content, file,
                  fmt::format("nested deeper than {} levels", deepest_nesting));
    if (event == json::parse_event_t::object_start) open_objects.emplace_back();
    if (event == json::parse_event_t::object_end) open_objects.pop_back();
    if (event == json::parse_event_t::key && !open_objects.back().insert(parsed.get<std::string>()).second)
      throw Error(ErrorKind::invalid_content, file,
                  fmt::format("{} stands twice in one object", parsed.dump()));
    return true;
  }

private:
  std::string file;
  std::vector<std::set<std::string>> open_objects;
};

// Stands in a place as it is.
bool is_plain(std::string_view name) {
  return !name.empty() && name.size() <= longest_shown && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

} // namespace

struct JsonCursor::Document {
  json root;
  std::string file;
};

JsonCursor JsonCursor::parse(std::string_view text, const std::string& file) {
  auto document = std::make_shared<Document>();
  document->file = file;
  try {
    document->root = json::parse(text, MemberNames(file));
  } catch (const json::exception& error) {
    std::string what = error.what(); // "[json.exception.parse_error.101] parse error at line 3, …"
    const std::size_t prefix = what.find("] ");
    // It quotes the text it stumbled over, which may be anything.
    for (char& c : what)
      if (c < ' ' || c > '~') c = '?';
    throw Error(ErrorKind::invalid_content, file,
                "is no valid JSON: " + (prefix == std::string::npos ? what : what.substr(prefix + 2)));
  }
  const void* root = &document->root;
  return {std::move(document), root, ""};
}

std::string JsonCursor::shown() const {
  const json& value = value_at(node);
  if (value.is_structured()) return kind_of(value);
  std::string text = value.dump(-1, ' ', true);
  if (text.size() > longest_shown) text = text.substr(0, longest_shown) + (value.is_string() ? "…\"" : "…");
  return text;
}

void JsonCursor::fail(const std::string& what) const {
  throw Error(ErrorKind::invalid_content, path.empty() ? document->file : document->file + ": " + path, what);
}

std::optional<JsonCursor> JsonCursor::find(std::string_view name) const {
  const json& value = value_at(node);
  if (!value.is_object()) fail(fmt::format("must be an object, and is {}", shown()));
  const auto found = value.find(name);
  if (found == value.end()) return std::nullopt;
  return JsonCursor(document, &*found, path.empty() ? std::string(name) : fmt::format("{}.{}", path, name));
}

JsonCursor JsonCursor::member(std::string_view name) const {
  if (auto found = find(name)) return *found;
  fail(fmt::format("the field \"{}\" is missing", name));
}

std::vector<std::string> JsonCursor::names() const {
  const json& value = value_at(node);
  if (!value.is_object()) fail(fmt::format("must be an object, and is {}", shown()));
  std::vector<std::string> list;
  for (const auto& [name, unused] : value.items()) list.push_back(name);
  return list;
}

void JsonCursor::only(std::span<const std::string> known) const {
  for (const std::string& name : names()) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string nearest = nearest_name(name, known);
    const std::string hint = nearest.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                                             : fmt::format("did you mean \"{}\"?", nearest);
    if (is_plain(name)) member(name).fail("unknown field; " + hint); // whose line can be told
    fail(fmt::format("unknown field {}; {}", json(name).dump(-1, ' ', true).substr(0, longest_shown), hint));
  }
}

std::size_t JsonCursor::array(std::size_t lowest, std::size_t highest) const {
  const json& value = value_at(node);
  if (!value.is_array()) fail(fmt::format("must be an array, and is {}", shown()));
  if (value.size() < lowest || value.size() > highest) {
    const std::string range =
        lowest == highest ? fmt::format("{}", lowest) : fmt::format("{} to {}", lowest, highest);
    fail(fmt::format("has {} entries; it must have {}", value.size(), range));
  }
  return value.size();
}

JsonCursor JsonCursor::item(std::size_t index) const {
  return {document, &value_at(node).at(index), fmt::format("{}[{}]", path, index)};
}

std::int64_t JsonCursor::integer(std::int64_t lowest, std::int64_t highest) const {
  const json& value = value_at(node);
  if (!value.is_number_integer())
    fail(fmt::format("must be a whole number of {} to {}, and is {}", lowest, highest, shown()));
  // Unsigned values past the signed range would turn negative on conversion.
  const bool fits =
      !value.is_number_unsigned() || value.get<std::uint64_t>() <= static_cast<std::uint64_t>(INT64_MAX);
  if (!fits || value.get<std::int64_t>() < lowest || value.get<std::int64_t>() > highest)
    fail(fmt::format("{} is out of range; it must be {}", shown(),
                     lowest == highest ? fmt::format("{}", lowest)
                                       : fmt::format("{} to {}", lowest, highest)));
  return value.get<std::int64_t>();
}

int JsonCursor::small_integer(int lowest, int highest) const {
  return static_cast<int>(integer(lowest, highest));
}

double JsonCursor::number(double lowest, double highest) const {
  const json& value = value_at(node);
  if (!value.is_number())
    fail(fmt::format("must be a number of {} to {}, and is {}", lowest, highest, shown()));
  const double number = value.get<double>();
  if (!(number >= lowest && number <= highest))
    fail(fmt::format("{} is out of range; it must be {} to {}", shown(), lowest, highest));
  return number;
}

bool JsonCursor::boolean() const {
  const json& value = value_at(node);
  if (!value.is_boolean()) fail(fmt::format("must be true or false, and is {}", shown()));
  return value.get<bool>();
}

std::string JsonCursor::text(std::size_t longest) const {
  const json& value = value_at(node);
  if (!value.is_string()) fail(fmt::format("must be a text, and is {}", shown()));
  std::string text = value.get<std::string>();
  if (text.size() > longest)
    fail(fmt::format("{} is {} bytes long; at most {} are allowed", shown(), text.size(), longest));
  return text;
}

std::size_t JsonCursor::one_of(std::span<const std::string> choices) const {
  const json& value = value_at(node);
  if (value.is_string()) {
    const auto found = std::find(choices.begin(), choices.end(), value.get_ref<const std::string&>());
    if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  }
  std::string list;
  for (const std::string& choice : choices) list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", choice);
  fail(fmt::format("is {}; it must be {}{}", shown(), choices.size() > 1 ? "one of " : "", list));
}

bool JsonCursor::is_object() const {
  return value_at(node).is_object();
}
bool JsonCursor::is_array() const {
  return value_at(node).is_array();
}
bool JsonCursor::is_text() const {
  return value_at(node).is_string();
}
bool JsonCursor::is_boolean() const {
  return value_at(node).is_boolean();
}
bool JsonCursor::is_integer() const {
  return value_at(node).is_number_integer();
}

bool JsonCursor::is_null() const {
  return value_at(node).is_null();
}

} // namespace tilepack
