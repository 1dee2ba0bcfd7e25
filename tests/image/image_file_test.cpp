#include "support/file_contents.h"
#include "support/scratch_folder.h"

#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"

#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>

using namespace tilepack;
namespace fs = std::filesystem;

namespace {

using test::bytes_of;

/// Values that every depth holds exactly where it can: all codes of integers, signs and extremes of floats.
Image pattern(Size size, int channels, Depth depth) {
  Image image(size.width, size.height, channels);
  std::uint32_t state = 1;
  for (float& v : image.data()) {
    state = state * 1664525u + 1013904223u;
    const float fraction = static_cast<float>(state >> 8) / 16777216.0f;
    v = quantised(depth == Depth::u8 || depth == Depth::u16 ? fraction : (fraction - 0.5f) * 1000.0f, depth);
  }
  if (depth == Depth::f16) image.data().front() = 65504.0f;
  if (depth == Depth::f32) image.data().front() = std::numeric_limits<float>::max();
  return image;
}

} // namespace

TEST_CASE("every depth and channel count comes back exactly, with its header") {
  const ScratchFolder folder;
  for (const Depth depth : {Depth::u8, Depth::u16, Depth::f16, Depth::f32})
    for (int channels = 1; channels <= 4; ++channels)
      for (const Size size : {Size{1, 1}, Size{37, 19}, Size{300, 2}}) {
        const fs::path file = folder.path / ("a." + std::string(name_of(usual_container(depth))));
        const Image image = pattern(size, channels, depth);
        write_image(file, image, StoredFormat{usual_container(depth), depth, Encoding::srgb});
        ReadOptions options;
        options.alpha = AlphaReading::as_stored;
        const ImageFile back = read_image(file, options);
        CAPTURE(name_of(depth), channels, size.width);
        CHECK(back.image == image);
        CHECK(back.depth == depth);
        const bool integer = depth == Depth::u8 || depth == Depth::u16;
        CHECK(back.encoding == (integer ? Encoding::srgb : Encoding::linear));
        CHECK(read_image(file, Encoding::linear).encoding == Encoding::linear);
        CHECK(read_image(file, Encoding::srgb).encoding == Encoding::srgb);
        const ImageHeader header = read_image_header(file);
        CHECK(header.size == size);
        CHECK(header.channels == channels);
        CHECK(header.depth == depth);
        CHECK(header.encoding == back.encoding);
      }
}

TEST_CASE("bands give the bytes of the whole image, and the same bytes later") {
  const ScratchFolder folder;
  for (const Depth depth : {Depth::u8, Depth::u16, Depth::f16, Depth::f32}) {
    std::string dot_extension = ".";
    dot_extension += name_of(usual_container(depth));
    const Image image = pattern({61, 45}, 3, depth);
    write_image(folder.path / ("whole" + dot_extension), image, depth, Encoding::linear);
    ImageWriter writer(folder.path / ("bands" + dot_extension), image.size(), 3, depth, Encoding::linear);
    for (int y = 0; y < 45;) {
      const int rows = std::min(1 + y % 7, 45 - y);
      writer.write(crop(image, {0, y, 61, rows}));
      y += rows;
    }
    writer.finish();
    CHECK(bytes_of(folder.path / ("whole" + dot_extension)) ==
          bytes_of(folder.path / ("bands" + dot_extension)));
  }
  // Two sets of files, and no temporary one.
  CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 4);
}

TEST_CASE("a file carries nothing of the machine or the hour") {
  const ScratchFolder folder;
  for (const Depth depth : {Depth::u8, Depth::f16}) {
    const fs::path file = folder.path / ("a." + std::string(name_of(usual_container(depth))));
    write_image(file, pattern({4, 4}, 3, depth), depth, Encoding::srgb);
    const std::string bytes = bytes_of(file);
    for (const char* word : {"Software", "DateTime", "tIME", "OpenImageIO", "Host", "/tmp"}) {
      CAPTURE(word);
      CHECK(bytes.find(word) == std::string::npos);
    }
    CHECK_FALSE(std::regex_search(bytes, std::regex("[0-9]{4}:[0-9]{2}:[0-9]{2}")));
    CHECK(bytes.find(folder.path.filename().string()) == std::string::npos);
  }
}
