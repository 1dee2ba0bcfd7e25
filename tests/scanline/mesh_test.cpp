#include "tilepack/error/error.h"
#include "tilepack/scanline/mesh.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

std::string message_of(const std::string& text) {
  try {
    parse_obj(text, "a.obj", 1);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::invalid_content);
    return error.what();
  }
  return "no error";
}

} // namespace

TEST_CASE("faces become triangles with tile coordinates, v down") {
  const auto mesh = parse_obj(
      "# quad\r\no thing\n" + corners + "vn 0 0 1\nusemtl x\nf 1/1/1 2/2/1 3/3/1 4/4 # end\r\n", "a.obj", 4);
  REQUIRE(mesh.size() == 2);
  CHECK(mesh[0].corners[1] == Vec3{1, 0, 0});
  CHECK(mesh[1].corners[0] == Vec3{0, 0, 0});
  CHECK(mesh[1].corners[2] == Vec3{0, 1, 0});
  CHECK(mesh[0].u == std::array<double, 3>{0, 4, 4});
  CHECK(mesh[0].v == std::array<double, 3>{0, 0, -4});
  const auto relative = parse_obj(corners + "f -4/-4 -3/-3 -2/-2", "a.obj", 4);
  CHECK(relative[0].corners == mesh[0].corners);
  CHECK(relative[0].u == mesh[0].u);
}

TEST_CASE("what is wrong with a mesh is told with its line") {
  CHECK(message_of("") == "a.obj: no face in it; a mesh needs lines such as 'f 1/1 2/2 3/3'");
  CHECK(message_of("v 1 2\n") == "a.obj:1: a 'v' line needs 3 numbers");
  CHECK(message_of("\n\nvt 1\n") == "a.obj:3: a 'vt' line needs 2 numbers");
  CHECK(message_of("v 1 2 x\n") == "a.obj:1: 'x' is no number");
  CHECK(message_of("v 1 2 3e\n") == "a.obj:1: '3e' is no number");
  CHECK_THAT(message_of("v 1 nan 3\n"), Catch::Contains("nan is out of range"));
  CHECK_THAT(message_of("v 1 inf 3\n"), Catch::Contains("out of range"));
  CHECK_THAT(message_of("v 1 2e9 3\n"), Catch::Contains("-1e9..1e9"));
  CHECK_THAT(message_of("v 1 1e999 3\n"), Catch::Contains("a.obj:1"));
  CHECK(message_of(corners + "f 1/1 2/2\n") == "a.obj:9: a face of 2 corners; it needs 3 or more");
  CHECK(message_of(corners + "f 1 2 3\n") ==
        "a.obj:9: corner '1' has no texture coordinate; write it as vertex/texture");
  CHECK_THAT(message_of(corners + "f 1//1 2//1 3//1\n"), Catch::Contains("no texture coordinate"));
  CHECK_THAT(message_of(corners + "f 1/1 2/2 5/3\n"), Catch::Contains("there is no vertex 5; 4 are given"));
  CHECK_THAT(message_of(corners + "f 1/1 2/2 0/3\n"), Catch::Contains("there is no vertex 0"));
  CHECK_THAT(message_of(corners + "f 1/1 2/2 3/-5\n"), Catch::Contains("there is no texture coordinate -5"));
  CHECK_THAT(message_of(corners + "f 1/1 2/2 3/99999999999999999999\n"), Catch::Contains("whole number"));
  CHECK_THAT(message_of(corners + "f a/1 2/2 3/3\n"), Catch::Contains("'a' is no vertex index"));
  CHECK_THAT(message_of(std::string("f \0/1 2/2", 9)), Catch::Contains("a.obj:1"));
}
