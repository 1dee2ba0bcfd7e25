#include "support/file_contents.h"
#include "support/foreign_file.h"
#include "support/images.h"
#include "support/scratch_folder.h"
#include "support/unprivileged.h"

#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace tilepack;
using Catch::Contains;
using OIIO::ImageSpec;
using OIIO::TypeDesc;
namespace fs = std::filesystem;

namespace {

using test::bytes_of;
using test::put;

/// The message of the Error of this kind that `f` throws.
std::string error_of(ErrorKind kind, const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& e) {
    CHECK(e.kind() == kind);
    return e.what();
  }
  FAIL("nothing was thrown");
  return {};
}

std::string reading_error(ErrorKind kind, const fs::path& file) {
  return error_of(kind, [&] { read_image(file); });
}

ImageSpec with(const std::string& name, const std::string& value) {
  ImageSpec spec;
  spec.attribute(name, value);
  return spec;
}

ImageSpec tiled(int side) {
  ImageSpec spec;
  spec.tile_width = spec.tile_height = side;
  return spec;
}

// PNG files made by program, as hexadecimal digits: 65536 x 65536 RGBA of 16 bits with 100 bytes of texels,
// plain and interlaced; and 70000 x 1 grey.
const char* const lying_png =
    "89504e470d0a1a0a0000000d4948445200010000000100001006000000"
    "3c14eca00000000c49444154789c6360a03d00000064000186643c350000000049454e44ae426082";
const char* const lying_interlaced_png =
    "89504e470d0a1a0a0000000d4948445200010000000100001006000001"
    "4b13dc360000000c49444154789c6360a03d00000064000186643c350000000049454e44ae426082";
const char* const wide_png =
    "89504e470d0a1a0a0000000d49484452000111700000000108000000"
    "00d72822970000000c49444154789c6360a03d00000064000186643c350000000049454e44ae426082";

} // namespace

TEST_CASE("a file cut anywhere is an error, in every format and compression") {
  const ScratchFolder folder;
  struct Variant {
    const char* format;
    TypeDesc stored;
    ImageSpec spec;
    int channels;
  };
  const Variant variants[] = {
      {"png", TypeDesc::UINT8, {}, 3},
      {"png", TypeDesc::UINT16, {}, 1},
      {"jpeg", TypeDesc::UINT8, {}, 3},
      {"jpeg", TypeDesc::UINT8, {}, 1},
      {"tiff", TypeDesc::UINT8, with("compression", "none"), 3},
      {"tiff", TypeDesc::UINT16, with("compression", "lzw"), 4},
      {"tiff", TypeDesc::FLOAT, with("compression", "zip"), 1},
      {"tiff", TypeDesc::UINT8, tiled(16), 3},
      {"openexr", TypeDesc::HALF, with("compression", "none"), 3},
      {"openexr", TypeDesc::HALF, with("compression", "zip"), 3},
      {"openexr", TypeDesc::FLOAT, with("compression", "zips"), 1},
      {"openexr", TypeDesc::HALF, with("compression", "piz"), 4},
      {"openexr", TypeDesc::HALF, with("compression", "dwaa"), 3},
      {"openexr", TypeDesc::HALF, tiled(16), 3},
  };
  for (const Variant& variant : variants) {
    const fs::path whole = folder.path / "whole", cut = folder.path / "cut";
    write_foreign(whole, variant.format, test::noise(40, 40, variant.channels, 7, Depth::f32), variant.stored,
                  variant.spec);
    CAPTURE(variant.format, variant.spec.get_string_attribute("compression"), variant.channels);
    const ImageFile image = read_image(whole);
    CHECK(image.image.size() == Size{40, 40});
    const std::string bytes = bytes_of(whole);
    // Every length near both ends, where headers and tables are, and some between.
    for (std::size_t length = 0; length < bytes.size();
         length +=
         length < 200 || bytes.size() - length < 400 ? 1 : std::min<std::size_t>(61, bytes.size() - length)) {
      put(cut, bytes.substr(0, length));
      CAPTURE(length, bytes.size());
      bool threw = false;
      try {
        read_image(cut);
      } catch (const Error& e) {
        threw = true;
        REQUIRE(e.kind() == ErrorKind::cannot_read);
        // Decoders of EXR check for themselves; the others would fill up what is missing.
        const bool exr = std::string(variant.format) == "openexr";
        REQUIRE_THAT(e.what(), Contains(length == 0  ? "is empty"
                                        : length < 8 ? "is"
                                        : exr        ? "is truncated or damaged"
                                                     : "is truncated: its content goes on"));
      }
      REQUIRE(threw);
    }
  }
}

