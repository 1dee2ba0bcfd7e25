#include "support/file_contents.h"
#include "support/noise_pack.h"
#include "support/scratch_folder.h"

#include "tilepack/bake/packing.h"
#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/mip/far_levels.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/pack_write.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <map>

using namespace tilepack;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

using test::bytes_of;
using test::put;

// Everything below a folder: name → bytes.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    all[fs::relative(entry.path(), folder).string()] = entry.is_regular_file() ? bytes_of(entry.path()) : "";
  return all;
}

template <typename Function>
std::string refusal(Function&& function, ErrorKind kind) {
  try {
    function();
  } catch (const Error& error) {
    CHECK(error.kind() == kind);
    return error.what();
  }
  FAIL_CHECK("no error was thrown");
  return "";
}

} // namespace

TEST_CASE("a pack comes back as it was written, and is written again to the same bytes", "[pack]") {
  const ScratchFolder temporary;
  for (const MappingKind mapping : {MappingKind::permutation, MappingKind::mix, MappingKind::index})
    for (const Depth depth : {Depth::u8, Depth::u16, Depth::f16, Depth::f32}) {
      const Pack pack = test::noise_pack(mapping, depth);
      write_pack(pack, temporary / "a");
      const Pack again = read_pack(temporary / "a");
      for (std::size_t m = 0; m < 2; ++m) CHECK(again.maps[m].levels == pack.maps[m].levels);
      CHECK(again.mapping.ids == pack.mapping.ids);
      CHECK(again.mip_mode == pack.mip_mode);
      write_pack(again, temporary / "b");
      CHECK(contents(temporary / "a") == contents(temporary / "b"));
      CHECK(read_pack(temporary / "a" / "pack.json").tile_size == pack.tile_size);
    }
}

TEST_CASE("far levels are files after those of tiles", "[pack]") {
  const ScratchFolder temporary;
  Pack pack = test::noise_pack();
  pack.full_chain = true;
  for (PackedMap& map : pack.maps)
    for (const Size size : far_level_sizes(pack.layout, pack.tile_size, pack.tile_levels))
      map.far_levels.push_back(
          quantised(test::noise(size.width, size.height, map.channels, 3, map.depth), map.depth));
  write_pack(pack, temporary / "a");
  const Pack again = read_pack(temporary / "a");
  CHECK(again.full_chain);
  for (std::size_t m = 0; m < pack.maps.size(); ++m) {
    CHECK(again.maps[m].levels == pack.maps[m].levels);
    CHECK(again.maps[m].far_levels == pack.maps[m].far_levels);
  }
  const std::size_t levels = pack.maps[0].levels.size() + pack.maps[0].far_levels.size();
  CHECK(std::filesystem::exists(temporary / "a" / ("color_" + std::to_string(levels - 1) + ".png")));
  write_pack(test::noise_pack(), temporary / "a"); // and go when a pack without them takes its place
  CHECK_FALSE(std::filesystem::exists(temporary / "a" / ("color_" + std::to_string(levels - 1) + ".png")));
}

TEST_CASE("an index map is stored in 8 bits, and in 16 for more than 256 tiles", "[pack]") {
  const ScratchFolder temporary;
  for (const int tiles : {256, 257}) {
    TileSet set{{4, 4}, {1, 1, 0}, std::vector<EdgeTile>(static_cast<std::size_t>(tiles)), {}, 0};
    set.maps = {{"color", Role::color, Encoding::srgb, Depth::u8, {}}};
    for (int id = 0; id < tiles; ++id)
      set.maps[0].tiles.push_back(test::noise(4, 4, 3, static_cast<std::uint64_t>(id)));
    PackingOptions options;
    options.layout = LayoutKind::array;
    options.mapping = MappingKind::index;
    options.virtual_size = {60, 50};
    const Pack pack = packed(std::move(set), options, 1);
    REQUIRE(*std::max_element(pack.mapping.ids.begin(), pack.mapping.ids.end()) == tiles - 1);
    write_pack(pack, temporary / std::to_string(tiles));
    CHECK(read_image((temporary / std::to_string(tiles) / "index.png").string(), Encoding::linear).depth ==
          (tiles > 256 ? Depth::u16 : Depth::u8));
    CHECK(read_pack(temporary / std::to_string(tiles)).mapping.ids == pack.mapping.ids);
  }
}

TEST_CASE("the number of threads leaves no trace", "[pack]") {
  const ScratchFolder temporary;
  const Pack pack = test::noise_pack();
  write_pack(pack, temporary / "many");
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  write_pack(pack, temporary / "one");
  CHECK(contents(temporary / "many") == contents(temporary / "one"));
}

TEST_CASE("an older pack is replaced, and files of others stay", "[pack]") {
  const ScratchFolder temporary;
  const fs::path folder = temporary / "p";
  write_pack(test::noise_pack(MappingKind::index, Depth::f16), folder);
  put(folder / "notes.txt", "mine");
  fs::create_directory(folder / "drafts");
  write_pack(test::noise_pack(MappingKind::mix, Depth::u16, 2), folder);
  write_pack(test::noise_pack(MappingKind::mix, Depth::u16, 2), temporary / "fresh");
  auto expected = contents(temporary / "fresh");
  expected["notes.txt"] = "mine";
  expected["drafts"] = "";
  CHECK(contents(folder) == expected);
}

