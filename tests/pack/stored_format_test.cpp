#include "support/scratch_folder.h"

#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/pack/stored_format_for.h"
#include "tilepack/pack/texture_file.h"

#include <catch2/catch.hpp>

using namespace tilepack;

TEST_CASE("a map is stored as near to what it is as the request lets it", "[pack]") {
  const ImageContainer png = ImageContainer::png, exr = ImageContainer::exr;
  const Encoding srgb = Encoding::srgb, linear = Encoding::linear;
  struct Row {
    Role role;
    Encoding encoding;
    Depth depth;
    StorageRequest request;
    StoredFormat pack, picture;
  };
  const Row rows[] = {
      {Role::color, srgb, Depth::u8, {}, {png, Depth::u8, srgb}, {png, Depth::u8, srgb}},
      {Role::color, srgb, Depth::u8, {exr, {}}, {exr, Depth::f16, linear}, {exr, Depth::f16, linear, true}},
      {Role::color, srgb, Depth::u16, {exr, {}}, {exr, Depth::f16, linear}, {exr, Depth::f32, linear, true}},
      {Role::color, linear, Depth::f32, {png, {}}, {png, Depth::u16, srgb}, {png, Depth::u16, srgb}},
      {Role::color, linear, Depth::f32, {png, Depth::u8}, {png, Depth::u8, srgb}, {png, Depth::u8, srgb}},
      {Role::color,
       linear,
       Depth::f16,
       {{}, Depth::f32},
       {exr, Depth::f32, linear},
       {exr, Depth::f32, linear, true}},
      {Role::color, srgb, Depth::f16, {exr, {}}, {exr, Depth::f16, srgb}, {exr, Depth::f16, linear, true}},
      {Role::height, linear, Depth::f32, {png, {}}, {png, Depth::u16, linear}, {png, Depth::u16, linear}},
      {Role::data, srgb, Depth::u8, {exr, {}}, {exr, Depth::f16, srgb}, {exr, Depth::f16, linear, true}},
  };
  for (const Row& row : rows) {
    CAPTURE(&row - rows);
    const auto format = [&](StoredFor reader) {
      return stored_format_for(row.role, row.encoding, row.depth, row.request, reader);
    };
    CHECK(format(StoredFor::pack) == row.pack);
    CHECK(format(StoredFor::picture) == row.picture);
    CHECK(holds(row.pack.container, row.pack.depth));
  }
}

TEST_CASE("the name of a file asks for its container", "[pack]") {
  CHECK(container_by_name("a/b.png") == ImageContainer::png);
  CHECK(container_by_name("b.c.exr") == ImageContainer::exr);
  CHECK(container_by_name("b.PNG") == ImageContainer::png);
  CHECK(container_by_name("b.Exr") == ImageContainer::exr);
  for (const char* other : {"b.PN", "b.jpg", "png", ".png", "b", ""}) CHECK_FALSE(container_by_name(other));
}

TEST_CASE("files of a map: a PNG or EXR a level", "[pack]") {
  const std::vector<Size> sizes{{8, 4}, {4, 2}};
  const std::vector<TextureFile> files = texture_files("corner.a", sizes, ImageContainer::exr);
  CHECK(files == std::vector<TextureFile>{{"corner.a_0.exr", {{8, 4}}, 1}, {"corner.a_1.exr", {{4, 2}}, 1}});
  CHECK(levels_in(files) == 2);
  CHECK(level_sizes(files) == sizes);

  // Files that hold several levels are counted through.
  const std::vector<TextureFile> mixed{{"a.ktx2", {{8, 8}, {4, 4}}, 3}, {"b.ktx2", {{2, 2}}, 3}};
  CHECK(levels_in(mixed) == 3);
  CHECK(level_sizes(mixed) == std::vector<Size>{{8, 8}, {4, 4}, {2, 2}});

  const ScratchFolder folder;
  const std::vector<Image> two(2, Image(2, 2, 1));
  CHECK_THROWS_AS(write_texture_file(folder.path / "a.png", two, {}), std::logic_error);
}

TEST_CASE("a file is checked against what is announced before it is read", "[pack]") {
  const ScratchFolder folder;
  const std::vector<Image> level{Image(6, 4, 3, 0.2f)};
  const auto path = folder.path / "a.png";
  write_texture_file(path, level, {ImageContainer::png, Depth::u16, Encoding::linear});
  check_texture_file(path, {"a.png", {{6, 4}}}, 3, Depth::u16);
  CHECK_THROWS_AS(check_texture_file(path, {"a.png", {{6, 5}}}, 3, Depth::u16), Error);
  CHECK_THROWS_AS(check_texture_file(path, {"a.png", {{6, 4}}}, 1, Depth::u16), Error);
  CHECK_THROWS_AS(check_texture_file(path, {"a.png", {{6, 4}}}, 3, Depth::u8), Error);
  std::vector<Image> back(1);
  read_texture_file(path, Encoding::linear, back);
  CHECK(back.front() == quantised(level.front(), Depth::u16));
}
