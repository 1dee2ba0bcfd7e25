#include "support/noise_pack.h"
#include "support/scratch_folder.h"

#include "tilepack/error/error.h"
#include "tilepack/pack/pack_folder.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/pack_write.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <fstream>
#include <sys/resource.h>
#include <thread>

using namespace tilepack;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

Pack pack_of(std::uint64_t seed) {
  // Of two structures: other levels and other files.
  return test::noise_pack(seed % 2 == 0 ? MappingKind::mix : MappingKind::index,
                          seed % 2 == 0 ? Depth::u8 : Depth::u16, seed);
}

bool is_whole(const Pack& pack) {
  const Pack made = pack_of(pack.generator.seed);
  return pack.maps[0].levels == made.maps[0].levels && pack.maps[1].levels == made.maps[1].levels &&
         pack.mapping.ids == made.mapping.ids;
}

/// For as long as this lives, so many files may be open.
struct OpenFileLimit {
  rlimit before{};
  explicit OpenFileLimit(rlim_t most) {
    ::getrlimit(RLIMIT_NOFILE, &before);
    const rlimit limit{most, before.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &limit);
  }
  ~OpenFileLimit() { ::setrlimit(RLIMIT_NOFILE, &before); }
  OpenFileLimit(const OpenFileLimit&) = delete;
  OpenFileLimit& operator=(const OpenFileLimit&) = delete;
};

void read_beside_a_writer(const fs::path& folder) {
  constexpr std::uint64_t replacements = 100;
  std::atomic<bool> written = false;
  std::thread writer([&] {
    for (std::uint64_t seed = 2; seed <= replacements; ++seed) write_pack(pack_of(seed), folder);
    written = true;
  });
  int read = 0, mixed = 0, failed = 0;
  std::string message;
  while (!written || read == 0) {
    try {
      ++read;
      if (!is_whole(read_pack(folder))) ++mixed;
    } catch (const Error& error) {
      ++failed;
      message = error.what();
    }
  }
  writer.join();
  CAPTURE(read, message);
  CHECK(mixed == 0);
  CHECK(failed == 0);
  CHECK(read > 5);
  CHECK(is_whole(read_pack(folder)));
}

} // namespace

TEST_CASE("who reads a pack while it is replaced 100 times gets one of them, whole", "[pack]") {
  const ScratchFolder temporary;
  const fs::path folder = temporary / "p";
  write_pack(pack_of(1), folder);
  SECTION("swapped as a folder") {
    read_beside_a_writer(folder);
  }
  SECTION("moved file by file") {
    fs::create_directory(folder / "drafts");
    read_beside_a_writer(folder);
  }
#ifndef TILEPACK_SANITIZED // the sanitizer needs file descriptors of its own to look at types
  SECTION("with too few open files allowed to hold all") {
    const OpenFileLimit limit(32);
    read_beside_a_writer(folder);
  }
#endif
}

TEST_CASE("a pack that is held open stays what it was", "[pack]") {
  const ScratchFolder temporary;
  write_pack(pack_of(1), temporary / "p");
  const PackFolder held(temporary / "p");
  const auto entries = held.entries();
  write_pack(pack_of(2), temporary / "p");
  CHECK(read_pack(held).maps[0].levels == pack_of(1).maps[0].levels);
  fs::remove_all(temporary / "p");
  CHECK(read_pack(held).maps[1].levels == pack_of(1).maps[1].levels);
  CHECK_FALSE(held.is_stale());
  CHECK(entries.size() == held.description().all_files().size() + 1);
  const std::string name = held.description().all_files().front();
  CHECK(held.bytes_of(std::vector{name}).at(name) > 0);
}

TEST_CASE("what is wrong with a file of a held pack is said by the name the user knows", "[pack]") {
  const ScratchFolder temporary;
  const fs::path folder = temporary / "p";
  write_pack(pack_of(1), folder);
  SECTION("it is cut") {
    fs::resize_file(folder / "color_0.png", 60);
    CHECK_THROWS_WITH(read_pack(folder),
                      Contains((folder / "color_0.png: ").string()) && !Contains("/proc/"));
  }
  SECTION("it is missing") {
    fs::remove(folder / "color_0.png");
    CHECK_THROWS_WITH(read_pack(folder),
                      Contains((folder / "color_0.png: ").string()) && Contains("not there"));
  }
  SECTION("it is a link that leads out") {
    fs::rename(folder / "color_0.png", temporary / "elsewhere.png");
    fs::create_symlink("../elsewhere.png", folder / "color_0.png");
    CHECK_THROWS_WITH(read_pack(folder),
                      Contains((folder / "color_0.png: ").string()) && Contains("symbolic link"));
  }
  SECTION("it is a link within, which is nothing wrong") {
    fs::rename(folder / "color_0.png", folder / "elsewhere.png");
    fs::create_symlink("elsewhere.png", folder / "color_0.png");
    CHECK(is_whole(read_pack(folder)));
  }
}

TEST_CASE("files that a killed writer left half moved are refused if they can't be put back", "[pack]") {
  const ScratchFolder temporary;
  const fs::path folder = temporary / "p", staging = folder / ".tilepack-staging";
  write_pack(pack_of(1), folder);
  fs::create_directories(staging / "retired");
  std::ofstream(staging / "moves", std::ios::binary) << "opack.json" << '\0' << "ocolor_0.png" << '\0';
  fs::rename(folder / "pack.json", staging / "retired" / "0");
  SECTION("they can") {
    CHECK(is_whole(read_pack(folder)));
    CHECK_FALSE(fs::exists(staging));
  }
  SECTION("they can't") {
    std::ofstream(staging / "retired" / "2") << "an image";
    std::ofstream(staging / "moves", std::ios::binary | std::ios::app) << "osub/height_0.png" << '\0';
    CHECK_THROWS_WITH(read_pack(folder), Contains("a writer was killed while it replaced this pack"));
    CHECK(fs::exists(staging / "moves")); // for who gives the folder back
  }
}
