#include "tilepack/json/json_value.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cassert>

namespace tilepack {
namespace {

using Json = nlohmann::ordered_json;

// A name or value from a broken file may hold any bytes; what is written stays valid UTF-8.
constexpr auto replaced = Json::error_handler_t::replace;

std::string flat_text(const Json& value) {
  return value.dump(-1, ' ', false, replaced);
}

void fill(const Json& value, std::size_t width, std::size_t indent, std::size_t used, std::string& out) {
  const std::string flat = flat_text(value);
  if (!value.is_structured() || used + flat.size() <= width) {
    // dump() packs tightly; reread by a person, commas and colons want a space.
    bool inside_text = false;
    for (std::size_t i = 0; i < flat.size(); ++i) {
      out += flat[i];
      if (flat[i] == '\\')
        out += flat[++i];
      else if (flat[i] == '"')
        inside_text = !inside_text;
      else if (!inside_text && (flat[i] == ',' || flat[i] == ':'))
        out += ' ';
    }
    return;
  }
  const bool is_object = value.is_object();
  const bool runs_on = !is_object && std::all_of(value.begin(), value.end(),
                                                 [](const Json& entry) { return entry.is_number(); });
  const std::string start(indent + 2, ' ');
  out += is_object ? '{' : '[';
  std::size_t column = width;
  bool first = true;
  for (const auto& [name, entry] : value.items()) {
    if (!first) out += ',';
    std::string text = is_object ? flat_text(Json(name)) + ": " : "";
    fill(entry, width, indent + 2, indent + 2 + text.size() + 1, text);
    if (runs_on && column + text.size() + 2 <= width) {
      out += ' ';
      column += text.size() + 2;
    } else {
      out += '\n' + start;
      column = start.size() + text.size() + 1;
    }
    out += text;
    first = false;
  }
  out += '\n' + std::string(indent, ' ') + (is_object ? '}' : ']');
}

} // namespace

struct JsonPrinter {
  static Json converted(const JsonValue& value) {
    using Kind = JsonValue::Kind;
    switch (value.kind) {
    case Kind::null:
      break;
    case Kind::boolean:
      return value.whole != 0;
    case Kind::integer:
      return static_cast<std::int64_t>(value.whole);
    case Kind::natural:
      return value.whole;
    case Kind::real:
      return value.real;
    case Kind::text:
      return value.letters;
    case Kind::array: {
      Json list = Json::array();
      for (const JsonValue& entry : value.items) list.push_back(converted(entry));
      return list;
    }
    case Kind::object: {
      Json::object_t members;
      for (std::size_t i = 0; i < value.items.size(); ++i)
        members.emplace_back(value.names[i], converted(value.items[i]));
      return Json(std::move(members));
    }
    }
    return nullptr;
  }
};

JsonValue::JsonValue(double number) : kind(Kind::real), real(number) {}
JsonValue::JsonValue(const char* text) : kind(Kind::text), letters(text) {}
JsonValue::JsonValue(std::string_view text) : kind(Kind::text), letters(text) {}
JsonValue::JsonValue(std::string text) : kind(Kind::text), letters(std::move(text)) {}

JsonValue::JsonValue(std::initializer_list<Member> members) : kind(Kind::object) {
  for (const Member& member : members) {
    if (std::find(names.begin(), names.end(), member.name) != names.end()) continue;
    names.push_back(member.name);
    items.push_back(member.value);
  }
}

JsonValue JsonValue::array(std::initializer_list<JsonValue> entries) {
  JsonValue value;
  value.kind = Kind::array;
  value.items.assign(entries.begin(), entries.end());
  return value;
}

JsonValue JsonValue::object() {
  JsonValue value;
  value.kind = Kind::object;
  return value;
}

JsonValue& JsonValue::operator[](std::string_view name) {
  assert(kind == Kind::object || kind == Kind::null);
  kind = Kind::object;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return items[static_cast<std::size_t>(found - names.begin())];
  names.emplace_back(name);
  return items.emplace_back();
}

void JsonValue::push_back(JsonValue entry) {
  assert(kind == Kind::array || kind == Kind::null);
  kind = Kind::array;
  items.push_back(std::move(entry));
}

std::string json_text(const JsonValue& value, JsonLetters letters) {
  return JsonPrinter::converted(value).dump(2, ' ', letters == JsonLetters::ascii, replaced) + '\n';
}

std::string filled_json_text(const JsonValue& value, std::size_t width) {
  std::string text;
  fill(JsonPrinter::converted(value), width, 0, 0, text);
  return text + '\n';
}

} // namespace tilepack
