#include "support/file_contents.h"
#include "support/foreign_file.h"
#include "support/scratch_folder.h"

#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/png_bytes.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <png.h>

using namespace tilepack;
namespace fs = std::filesystem;

namespace {

using test::bytes_of;

struct Variety {
  int type = PNG_COLOR_TYPE_RGB;
  int bits = 8;
  bool interlaced = false;
  bool transparent_color = false;
  double gamma = 0; // none
  bool srgb = false;
};

std::uint32_t random_bits() {
  static std::uint32_t state = 11;
  state = state * 1664525u + 1013904223u;
  return state >> 8;
}

/// Any kind of PNG, with all the chunks that change what it means, written by libpng.
void write_variety(const fs::path& file, const Variety& v, Size size) {
  std::FILE* stream = std::fopen(file.c_str(), "wb");
  REQUIRE(stream);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, stream);
  png_set_IHDR(png, info, static_cast<png_uint_32>(size.width), static_cast<png_uint_32>(size.height), v.bits,
               v.type, v.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  const int colors = 1 << v.bits;
  if (v.type == PNG_COLOR_TYPE_PALETTE) {
    std::vector<png_color> palette(static_cast<std::size_t>(colors));
    for (png_color& c : palette)
      c = {static_cast<png_byte>(random_bits()), static_cast<png_byte>(random_bits()),
           static_cast<png_byte>(random_bits())};
    png_set_PLTE(png, info, palette.data(), colors);
  }
  if (v.transparent_color) {
    std::vector<png_byte> alphas(static_cast<std::size_t>((colors + 1) / 2)); // the rest is opaque
    for (png_byte& a : alphas) a = static_cast<png_byte>(random_bits());
    png_color_16 color{0, 1, 1, 1, 1};
    const bool palette = v.type == PNG_COLOR_TYPE_PALETTE;
    png_set_tRNS(png, info, palette ? alphas.data() : nullptr, palette ? static_cast<int>(alphas.size()) : 1,
                 &color);
  }
  if (v.gamma > 0) png_set_gAMA(png, info, v.gamma);
  png_text text{};
  char key[] = "Comment", words[] = "anything";
  text.compression = PNG_TEXT_COMPRESSION_zTXt;
  text.key = key;
  text.text = words;
  png_set_text(png, info, &text, 1);
  png_write_info(png, info);
  const std::size_t row_bytes = png_get_rowbytes(png, info);
  std::vector<png_byte> texels(row_bytes * static_cast<std::size_t>(size.height));
  // Few values, so that the transparent color is among them.
  for (png_byte& b : texels)
    b = static_cast<png_byte>(v.bits < 8 ? random_bits() : random_bits() % 4 * (random_bits() % 64));
  std::vector<png_bytep> rows;
  for (std::size_t at = 0; at < texels.size(); at += row_bytes) rows.push_back(texels.data() + at);
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(stream);
  if (!v.srgb) return;
  // By hand behind the header, since libpng won't write it beside a gamma that disagrees.
  std::string bytes = bytes_of(file);
  bytes.insert(33, from_hex("000000017352474200aece1ce9"));
  std::ofstream(file, std::ios::binary) << bytes;
}

/// As OpenImageIO reads it.
ImageFile read_elsewhere(const fs::path& file) {
  auto input = OIIO::ImageInput::create("png");
  OIIO::ImageSpec spec, wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1);
  REQUIRE(input->open(file.string(), spec, wishes));
  const bool wide = spec.format == OIIO::TypeDesc::UINT16;
  Texels values;
  const std::size_t count =
      static_cast<std::size_t>(spec.image_pixels()) * static_cast<std::size_t>(spec.nchannels);
  if (wide) {
    std::vector<std::uint16_t> codes(count);
    REQUIRE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT16, codes.data()));
    for (const std::uint16_t code : codes) values.push_back(static_cast<float>(code) / 65535.0f);
  } else {
    std::vector<std::uint8_t> codes(count);
    REQUIRE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, codes.data()));
    for (const std::uint8_t code : codes) values.push_back(static_cast<float>(code) / 255.0f);
  }
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  return {Image({spec.width, spec.height}, spec.nchannels, std::move(values)),
          OIIO::Strutil::iequals(space, "linear") ? Encoding::linear : Encoding::srgb,
          wide ? Depth::u16 : Depth::u8};
}

} // namespace

