#include "tilepack/error/error.h"
#include "tilepack/error/nearest_name.h"

#include <array>
#include <catch2/catch.hpp>

using namespace tilepack;

TEST_CASE("nearest_name finds the name a typing mistake was meant to be") {
  const std::array<std::string, 4> known{"tile-size", "colors", "corner-pack", "seed"};
  CHECK(nearest_name("tilesize", known) == "tile-size");
  CHECK(nearest_name("colour", known) == "colors");
  CHECK(nearest_name("sede", known) == "seed");
}

TEST_CASE("nearest_name stays silent when nothing is near") {
  const std::array<std::string, 2> known{"tile-size", "seed"};
  CHECK(nearest_name("virtual", known).empty());
}

TEST_CASE("an error's kind decides the documented exit code") {
  CHECK(exit_code(ErrorKind::usage) == 1);
  CHECK(exit_code(ErrorKind::cannot_read) == 2);
  CHECK(exit_code(ErrorKind::invalid_content) == 3);
  CHECK(exit_code(ErrorKind::cannot_write) == 4);
  CHECK(exit_code(ErrorKind::check_failed) == 5);
  CHECK(exit_code(ErrorKind::internal) == 6);
  CHECK(std::string(Error(ErrorKind::usage, "--seed", "must be a number").what()) ==
        "--seed: must be a number");
}
