#include "support/file_contents.h"
#include "support/foreign_file.h"
#include "support/scratch_folder.h"
#include "support/tiny_files.h"

#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/image_format.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>

using namespace tilepack;
using Catch::Contains;
using OIIO::ImageSpec;
using OIIO::TypeDesc;
namespace fs = std::filesystem;

namespace {

using test::bytes_of;
using test::put;

Image blocks(int channels) {
  Image image(64, 40, channels);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < channels; ++c)
        image.texel(x, y)[static_cast<std::size_t>(c)] = static_cast<float>(x + y + c * 40) / 255.0f;
  return image;
}

// 24 bits a texel, bottom row first.
std::string tga(const Image& image) {
  std::string bytes = std::string("\0\0\2\0\0\0\0\0\0\0\0\0", 12) +
                      tiny::little(static_cast<std::uint32_t>(image.width()), 2) +
                      tiny::little(static_cast<std::uint32_t>(image.height()), 2) + "\x18" +
                      std::string(1, '\0');
  for (int y = image.height() - 1; y >= 0; --y)
    for (int x = 0; x < image.width(); ++x)
      for (std::size_t c = 3; c > 0; --c) bytes += static_cast<char>(code_of(image.texel(x, y)[c - 1], 255));
  return bytes;
}

} // namespace

TEST_CASE("TGA, BMP, WebP, HDR and JPEG 2000 are read") {
  const ScratchFolder folder;
  struct Row {
    const char* format;
    const char* name;
    ImageFormat known_as;
    Encoding encoding;
    double margin; // of lossy ones
  };
  const Row rows[] = {
      {"targa", "a.tga", ImageFormat::tga, Encoding::srgb, 0},
      {"bmp", "a.bmp", ImageFormat::bmp, Encoding::srgb, 0},
      {"webp", "a.webp", ImageFormat::webp, Encoding::srgb, 0.12},
      {"hdr", "a.hdr", ImageFormat::hdr, Encoding::linear, 0.01},
      {"jpeg2000", "a.jp2", ImageFormat::jpeg2000, Encoding::srgb, 0.02},
  };
  for (const Row& row : rows) {
    CAPTURE(row.format);
    const fs::path file = folder.path / row.name;
    write_foreign(file, row.format, blocks(3),
                  row.encoding == Encoding::linear ? TypeDesc::FLOAT : TypeDesc::UINT8);
    CHECK(image_format(file) == row.known_as);
    const ImageFile back = read_image(file);
    CHECK(back.encoding == row.encoding);
    REQUIRE(back.image.size() == Size{64, 40});
    REQUIRE(back.image.channels() == 3);
    double worst = 0;
    for (std::size_t i = 0; i < back.image.data().size(); ++i)
      worst = std::max(worst, std::abs(double{back.image.data()[i]} - blocks(3).data()[i]));
    CHECK(worst <= row.margin);

    // Cut, each is an error, and said to be the file's fault.
    const std::string whole = bytes_of(file);
    for (const std::size_t length : {whole.size() / 8, whole.size() / 2, whole.size() * 3 / 4}) {
      put(file, whole.substr(0, length));
      CAPTURE(length, whole.size());
      CHECK_THROWS_AS(read_image(file), Error);
    }
  }
}

TEST_CASE("an old TGA, without a mark, is known by its name") {
  const ScratchFolder folder;
  put(folder.path / "a.tga", tga(blocks(3)));
  CHECK(read_image(folder.path / "a.tga").image == blocks(3));
  put(folder.path / "a.TGA", tga(blocks(3)));
  CHECK(read_image(folder.path / "a.TGA").image == blocks(3));
  put(folder.path / "a.dat", tga(blocks(3)));
  CHECK_THROWS_AS(read_image(folder.path / "a.dat"), Error);
  put(folder.path / "text.tga", "plain text, long enough for any header\n");
  CHECK_THROWS_AS(read_image(folder.path / "text.tga"), Error);
}

TEST_CASE("straight alpha of TGA stays") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.tga";
  ImageSpec spec;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  write_foreign(file, "targa", blocks(4), TypeDesc::UINT8, spec);
  CHECK(read_image(file).image == blocks(4));
}

TEST_CASE("DDS without compression is read") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.dds";
  // Header of 124 bytes: caps, height, width, pitch; a pixel format of 24 bits with masks.
  std::string head = "DDS " + tiny::little(124, 4) + tiny::little(0x100F, 4) + tiny::little(2, 4) +
                     tiny::little(3, 4) + tiny::little(9, 4) + std::string(8 + 44, '\0') +
                     tiny::little(32, 4) + tiny::little(0x40, 4) + tiny::little(0, 4) + tiny::little(24, 4) +
                     tiny::little(0xFF0000, 4) + tiny::little(0xFF00, 4) + tiny::little(0xFF, 4) +
                     tiny::little(0, 4) + tiny::little(0x1000, 4) + std::string(16, '\0');
  REQUIRE(head.size() == 128);
  std::string texels;
  for (int i = 0; i < 18; ++i) texels += static_cast<char>(i);
  put(file, head + texels);
  const ImageFile back = read_image(file);
  CHECK(back.image.size() == Size{3, 2});
  CHECK(back.image.texel(0, 0)[0] == 2 / 255.0f);
  CHECK(back.image.texel(0, 0)[2] == 0.0f);
}

TEST_CASE("messages list the formats") {
  const ScratchFolder folder;
  put(folder.path / "a", "GIF89a and more");
  try {
    read_image(folder.path / "a");
    FAIL("a GIF was read");
  } catch (const Error& error) {
    CHECK_THAT(error.what(), Contains(std::string(readable_formats())));
  }
}