TEST_CASE("what is no image file is refused with its reason") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.png";
  CHECK_THAT(reading_error(ErrorKind::cannot_read, file), Contains("a.png") && Contains("No such file"));
  CHECK_THAT(reading_error(ErrorKind::cannot_read, folder.path), Contains("is a folder"));
  CHECK_THAT(reading_error(ErrorKind::cannot_read, "/dev/null"), Contains("not a regular file"));
  CHECK_THAT(reading_error(ErrorKind::cannot_read, folder.path / "x.null"), Contains("No such file"));
  for (const char* text :
       {"plain text, long enough for any header\n", "\x89PN", "GIF89a", "{}", "\xFF\xD8"}) {
    put(file, text);
    CHECK_THAT(reading_error(ErrorKind::cannot_read, file), Contains("is no PNG, JPEG, TIFF, EXR, TGA"));
    CHECK_THAT(error_of(ErrorKind::cannot_read, [&] { read_image_header(file); }), Contains("is no PNG"));
  }
  put(file, "");
  CHECK_THAT(reading_error(ErrorKind::cannot_read, file), Contains("is empty"));

  REQUIRE(mkfifo((folder.path / "pipe.png").c_str(), 0600) == 0);
  CHECK_THAT(reading_error(ErrorKind::cannot_read, folder.path / "pipe.png"), Contains("not a regular file"));

  write_image(file, test::noise(4, 4, 3, 7, Depth::f32), Depth::u8, Encoding::srgb);
  fs::permissions(file, fs::perms::none);
  fs::permissions(folder.path, fs::perms::others_exec, fs::perm_options::add);
  const test::Unprivileged other; // root reads everything
  CHECK_THAT(reading_error(ErrorKind::cannot_read, file), Contains("Permission denied"));
}

TEST_CASE("a changed byte in a PNG is an error") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.png";
  write_image(file, test::noise(9, 9, 3, 7, Depth::f32), Depth::u8, Encoding::srgb);
  const std::string bytes = bytes_of(file);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    put(file, changed);
    CAPTURE(i);
    REQUIRE_THROWS_AS(read_image(file), Error);
  }
}

TEST_CASE("a header that promises more than the file can hold is refused before memory is taken") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a";
  for (const char* lie : {lying_png, lying_interlaced_png}) {
    put(file, from_hex(lie));
    CHECK_THAT(reading_error(ErrorKind::cannot_read, file), Contains("truncated"));
    CHECK(read_image_header(file).size == Size{65536, 65536});
  }
  put(file, from_hex(wide_png));
  CHECK_THAT(reading_error(ErrorKind::invalid_content, file),
             Contains("70000 x 1") && Contains("1 to 65536"));

  write_foreign(file, "jpeg", test::noise(64, 64, 3, 7, Depth::f32), TypeDesc::UINT8);
  std::string jpeg = bytes_of(file);
  const std::size_t frame = jpeg.find(std::string("\xFF\xC0\x00\x11\x08", 5));
  REQUIRE(frame != std::string::npos);
  jpeg.replace(frame + 5, 4, "\xFF\x00\xFF\x00", 4);
  put(file, jpeg);
  CHECK_THAT(reading_error(ErrorKind::cannot_read, file), Contains("truncated"));

  write_image(folder.path / "a.exr", test::noise(64, 64, 3, 7, Depth::f32), Depth::f16, Encoding::linear);
  std::string exr = bytes_of(folder.path / "a.exr");
  const std::size_t window = exr.find("dataWindow") + 11 + 6 + 4;
  exr.replace(window + 8, 8, std::string("\xFF\x1F\0\0\xFF\x1F\0\0", 8));
  put(file, exr);
  CHECK_THAT(reading_error(ErrorKind::cannot_read, file), Contains("truncated"));
}

TEST_CASE("NaN and infinity are named with their texel and channel") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.exr";
  for (const Depth depth : {Depth::f16, Depth::f32})
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()}) {
      Image image = test::noise(700, 500, 3, 7, Depth::f32); // more than one band of float
      image.texel(123, 456)[1] = bad;
      image.texel(5, 480)[0] = bad;
      write_image(file, image, depth, Encoding::linear);
      CHECK_THAT(reading_error(ErrorKind::invalid_content, file),
                 Contains("channel G of texel (123, 456)") && Contains(std::isnan(bad) ? "nan" : "inf"));
    }
}

