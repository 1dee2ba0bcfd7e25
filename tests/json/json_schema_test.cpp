#include "support/good_pack.h"

#include "tilepack/json/json_schema.h"
#include "tilepack/pack/pack_json.h"
#include "tilepack/pack/pack_schema.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>
#include <functional>
#include <set>

using namespace tilepack;
using namespace tilepack::test;
using Kind = SchemaProblem::Kind;

namespace {

constexpr const char* small_schema = R"({
  "type": "object", "additionalProperties": false, "required": ["name", "size"],
  "properties": {
    "name": { "type": "string", "maxLength": 4 },
    "size": { "$ref": "#/$defs/size" },
    "kind": { "oneOf": [ { "type": "object", "required": ["a"], "additionalProperties": false,
                           "properties": { "a": { "const": 1 } } },
                         { "type": "object", "required": ["b", "c"], "additionalProperties": false,
                           "properties": { "b": { "type": "boolean" }, "c": { "enum": ["x", "y"] } } } ] } },
  "if": { "properties": { "name": { "const": "big" } } },
  "then": { "properties": { "size": { "items": { "minimum": 100 } } } },
  "$defs": { "size": { "type": "array", "minItems": 2, "maxItems": 2,
                       "items": { "type": "integer", "minimum": 1, "maximum": 1000 } } } })";

std::vector<SchemaProblem> problems(const std::string& document) {
  return schema_problems(document, small_schema);
}

void check_one(const std::string& document, Kind kind, const std::string& where) {
  const auto found = problems(document);
  INFO(document);
  REQUIRE(found.size() == 1);
  CHECK(found[0].kind == kind);
  CHECK(found[0].where == where);
  CHECK_FALSE(found[0].found.empty());
  CHECK_FALSE(found[0].expected.empty());
}

} // namespace

TEST_CASE("a document that keeps its schema has no problems") {
  CHECK(problems(R"({"name": "abc", "size": [1, 1000]})").empty());
  CHECK(problems(R"({"name": "big", "size": [100, 1000], "kind": {"a": 1}})").empty());
  CHECK(problems(R"({"name": "abc", "size": [2, 3], "kind": {"b": true, "c": "y"}})").empty());
}

TEST_CASE("each kind of problem is named with its place") {
  check_one("{", Kind::no_json, "");
  check_one("", Kind::no_json, "");
  check_one("[]", Kind::type, "");
  check_one(R"({"size": [100, 200]})", Kind::missing, "name");
  check_one(R"({"name": "abc", "size": [1, 2], "nmae": 1})", Kind::unknown, "nmae");
  check_one(R"({"name": 7, "size": [1, 2]})", Kind::type, "name");
  check_one(R"({"name": "abcde", "size": [1, 2]})", Kind::range, "name");
  check_one(R"({"name": "abc", "size": [1]})", Kind::range, "size");
  check_one(R"({"name": "abc", "size": [1, 2.5]})", Kind::type, "size[1]");
  check_one(R"({"name": "abc", "size": [0, 2]})", Kind::range, "size[0]");
  check_one(R"({"name": "abc", "size": [1, 99999999999999999999999]})", Kind::type, "size[1]");
  check_one(R"({"name": "abc", "size": [1, 18446744073709551615]})", Kind::range, "size[1]");
  check_one(R"({"name": "big", "size": [99, 200]})", Kind::range, "size[0]");
  check_one(R"({"name": "abc", "size": [1, 2], "kind": {"b": true, "c": "z"}})", Kind::range, "kind.c");
}

TEST_CASE("all problems are listed, and a misspelt field is told from a strange one") {
  const auto found = problems(R"({"nane": "x", "zzzzzz": 1, "size": [100, "b", 300]})");
  std::set<std::string> places;
  for (const SchemaProblem& problem : found) places.insert(problem.where);
  CHECK(places == std::set<std::string>{"name", "nane", "zzzzzz", "size", "size[1]"});
  for (const SchemaProblem& problem : found)
    if (problem.where == "nane") CHECK(problem.expected.find("\"name\"") != std::string::npos);
}

TEST_CASE("hostile documents end in problems, not in harm") {
  CHECK(problems(std::string(100000, '[')).size() == 1);
  CHECK(problems(R"({"name": "\ud800", "size": [1, 2]})").size() == 1);
  CHECK(problems("{\"name\": \"\xff\", \"size\": [1, 2]}").size() == 1);
  std::string many = R"({"name": "a", "size": [)";
  for (int i = 0; i < 5000; ++i) many += "\"x\",";
  CHECK(problems(many + "1]}").size() <= 1001);
  check_one(fmt::format(R"({{"name": "abc", "size": [1, 2], "{}": 1}})", std::string(100000, 'k')),
            Kind::unknown, std::string(48, 'k'));
}

TEST_CASE("what the library writes keeps the schema it ships") {
  for (const GoodPackOptions& options :
       {GoodPackOptions{}, GoodPackOptions{.colors = {3, 2, 0}, .depth = Depth::f16}}) {
    const auto found = schema_problems(pack_json(described(good_pack(options))), pack_schema());
    for (const SchemaProblem& problem : found) UNSCOPED_INFO(problem.where << " " << problem.found);
    CHECK(found.empty());
  }
}

TEST_CASE("the schema of packs uses only keywords that are understood here") {
  const std::set<std::string> understood{
      "$schema",   "$id",      "title",    "description", "$defs",      "$ref",
      "type",      "const",    "enum",     "required",    "properties", "additionalProperties",
      "items",     "minItems", "maxItems", "minimum",     "maximum",    "minLength",
      "maxLength", "oneOf",    "allOf",    "if",          "then",       "else",
      "pattern"};
  const std::function<void(const nlohmann::json&)> walk = [&](const nlohmann::json& schema) {
    if (!schema.is_object()) return;
    for (const auto& [keyword, value] : schema.items()) {
      INFO(keyword);
      CHECK(understood.contains(keyword));
      if (keyword == "properties" || keyword == "$defs")
        for (const auto& [name, part] : value.items()) walk(part);
      else if (value.is_array())
        for (const auto& part : value) walk(part);
      else if (keyword != "const")
        walk(value);
    }
  };
  walk(nlohmann::json::parse(pack_schema()));
}
