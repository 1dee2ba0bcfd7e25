#include "tilepack/json/json_value.h"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace tilepack;
using Json = nlohmann::ordered_json;

TEST_CASE("A document has its members in the order in which they came") {
  JsonValue value{{"zebra", 1}, {"ant", JsonValue::array({1, "two", nullptr, true, JsonValue::object()})}};
  value["map"]["psnr"] = std::optional<double>();
  value["map"]["ssim"] = std::optional<double>(0.5);
  value["files"] = std::vector<std::string>{"a.png", "b.png"};
  value["files"].push_back("pack.json");
  value["zebra"] = 2;
  value["list"].push_back({{"id", value["files"].size()}});
  value["list"].back()["more"] = JsonValue::array();
  CHECK(json_text(value) == R"({
  "zebra": 2,
  "ant": [
    1,
    "two",
    null,
    true,
    {}
  ],
  "map": {
    "psnr": null,
    "ssim": 0.5
  },
  "files": [
    "a.png",
    "b.png",
    "pack.json"
  ],
  "list": [
    {
      "id": 3,
      "more": []
    }
  ]
}
)");
}

TEST_CASE("Numbers are written as the parser's own library writes them") {
  for (const double number : {0.0, -0.0, 1.0, 0.1, 1.0 / 3, 1e-7, 1e21, 123456789.0, 5e-324, -2.5e300})
    CHECK(json_text(number) == Json(number).dump() + "\n");
  CHECK(json_text(INFINITY) == "null\n");
  CHECK(json_text(std::nan("")) == "null\n");
  CHECK(json_text(0.1f) == Json(0.1f).dump() + "\n");
  CHECK(json_text(std::numeric_limits<std::int64_t>::min()) == "-9223372036854775808\n");
  CHECK(json_text(std::numeric_limits<std::uint64_t>::max()) == "18446744073709551615\n");
  CHECK(json_text(-1) == "-1\n");
}

TEST_CASE("Of two members of one name the first counts") {
  CHECK(json_text({{"a", 1}, {"a", 2}}) == "{\n  \"a\": 1\n}\n");
}

TEST_CASE("Text stays valid UTF-8 whatever a name holds") {
  CHECK(json_text("a\"b\\c\n\x01") == "\"a\\\"b\\\\c\\n\\u0001\"\n");
  CHECK(json_text("\u00fc") == "\"\u00fc\"\n");
  CHECK(json_text("\u00fc", JsonLetters::ascii) == "\"\\u00fc\"\n");
  CHECK(json_text("x\xff") == "\"x\ufffd\"\n");
}

TEST_CASE("Filled text puts on a line what fits it") {
  JsonValue numbers = JsonValue::array();
  for (int i = 0; i < 30; ++i) numbers.push_back(i);
  const JsonValue value{{"table", numbers}, {"kind", "a,b: \"c\""}, {"size", JsonValue::array({4, 5})}};
  CHECK(filled_json_text(value, 40) == R"({
  "table": [
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10,
    11, 12, 13, 14, 15, 16, 17, 18, 19,
    20, 21, 22, 23, 24, 25, 26, 27, 28,
    29
  ],
  "kind": "a,b: \"c\"",
  "size": [4, 5]
}
)");
  CHECK(filled_json_text({{"size", JsonValue::array({4, 5})}}) == "{\"size\": [4, 5]}\n");
}