TEST_CASE("five channels, deep and signed samples are refused, with what to do") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a";
  write_foreign(file, "openexr", test::noise(8, 8, 5, 7, Depth::f32), TypeDesc::HALF);
  CHECK_THAT(reading_error(ErrorKind::invalid_content, file),
             Contains("R, G, B, A, channel4") && Contains("channels R,G,B"));
  write_foreign(file, "tiff", test::noise(8, 8, 1, 7, Depth::f32), TypeDesc::INT16);
  CHECK_THAT(reading_error(ErrorKind::invalid_content, file), Contains("int16 samples"));

  ImageSpec spec(4, 4, 1, TypeDesc::FLOAT);
  spec.deep = true;
  OIIO::DeepData deep(spec);
  auto output = OIIO::ImageOutput::create("openexr");
  REQUIRE(output->open(file.string(), spec));
  REQUIRE(output->write_deep_image(deep));
  output->close();
  CHECK_THAT(reading_error(ErrorKind::invalid_content, file), Contains("deep"));
}

TEST_CASE("an image that cannot be written leaves nothing and spares the older file") {
  const ScratchFolder folder;
  const auto entries = [&] {
    return std::distance(fs::directory_iterator(folder.path), fs::directory_iterator());
  };
  const Image image = test::noise(64, 64, 3, 7, Depth::f32);
  const auto writing_error = [&](ErrorKind kind, const fs::path& file, Depth depth) {
    return error_of(kind, [&] { write_image(file, image, depth, Encoding::srgb); });
  };

  std::ofstream(folder.path / "file") << "no folder";
  CHECK_THAT(writing_error(ErrorKind::cannot_write, folder.path / "file" / "none" / "a.png", Depth::u8),
             Contains("cannot be created"));
  fs::remove(folder.path / "file");
  CHECK_THAT(writing_error(ErrorKind::usage, folder.path / "a.png", Depth::f16),
             Contains("f16") && Contains(".exr"));
  CHECK_THAT(writing_error(ErrorKind::usage, folder.path / "a.jpg", Depth::u8), Contains(".png"));
  fs::create_directory(folder.path / "folder.png");
  CHECK_THAT(writing_error(ErrorKind::cannot_write, folder.path / "folder.png", Depth::u8),
             Contains("is a folder"));
  CHECK_THAT(error_of(ErrorKind::usage,
                      [&] { write_image(folder.path / "a.png", Image(), Depth::u8, Encoding::srgb); }),
             Contains("0 x 0"));
  CHECK(entries() == 1);
  const fs::perms look = fs::perms::owner_read | fs::perms::owner_exec;
  fs::permissions(folder.path, look | fs::perms::others_read | fs::perms::others_exec);
  {
    const test::Unprivileged other; // root writes everywhere
    CHECK_THAT(writing_error(ErrorKind::cannot_write, folder.path / "a.png", Depth::u8),
               Contains("Permission denied"));
  }
  fs::permissions(folder.path, fs::perms::owner_all);

  // A limit on file sizes stands for a full disk: the write that crosses it fails.
  for (const Depth depth : {Depth::u8, Depth::f32}) {
    const fs::path file = folder.path / ("old." + std::string(name_of(usual_container(depth))));
    put(file, "older");
    write_image(folder.path / ("whole." + std::string(name_of(usual_container(depth)))), image, depth,
                Encoding::srgb);
    const auto whole = fs::file_size(folder.path / ("whole." + std::string(name_of(usual_container(depth)))));
    for (const rlim_t limit : {rlim_t{0}, rlim_t{1}, rlim_t{whole / 2}, rlim_t{whole - 1}}) {
      rlimit before{};
      REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
      const auto handler = signal(SIGXFSZ, SIG_IGN);
      const rlimit lowered{limit, before.rlim_max};
      setrlimit(RLIMIT_FSIZE, &lowered);
      std::string message;
      try {
        write_image(file, image, depth, Encoding::srgb);
      } catch (const Error& e) {
        if (e.kind() == ErrorKind::cannot_write) message = e.what();
      }
      setrlimit(RLIMIT_FSIZE, &before);
      signal(SIGXFSZ, handler);
      CHECK_THAT(message, Contains("File too large"));
      CHECK(bytes_of(file) == "older");
    }
  }
  CHECK(entries() == 5);

  {
    ImageWriter writer(folder.path / "old.png", {64, 64}, 3, Depth::u8, Encoding::srgb);
    writer.write(crop(image, {0, 0, 64, 10}));
    CHECK(entries() == 6);
    CHECK_THROWS_AS(writer.finish(), std::logic_error);
    CHECK_THROWS_AS(writer.write(image), std::logic_error);
    CHECK_THROWS_AS(writer.write(Image(63, 1, 3)), std::logic_error);
    CHECK_THROWS_AS(writer.write(Image(64, 1, 4)), std::logic_error);
  }
  CHECK(entries() == 5);
  CHECK(bytes_of(folder.path / "old.png") == "older");
}
