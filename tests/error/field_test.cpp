#include "tilepack/error/error.h"
#include "tilepack/error/field.h"

#include <catch2/catch.hpp>

namespace tilepack {
namespace {

TEST_CASE("a field is spelled for its reader, all else stays") {
  const std::string text = "at most 64 (" + field("tile-size", "64") + "), or " + field("set") + "; 5 -- 7";
  CHECK(spelled(text, FieldSpelling::plain) == "at most 64 (tile-size 64), or set; 5 -- 7");
  CHECK(spelled(text, FieldSpelling::option) == "at most 64 (--tile-size 64), or --set; 5 -- 7");
  CHECK(spelled(text, FieldSpelling::json) == "at most 64 (\"tile-size\": \"64\"), or \"set\"; 5 -- 7");
  CHECK(spelled("", FieldSpelling::option).empty());
  CHECK(spelled("\x1c half a mark", FieldSpelling::option) == "\x1c half a mark");
}

TEST_CASE("an error tells the field to blame") {
  const Error error(ErrorKind::usage, field("layout"), "is no good; take " + field("coloring", "edge"));
  CHECK(error.field() == "layout");
  CHECK(error.what() == std::string("layout: is no good; take coloring edge"));
  CHECK(error.message(FieldSpelling::option) == "--layout: is no good; take --coloring edge");
  CHECK(Error(ErrorKind::cannot_read, "a.png", "is missing").field().empty());
  CHECK(Error(ErrorKind::cannot_read, "a.png: " + field("layout"), "is missing").field().empty());
  CHECK(Error(ErrorKind::usage, "", "plain").what() == std::string("plain"));
}

} // namespace
} // namespace tilepack