TEST_CASE("PNG of every kind reads as OpenImageIO reads it") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.png";
  std::vector<Variety> varieties;
  for (const int bits : {1, 2, 4, 8, 16})
    for (const int type : {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_PALETTE, PNG_COLOR_TYPE_RGB,
                           PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB_ALPHA}) {
      if (bits < 8 && type != PNG_COLOR_TYPE_GRAY && type != PNG_COLOR_TYPE_PALETTE) continue;
      if (bits == 16 && type == PNG_COLOR_TYPE_PALETTE) continue;
      for (const bool interlaced : {false, true})
        for (const bool transparent : {false, true})
          if (!transparent || (type & PNG_COLOR_MASK_ALPHA) == 0)
            varieties.push_back({type, bits, interlaced, transparent});
    }
  CHECK(varieties.size() == 52);
  for (const double gamma : {1.0, 0.9999, 0.99, 0.5, 1 / 2.2, 1 / 1.8})
    for (const bool srgb : {false, true})
      varieties.push_back({PNG_COLOR_TYPE_RGB, 8, false, false, gamma, srgb});
  varieties.push_back({PNG_COLOR_TYPE_RGB, 16, false, false, 0, true});
  int with_alpha = 0, linear = 0;
  for (const Variety& v : varieties)
    for (const Size size : {Size{1, 1}, Size{37, 23}}) {
      write_variety(file, v, size);
      CAPTURE(v.type, v.bits, v.interlaced, v.transparent_color, v.gamma, v.srgb, size.width);
      const ImageFile ours = read_image(file), theirs = read_elsewhere(file);
      CHECK(ours.image == theirs.image);
      CHECK(ours.depth == theirs.depth);
      CHECK(ours.encoding == theirs.encoding);
      const ImageHeader header = read_image_header(file);
      CHECK(header.channels == ours.image.channels());
      CHECK(header.encoding == ours.encoding);
      CHECK(header.depth == ours.depth);
      with_alpha += ours.image.channels() % 2 == 0;
      linear += ours.encoding == Encoding::linear;
    }
  CHECK(with_alpha == 2 * 30);
  CHECK(linear == 2 * 2); // gamma 1 and, to a hundredth, 0.9999
}

TEST_CASE("the PNG that is written reads elsewhere, block after block") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.png";
  for (const Depth depth : {Depth::u8, Depth::u16})
    for (int channels = 1; channels <= 4; ++channels)
      // Many blocks and batches of them; one row wider than a block; one texel a row.
      for (const Size size : {Size{1, 1}, Size{1500, 900}, Size{40000, 3}, Size{1, 3000}}) {
        if (size.width == 1500 && channels == 2) continue;
        Image image(size.width, size.height, channels);
        // Ramps, noise and flat parts, so that every filter has its rows.
        for (int y = 0; y < size.height; ++y)
          for (std::size_t i = 0; i < image.row(y).size(); ++i) {
            const int part = y * 5 / size.height;
            const int value = part == 0   ? static_cast<int>(i)
                              : part == 1 ? y * 3
                              : part == 2 ? static_cast<int>(random_bits())
                              : part == 3 ? static_cast<int>(i) * y / 7
                                          : 9;
            image.row(y)[i] = static_cast<float>(value & 255) / 255.0f;
          }
        CAPTURE(name_of(depth), channels, size.width);
        write_image(file, image, depth, Encoding::srgb);
        const ImageFile theirs = read_elsewhere(file);
        CHECK(theirs.image == quantised(image, depth));
        CHECK(theirs.encoding == Encoding::srgb);
        CHECK(theirs.depth == depth);
        CHECK(read_image(file).image == theirs.image);
        const std::string whole = bytes_of(file);
        ImageWriter writer(file, size, channels, depth, Encoding::srgb);
        for (int y = 0; y < size.height; y += 77)
          writer.write(crop(image, {0, y, size.width, std::min(77, size.height - y)}));
        writer.finish();
        CHECK((bytes_of(file) == whole));
      }
  const Image image(300, 200, 3, 0.25f);
  write_image(file, image, Depth::u8, Encoding::srgb);
  const std::vector<std::byte> in_memory = png_bytes(image);
  CHECK(bytes_of(file) == std::string(reinterpret_cast<const char*>(in_memory.data()), in_memory.size()));
}

TEST_CASE("only what is sRGB says so") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.png";
  write_image(file, Image(2, 2, 3), Depth::u8, Encoding::srgb);
  CHECK(bytes_of(file).find("sRGB") != std::string::npos);
  CHECK(bytes_of(file).find("gAMA") != std::string::npos);
  write_image(file, Image(2, 2, 3), Depth::u8, Encoding::linear);
  CHECK(bytes_of(file).find("sRGB") == std::string::npos);
  CHECK(bytes_of(file).find("gAMA") == std::string::npos);
}

TEST_CASE("a PNG whose texels end early is an error, whatever its chunks say") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.png";
  // Made by program, checksums right: 2 x 2 grey with the texels of one row, and one with a palette missing.
  for (const char* hex : {"89504e470d0a1a0a0000000d494844520000000200000002080000000057dd52f80000000b494441"
                          "54789c6360640200000700047649e3280000000049454e44ae426082",
                          "89504e470d0a1a0a0000000d4948445200000002000000010803000000c3fc8fb80000000b494441"
                          "54789c636060000000030001b8ad3a630000000049454e44ae426082"}) {
    std::ofstream(file, std::ios::binary) << from_hex(hex);
    CHECK_THROWS_AS(read_image(file), Error);
  }
}