TEST_CASE("folders with anything else in them are refused and left alone", "[pack]") {
  const ScratchFolder temporary;
  const fs::path folder = temporary / "p";
  fs::create_directory(folder);
  const Pack pack = test::noise_pack();
  const auto write = [&] { write_pack(pack, folder); };
  SECTION("other files") {
    put(folder / "holiday.png", "mine");
    CHECK_THAT(refusal(write, ErrorKind::cannot_write), Contains("holiday.png"));
  }
  SECTION("another pack.json") {
    put(folder / "pack.json", "{\"name\": \"an npm thing\"}");
    CHECK_THAT(refusal(write, ErrorKind::cannot_write), Contains("no readable tile pack"));
  }
  SECTION("a file in the way of a new one") {
    write_pack(test::noise_pack(MappingKind::mix, Depth::f16), folder);
    put(folder / "height_1.png", "mine");
    CHECK_THAT(refusal(write, ErrorKind::cannot_write), Contains("height_1.png"));
  }
  SECTION("a folder in the way of a new file") {
    write_pack(test::noise_pack(MappingKind::mix, Depth::f16), folder);
    fs::create_directory(folder / "height_2.png");
    CHECK_THAT(refusal(write, ErrorKind::cannot_write), Contains("height_2.png"));
  }
  const auto before = contents(folder);
  CHECK_THROWS_AS(write(), Error);
  CHECK(contents(folder) == before);
}

TEST_CASE("a file where the folder should be is refused", "[pack]") {
  const ScratchFolder temporary;
  put(temporary / "p", "mine");
  CHECK_THAT(refusal([&] { write_pack(test::noise_pack(), temporary / "p"); }, ErrorKind::cannot_write),
             Contains("is no folder"));
  refusal([&] { write_pack(test::noise_pack(), temporary / "p" / "q"); }, ErrorKind::cannot_write);
  CHECK(bytes_of(temporary / "p") == "mine");
}

TEST_CASE("a cancelled or failing write leaves nothing", "[pack]") {
  const ScratchFolder temporary;
  struct Cancelled {};
  const Progress cancel = [](std::string_view, double done) {
    if (done > 0.1) throw Cancelled();
  };
  CHECK_THROWS_AS(write_pack(test::noise_pack(), temporary / "a" / "b" / "c", cancel), Cancelled);
  CHECK(contents(temporary.path).empty());
  write_pack(test::noise_pack(), temporary / "p");
  const auto before = contents(temporary.path);
  CHECK_THROWS_AS(write_pack(test::noise_pack(MappingKind::mix), temporary / "p", cancel), Cancelled);
  CHECK(contents(temporary.path) == before);
}

TEST_CASE("what a killed process left behind is no obstacle", "[pack]") {
  const ScratchFolder temporary;
  fs::create_directories(temporary / "p" / ".tilepack-staging" / "retired");
  put(temporary / "p" / ".tilepack-staging" / "color_0.png", "half");
  write_pack(test::noise_pack(), temporary / "p");
  CHECK_FALSE(fs::exists(temporary / "p" / ".tilepack-staging"));
}

TEST_CASE("files that do not match pack.json are refused", "[pack]") {
  const ScratchFolder temporary;
  const fs::path folder = temporary / "p";
  write_pack(test::noise_pack(MappingKind::index), folder);
  const auto read = [&] { read_pack(folder); };
  SECTION("missing") {
    fs::remove(folder / "color_1.png");
    CHECK_THAT(refusal(read, ErrorKind::cannot_read), Contains("color_1.png"));
  }
  SECTION("another size") {
    write_image(folder / "color_1.png", test::noise(16, 9, 3, 1), Depth::u8, Encoding::srgb);
    CHECK_THAT(refusal(read, ErrorKind::invalid_content), Contains("16 x 9 texels") && Contains("16 x 8"));
  }
  SECTION("other channels") {
    write_image(folder / "color_1.png", test::noise(16, 8, 4, 1), Depth::u8, Encoding::srgb);
    CHECK_THAT(refusal(read, ErrorKind::invalid_content), Contains("4 channels"));
  }
  SECTION("another depth") {
    write_image(folder / "color_1.png", test::noise(16, 8, 3, 1), Depth::u16, Encoding::srgb);
    CHECK_THAT(refusal(read, ErrorKind::invalid_content), Contains("depth u16"));
  }
  SECTION("a tile that is not there") {
    Image index(6, 5, 1, 0.0f);
    index.texel(2, 3)[0] = 16.0f / 255.0f;
    write_image(folder / "index.png", index, Depth::u8, Encoding::linear);
    CHECK_THAT(refusal(read, ErrorKind::invalid_content), Contains("cell (2, 3) holds tile 16"));
  }
  SECTION("truncated") {
    fs::resize_file(folder / "color_0.png", 100);
    refusal(read, ErrorKind::cannot_read);
  }
  SECTION("no folder") {
    fs::remove_all(folder);
    refusal(read, ErrorKind::cannot_read);
  }
}
