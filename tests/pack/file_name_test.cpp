#include "support/noise_pack.h"
#include "support/scratch_folder.h"

#include "tilepack/error/error.h"
#include "tilepack/pack/file_name.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <sys/stat.h>

using namespace tilepack;
namespace fs = std::filesystem;

TEST_CASE("names of files stay below the folder", "[pack]") {
  for (const char* good : {"a.png", "a/b.png", "..a", "a..", "...", "a b", "corner.color_0.png"}) {
    INFO(good);
    CHECK(file_name_fault(good) == "");
  }
  for (const char* bad : {"", "/", "/etc/passwd", "..", "../a", "a/../b", "a/..", ".", "./a", "a//b", "a/",
                          "a\\b", "C:a", "a\nb", "a\x7f"}) {
    INFO(bad);
    CHECK(file_name_fault(bad) != "");
  }
  CHECK(file_name_fault(std::string_view("a\0b", 3)) != "");
}

TEST_CASE("names of maps are safe on every file system", "[pack]") {
  for (const char* good : {"color", "A-1_b", "0"}) CHECK(is_map_name(good));
  for (const char* bad : {"", "a.b", "a/b", "a b", "é", "a:b"}) CHECK_FALSE(is_map_name(bad));
  CHECK(is_map_name(std::string(64, 'a')));
  CHECK_FALSE(is_map_name(std::string(65, 'a')));
}

TEST_CASE("only plain files inside the folder are opened", "[pack]") {
  const ScratchFolder temporary;
  const fs::path pack = temporary / "pack";
  fs::create_directories(pack / "sub");
  std::ofstream(temporary / "outside.png") << "x";
  std::ofstream(pack / "inside.png") << "x";
  fs::create_symlink("inside.png", pack / "good_link.png");
  fs::create_symlink("../outside.png", pack / "bad_link.png");
  fs::create_directory_symlink("..", pack / "up");
  REQUIRE(mkfifo((pack / "pipe.png").c_str(), 0600) == 0);

  CHECK(inside_folder(pack, "inside.png") == pack / "inside.png");
  CHECK_NOTHROW(inside_folder(pack, "good_link.png"));
  const auto kind = [&](const char* name) {
    try {
      inside_folder(pack, name);
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::internal;
  };
  CHECK(kind("missing.png") == ErrorKind::cannot_read);
  CHECK(kind("bad_link.png") == ErrorKind::invalid_content);
  CHECK(kind("up/outside.png") == ErrorKind::invalid_content);
  CHECK(kind("sub") == ErrorKind::invalid_content);
  CHECK(kind("pipe.png") == ErrorKind::invalid_content);
}
