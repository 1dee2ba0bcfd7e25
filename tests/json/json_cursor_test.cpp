#include "tilepack/error/error.h"
#include "tilepack/json/json_cursor.h"

#include <catch2/catch.hpp>

using namespace tilepack;
using Catch::Matchers::Contains;

namespace {

JsonCursor parsed(const std::string& text) {
  return JsonCursor::parse(text, "f.json");
}

// What the message says when `get` fails; it must be of the right kind.
template <typename Get>
std::string fault(Get&& get) {
  try {
    get();
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::invalid_content);
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("messages name the place, the value and the range", "[pack]") {
  const JsonCursor root =
      parsed(R"({"maps": [{"size": [3, 70000]}], "name": "x", "big": 18446744073709551615})");
  const JsonCursor side = root.member("maps").item(0).member("size").item(1);
  CHECK(fault([&] { side.integer(1, 65536); }) ==
        "f.json: maps[0].size[1]: 70000 is out of range; it must be 1 to 65536");
  CHECK(side.integer(1, 70000) == 70000);
  CHECK(fault([&] { root.member("nam"); }) == "f.json: the field \"nam\" is missing");
  CHECK_THAT(fault([&] { root.member("name").integer(0, 1); }),
             Contains("name: must be a whole number of 0 to 1"));
  CHECK_THAT(fault([&] { root.member("big").integer(0, INT64_MAX); }),
             Contains("18446744073709551615 is out"));
  CHECK_THAT(fault([&] { root.member("maps").array(2, 3); }),
             Contains("maps: has 1 entries; it must have 2 to 3"));
  CHECK_THAT(fault([&] { root.member("name").one_of({"a", "b"}); }), Contains(R"(one of "a", "b")"));
  CHECK_THAT(fault([&] { root.only({"maps", "named", "big"}); }), Contains("did you mean \"named\""));
  CHECK(fault([&] { root.member("maps").item(0).only({"sizes"}); }) ==
        R"(f.json: maps[0].size: unknown field; did you mean "sizes"?)");
  CHECK_THAT(fault([&] { parsed(R"({"a b": 1})").only({"c"}); }),
             Contains(R"(f.json: unknown field "a b"; known are c)"));
  const std::string endless(100'000, 'a');
  CHECK(fault([&] { parsed(R"({")" + endless + R"(": 1})").only({"c"}); }).size() < 100);
}

TEST_CASE("values of the wrong type are refused", "[pack]") {
  for (const char* value : {"null", "true", "1.5", "1e3", "\"1\"", "[1]", "{}", "-0.0"}) {
    INFO(value);
    CHECK_THROWS_AS(parsed(value).integer(-10, 2000), Error);
  }
  CHECK_THROWS_AS(parsed("1").text(), Error);
  CHECK_THROWS_AS(parsed("1").boolean(), Error);
  CHECK_THROWS_AS(parsed("\"1\"").number(0, 1), Error);
  CHECK_THROWS_AS(parsed("1.5").number(0, 1), Error);
  CHECK_THROWS_AS(parsed("[]").member("a"), Error);
  CHECK_THROWS_AS(parsed("{}").array(0, 9), Error);
  CHECK_THROWS_AS(parsed("\"12345\"").text(4), Error);
  CHECK(parsed("0.25").number(0, 1) == 0.25);
}

TEST_CASE("documents that readers could take differently are refused", "[pack]") {
  CHECK_THAT(fault([] { parsed(R"({"a": {"b": 1, "c": 2, "b": 3}})"); }), Contains("\"b\" stands twice"));
  CHECK_NOTHROW(parsed(R"({"a": {"b": 1}, "c": {"b": 1}})"));
  CHECK_THAT(fault([] { parsed("{\"a\": 1e999}"); }), Contains("number overflow"));
  CHECK_THAT(fault([] { parsed("{\"a\": 1,}"); }), Contains("no valid JSON"));
  CHECK_THAT(fault([] { parsed("{} {}"); }), Contains("no valid JSON"));
  CHECK_THROWS_AS(parsed(""), Error);
  const std::string message = fault([] { parsed("{\"a\": \"\xff\x1b\"}"); });
  CHECK(message.find_first_of("\xff\x1b") == std::string::npos);
  const std::string deep(1'000'000, '[');
  CHECK_THAT(fault([&] { parsed(deep); }), Contains("nested deeper"));
}

TEST_CASE("long and wild values are shortened in messages", "[pack]") {
  const std::string wild = "\"" + std::string(1000, 'a') + "\\u001b[2J\"";
  CHECK(parsed(wild).shown().size() < 60);
  CHECK(parsed("\"\\u001b[2J\"").shown() == "\"\\u001b[2J\"");
  CHECK(parsed("[1,2]").shown() == "an array");
}
