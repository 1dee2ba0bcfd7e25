#include "tilepack/json/json_schema.h"

#include "tilepack/error/nearest_name.h"
#include "tilepack/json/json_limits.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace tilepack {
namespace {

using Json = nlohmann::ordered_json; // problems come in the order of the document
using Problems = std::vector<SchemaProblem>;
using Kind = SchemaProblem::Kind;

constexpr std::size_t most_problems = 1000;

std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("an array of {}", value.size());
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > longest_shown) text = text.substr(0, longest_shown) + "...";
  return text;
}

// "[json.exception.parse_error.101] parse error at line 3, ...: last read: '...'", without the first brackets
// and without bytes of the file that a terminal could take for commands.
std::string parser_words(const Json::exception& error) {
  std::string what = error.what();
  const std::size_t prefix = what.find("] ");
  if (prefix != std::string::npos) what.erase(0, prefix + 2);
  for (char& letter : what)
    if (letter < ' ' || letter > '~') letter = '?';
  return what;
}

std::string member_path(const std::string& path, const std::string& name) {
  const std::string plain = Json(name).dump(-1, ' ', true, Json::error_handler_t::replace);
  const std::string shortened = plain.substr(1, std::min(plain.size() - 2, longest_shown));
  return path.empty() ? shortened : path + "." + shortened;
}

bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  if (type == "boolean") return value.is_boolean();
  return value.is_null();
}

// Integers beyond 64 bits arrive as doubles, which is near enough to be told out of range.
double as_number(const Json& value) {
  return value.get<double>();
}

std::string range_text(const Json& schema, const char* low, const char* high, const char* what) {
  if (schema.contains(low) && schema.contains(high)) {
    if (schema[low] == schema[high]) return fmt::format("{}{}", schema[low].dump(), what);
    return fmt::format("{} to {}{}", schema[low].dump(), schema[high].dump(), what);
  }
  if (schema.contains(low)) return fmt::format("at least {}{}", schema[low].dump(), what);
  return fmt::format("at most {}{}", schema[high].dump(), what);
}

bool outside(double value, const Json& schema, const char* low, const char* high) {
  return (schema.contains(low) && value < as_number(schema[low])) ||
         (schema.contains(high) && value > as_number(schema[high]));
}

class Checker {
public:
  explicit Checker(const Json& whole_schema) : root(whole_schema) {}

  void check(const Json& value, const Json& schema, const std::string& path, Problems& problems) const {
    if (problems.size() >= most_problems) return;
    if (schema.contains("$ref")) check(value, referred(schema["$ref"].get<std::string>()), path, problems);
    if (schema.contains("type") && !has_type(value, schema["type"].get<std::string>())) {
      problems.push_back({Kind::type, path, shown(value), type_text(schema)});
      return;
    }
    check_values(value, schema, path, problems);
    if (value.is_number() && outside(as_number(value), schema, "minimum", "maximum"))
      problems.push_back({Kind::range, path, shown(value), range_text(schema, "minimum", "maximum", "")});
    if (value.is_string() && outside(static_cast<double>(value.get_ref<const std::string&>().size()), schema,
                                     "minLength", "maxLength"))
      problems.push_back(
          {Kind::range, path, shown(value), range_text(schema, "minLength", "maxLength", " characters")});
    if (value.is_array()) check_array(value, schema, path, problems);
    if (value.is_object()) check_object(value, schema, path, problems);
    check_combined(value, schema, path, problems);
  }

private:
  static std::string type_text(const Json& schema) {
    const std::string type = schema["type"].get<std::string>();
    const std::string article = type == "array" || type == "object" || type == "integer" ? "an " : "a ";
    if (type == "integer" && (schema.contains("minimum") || schema.contains("maximum")))
      return article + type + " of " + range_text(schema, "minimum", "maximum", "");
    return article + type;
  }

  static void check_values(const Json& value, const Json& schema, const std::string& path,
                           Problems& problems) {
    if (schema.contains("const") && value != schema["const"])
      problems.push_back({Kind::range, path, shown(value), schema["const"].dump()});
    if (!schema.contains("enum")) return;
    const Json& choices = schema["enum"];
    if (std::find(choices.begin(), choices.end(), value) != choices.end()) return;
    std::string list;
    for (const Json& choice : choices) list += (list.empty() ? "" : ", ") + choice.dump();
    problems.push_back({Kind::range, path, shown(value), "one of " + list});
  }

  void check_array(const Json& value, const Json& schema, const std::string& path, Problems& problems) const {
    if (outside(static_cast<double>(value.size()), schema, "minItems", "maxItems"))
      problems.push_back(
          {Kind::range, path, shown(value), range_text(schema, "minItems", "maxItems", " entries")});
    if (!schema.contains("items")) return;
    for (std::size_t i = 0; i < value.size(); ++i)
      check(value[i], schema["items"], fmt::format("{}[{}]", path, i), problems);
  }

  void check_object(const Json& value, const Json& schema, const std::string& path,
                    Problems& problems) const {
    static const Json none = Json::object();
    const Json& properties = schema.contains("properties") ? schema["properties"] : none;
    if (schema.contains("required"))
      for (const Json& name : schema["required"])
        if (!value.contains(name.get<std::string>()))
          problems.push_back(
              {Kind::missing, member_path(path, name.get<std::string>()), "nothing", "the field"});
    for (const auto& [name, member] : value.items()) {
      const std::string place = member_path(path, name);
      if (properties.contains(name))
        check(member, properties[name], place, problems);
      else if (schema.contains("additionalProperties"))
        check_additional(name, member, schema["additionalProperties"], properties, place, problems);
    }
  }

  void check_additional(const std::string& name, const Json& member, const Json& rule, const Json& properties,
                        const std::string& place, Problems& problems) const {
    if (rule.is_object()) {
      check(member, rule, place, problems);
    } else if (rule == false) {
      std::vector<std::string> known;
      for (const auto& [property, unused] : properties.items()) known.push_back(property);
      const std::string nearest = nearest_name(name, known);
      problems.push_back({Kind::unknown, place, shown(member),
                          nearest.empty() ? "no such field" : fmt::format("\"{}\", perhaps", nearest)});
    }
  }

  void check_combined(const Json& value, const Json& schema, const std::string& path,
                      Problems& problems) const {
    if (schema.contains("oneOf")) {
      const Problems fewest = fewest_problems(value, schema["oneOf"], path);
      problems.insert(problems.end(), fewest.begin(), fewest.end());
    }
    if (schema.contains("allOf"))
      for (const Json& part : schema["allOf"]) check(value, part, path, problems);
    if (schema.contains("if")) {
      Problems unmet;
      check(value, schema["if"], path, unmet);
      const char* branch = unmet.empty() ? "then" : "else";
      if (schema.contains(branch)) check(value, schema[branch], path, problems);
    }
  }

  Problems fewest_problems(const Json& value, const Json& alternatives, const std::string& path) const {
    Problems best;
    bool first = true;
    for (const Json& alternative : alternatives) {
      Problems problems;
      check(value, alternative, path, problems);
      if (first || problems.size() < best.size()) best = std::move(problems);
      first = false;
    }
    return best;
  }

  const Json& referred(const std::string& reference) const {
    return root.at(Json::json_pointer(reference.substr(1))); // "#/$defs/name"
  }

  const Json& root;
};

// A condition may check the same field a second time.
Problems without_repeats(const Problems& problems) {
  Problems result;
  for (const SchemaProblem& problem : problems)
    if (std::find(result.begin(), result.end(), problem) == result.end()) result.push_back(problem);
  return result;
}

} // namespace

Problems schema_problems(std::string_view document, std::string_view schema) {
  Json value;
  try {
    const auto shallow = [](int depth, Json::parse_event_t, const Json&) {
      if (depth > deepest_nesting) throw Json::other_error::create(501, "nested too deeply", nullptr);
      return true;
    };
    value = Json::parse(document, shallow);
  } catch (const Json::exception& error) {
    return {{Kind::no_json, "", parser_words(error), "a JSON document"}};
  }
  const Json rules = Json::parse(schema);
  Problems problems;
  Checker(rules).check(value, rules, "", problems);
  return without_repeats(problems);
}

} // namespace tilepack
