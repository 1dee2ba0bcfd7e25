#include "support/foreign_file.h"
#include "support/scratch_folder.h"
#include "support/tiny_files.h"

#include "tilepack/error/error.h"
#include "tilepack/error/field.h"
#include "tilepack/image/icc_profile.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/orientation.h"

#include <catch2/catch.hpp>
#include <fstream>

using namespace tilepack;
using Catch::Contains;
using OIIO::ImageSpec;
using OIIO::TypeDesc;
namespace fs = std::filesystem;

namespace {

ImageFile read_bytes(const fs::path& file, const std::string& bytes, const ReadOptions& options = {}) {
  std::ofstream(file, std::ios::binary) << bytes;
  return read_image(file, options);
}

std::string notes_of(const ImageFile& file) {
  std::string all;
  for (const std::string& note : file.notes) all += spelled(note, FieldSpelling::option) + "\n";
  return all;
}

ReadOptions with_channels(const std::string& channels) {
  ReadOptions options;
  options.channels = channels;
  return options;
}

std::string refusal(const fs::path& file, ErrorKind kind, const ReadOptions& options = {}) {
  try {
    read_image(file, options);
  } catch (const Error& error) {
    CHECK(error.kind() == kind);
    return error.message(FieldSpelling::option);
  }
  FAIL("nothing was thrown");
  return {};
}

// Color (1, .25, .125) under alpha of n/8, multiplied.
Image associated(int width) {
  Image image(width, 2, 4);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < width; ++x) {
      const float alpha = static_cast<float>(x % 9) / 8;
      const auto texel = image.texel(x, y);
      texel[0] = alpha;
      texel[1] = alpha / 4;
      texel[2] = alpha / 8;
      texel[3] = alpha;
    }
  return image;
}

void check_straight(const Image& image, float margin) {
  for (int x = 0; x < image.width(); ++x) {
    const auto texel = image.texel(x, 1);
    CAPTURE(x);
    CHECK(texel[3] == Approx(static_cast<float>(x % 9) / 8).margin(margin));
    if (texel[3] == 0) continue;
    CHECK(texel[0] == Approx(1.0).margin(0));
    CHECK(texel[1] == Approx(0.25).margin(margin));
    CHECK(texel[2] == Approx(0.125).margin(margin));
  }
}

// Values 0, 1, 2 … over all, as an EXR with these channel names.
void write_exr(const fs::path& file, const std::vector<std::string>& names, TypeDesc type = TypeDesc::FLOAT) {
  Image image(3, 2, static_cast<int>(names.size()));
  for (std::size_t i = 0; i < image.data().size(); ++i)
    image.data()[i] = static_cast<float>(i % names.size() + 1) / 8;
  ImageSpec spec(3, 2, static_cast<int>(names.size()), type);
  spec.channelnames = names;
  spec.alpha_channel = -1;
  auto output = OIIO::ImageOutput::create("openexr");
  REQUIRE(output->open(file.string(), spec));
  REQUIRE(output->write_image(TypeDesc::FLOAT, image.data().data()));
  REQUIRE(output->close());
}

std::vector<float> first_texel(const ImageFile& file) {
  const auto texel = file.image.texel(0, 0);
  return {texel.begin(), texel.end()};
}

Image numbered(int width, int height) {
  Image image(width, height, 1);
  for (std::size_t i = 0; i < image.data().size(); ++i) image.data()[i] = static_cast<float>(i);
  return image;
}

} // namespace

TEST_CASE("associated alpha is divided out, where the file says that it is") {
  const ScratchFolder folder;
  const fs::path exr = folder.path / "a.exr", tif = folder.path / "a.tif";
  write_foreign(exr, "openexr", associated(20), TypeDesc::HALF);
  check_straight(read_image(exr).image, 0);
  ReadOptions stored;
  stored.alpha = AlphaReading::as_stored;
  CHECK(read_image(exr, stored).image == associated(20));

  write_foreign(tif, "tiff", associated(20), TypeDesc::UINT16); // ExtraSamples 1
  check_straight(read_image(tif).image, 1.0f / 8000);           // a code over the smallest alpha
  CHECK(read_image(tif).notes.empty());
  ImageSpec straight;
  straight.attribute("oiio:UnassociatedAlpha", 1);
  write_foreign(tif, "tiff", associated(20), TypeDesc::UINT16, straight); // 2
  CHECK(read_image(tif).image == quantised(associated(20), Depth::u16));
  CHECK(read_image(tif).notes.empty());

  // 0: nobody knows.
  const std::string texels("\x10\x20\x30\x80", 4);
  const ImageFile unsaid = read_bytes(tif, tiny::tiff(1, 1, 4, 8, texels, {{262, 2}, {338, 0}}));
  CHECK(first_texel(unsaid)[0] == 16 / 255.0f);
  CHECK(unsaid.image.channels() == 4);
  CHECK_THAT(notes_of(unsaid), Contains("alpha") && Contains("--channels R,G,B"));
  CHECK(read_image(tif, with_channels("R,G,B")).image.channels() == 3);
  CHECK(read_image(tif, with_channels("R,G,B")).notes.empty());
}

TEST_CASE("an EXR written as a picture holds associated alpha, and comes back") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.exr";
  Image image(4, 1, 4, 0.5f);
  image.texel(1, 0)[3] = 0.25f;
  image.texel(2, 0)[3] = 0;
  write_image(file, image, Depth::f32, Encoding::linear);
  ReadOptions stored;
  stored.alpha = AlphaReading::as_stored;
  CHECK(read_image(file, stored).image.texel(1, 0)[0] == 0.125f);
  const Image back = read_image(file).image;
  CHECK(back.texel(0, 0)[0] == 0.5f);
  CHECK(back.texel(1, 0)[0] == 0.5f);
  CHECK(back.texel(2, 0)[0] == 0.0f); // what color had no weight
  write_image(file, image, StoredFormat{ImageContainer::exr, Depth::f32, Encoding::linear, false});
  CHECK(read_image(file, stored).image == image);
}

TEST_CASE("channels of an EXR go by their names") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.exr";
  using Values = std::vector<float>;
  const auto read = [&](const std::vector<std::string>& names) {
    write_exr(file, names);
    return first_texel(read_image(file));
  };
  CHECK(read({"R", "G", "B"}) == Values{1 / 8.f, 2 / 8.f, 3 / 8.f});
  CHECK(read({"B", "R", "G"}) == Values{2 / 8.f, 3 / 8.f, 1 / 8.f});
  CHECK(read({"LeR", "LeG", "LeB"}) == Values{1 / 8.f, 2 / 8.f, 3 / 8.f});
  CHECK(read({"diffuse.B", "diffuse.G", "diffuse.R"}) == Values{3 / 8.f, 2 / 8.f, 1 / 8.f});
  CHECK(read({"r", "g", "b"}) == Values{1 / 8.f, 2 / 8.f, 3 / 8.f});
  CHECK(read({"N.Z", "N.Y", "N.X"}) == Values{3 / 8.f, 2 / 8.f, 1 / 8.f});
  CHECK(read({"R", "G"}) == Values{1 / 8.f, 2 / 8.f});
  CHECK(read({"depth"}) == Values{1 / 8.f});
  CHECK(read({"A", "R", "G", "B"}) == Values{2.f, 3.f, 4.f, 1 / 8.f}); // and A is alpha

  write_exr(file, {"R", "G", "B", "Z"});
  CHECK_THAT(refusal(file, ErrorKind::invalid_content),
             Contains("R, G, B, Z") && Contains("--channels R,G,B"));
  CHECK(first_texel(read_image(file, with_channels("R,G,B"))) == Values{1 / 8.f, 2 / 8.f, 3 / 8.f});
  CHECK(first_texel(read_image(file, with_channels("Z"))) == Values{4 / 8.f});
  CHECK(read_image_header(file, with_channels("Z")).channels == 1);
  CHECK_THAT(refusal(file, ErrorKind::usage, with_channels("R,Q")),
             Contains("--channels") && Contains("'Q'") && Contains("R, G, B, Z"));
  CHECK_THAT(refusal(file, ErrorKind::usage, with_channels("R,,B")), Contains("''"));
  CHECK_THAT(refusal(file, ErrorKind::usage, with_channels("R,G,B,Z,R")), Contains("5 channels"));

  write_exr(file, {"R", "G", "B", "A", "spec.R", "spec.G", "spec.B"});
  CHECK_THAT(refusal(file, ErrorKind::invalid_content), Contains("spec.G"));
  CHECK(read_image(file, with_channels("spec.B,spec.G,spec.R")).image.channels() == 3);
}

TEST_CASE("whole numbers in an EXR are no map") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.exr";
  write_exr(file, {"id"}, TypeDesc::UINT32);
  CHECK_THAT(refusal(file, ErrorKind::invalid_content), Contains("whole numbers") && Contains("id"));
}

TEST_CASE("parts and windows that are passed over are said") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.exr";
  const Image image(8, 4, 3, 0.5f);
  ImageSpec parts[2] = {ImageSpec(8, 4, 1, TypeDesc::HALF), ImageSpec(8, 4, 3, TypeDesc::HALF)};
  parts[0].attribute("oiio:subimagename", "depth");
  parts[1].attribute("oiio:subimagename", "color");
  auto output = OIIO::ImageOutput::create("openexr");
  REQUIRE(output->open(file.string(), 2, parts));
  REQUIRE(output->write_image(TypeDesc::FLOAT, image.data().data()));
  REQUIRE(output->open(file.string(), parts[1], OIIO::ImageOutput::AppendSubimage));
  REQUIRE(output->write_image(TypeDesc::FLOAT, image.data().data()));
  output->close();
  CHECK_THAT(notes_of(read_image(file)), Contains("several images") && Contains("depth, color"));

  ImageSpec window(8, 4, 3, TypeDesc::HALF);
  window.full_x = 1;
  window.full_width = 4;
  REQUIRE(output->open(file.string(), window));
  REQUIRE(output->write_image(TypeDesc::FLOAT, image.data().data()));
  output->close();
  CHECK_THAT(notes_of(read_image(file)), Contains("display window of 4 x 4 at (1, 0)"));

  write_foreign(file, "openexr", image, TypeDesc::HALF);
  CHECK(read_image(file).notes.empty());

  std::ofstream(file, std::ios::binary) << tiny::chroma_exr();
  CHECK_THAT(refusal(file, ErrorKind::invalid_content), Contains("luminance and chroma"));
}

TEST_CASE("white that is 0 in a TIFF is white") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.tif";
  const auto grey = [&](std::uint32_t bits, const std::string& texels, std::uint32_t photometric) {
    return first_texel(read_bytes(file, tiny::tiff(1, 1, 1, bits, texels, {{262, photometric}})))[0];
  };
  CHECK(grey(8, "\x33", 1) == 0.2f);
  CHECK(grey(8, "\x33", 0) == 0.8f);
  CHECK(grey(16, tiny::little(13107, 2), 1) == 0.2f);
  CHECK(grey(16, tiny::little(13107, 2), 0) == 0.8f);
  CHECK(grey(32, tiny::little(0, 4), 0) == 1.0f);
}

TEST_CASE("a profile goes before gAMA, and cICP before both") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.png";
  const auto encoding = [&](const std::string& chunks) {
    return read_bytes(file, tiny::png(2, 2, 3, chunks)).encoding;
  };
  const std::string cicp_srgb = tiny::png_chunk("cICP", std::string("\x01\x0D\x00\x01", 4));
  const std::string cicp_linear = tiny::png_chunk("cICP", std::string("\x01\x08\x00\x01", 4));
  CHECK(encoding("") == Encoding::srgb);
  CHECK(encoding(tiny::gamma_1()) == Encoding::linear);
  CHECK(encoding(tiny::iccp(2.2) + tiny::gamma_1()) == Encoding::srgb);
  CHECK(encoding(tiny::gamma_1() + tiny::iccp(2.2)) == Encoding::srgb);
  CHECK(encoding(tiny::iccp(1.0)) == Encoding::linear);
  CHECK(encoding(cicp_srgb + tiny::gamma_1()) == Encoding::srgb);
  CHECK(encoding(cicp_linear) == Encoding::linear);
  CHECK(encoding(cicp_srgb + tiny::iccp(1.0)) == Encoding::srgb);
  CHECK(notes_of(read_image(file)).empty());

  for (const char* format : {"tiff", "jpeg"}) {
    ImageSpec spec;
    const std::string profile = tiny::profile(1.0);
    spec.attribute("ICCProfile", TypeDesc(TypeDesc::UINT8, static_cast<int>(profile.size())), profile.data());
    write_foreign(folder.path / "a", format, Image(8, 8, 3, 0.5f), TypeDesc::UINT8, spec);
    CAPTURE(format);
    CHECK(read_image(folder.path / "a").encoding == Encoding::linear);
  }
}

TEST_CASE("a gAMA chunk of 1 alone in a picture of 8 bits is doubted") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.png";
  CHECK_THAT(notes_of(read_bytes(file, tiny::png(2, 2, 3, tiny::gamma_1()))),
             Contains("gAMA") && Contains("--encoding srgb"));
  CHECK(read_image(file, Encoding::linear).notes.empty());
  CHECK(read_bytes(file, tiny::png(2, 2, 1, tiny::gamma_1())).notes.empty()); // heights are linear
}

TEST_CASE("what a profile says of the curve") {
  const auto bytes = [](const std::string& text) {
    return std::as_bytes(std::span(text.data(), text.size()));
  };
  CHECK(encoding_of_profile(bytes(tiny::profile(1.0))) == Encoding::linear);
  CHECK(encoding_of_profile(bytes(tiny::profile(1.8))) == Encoding::srgb);
  const std::string profile = tiny::profile(1.0);
  CHECK_FALSE(encoding_of_profile(bytes("")));
  for (std::size_t length = 0; length < profile.size(); ++length)
    CHECK(encoding_of_profile(bytes(profile.substr(0, length))) != Encoding::srgb);
}

TEST_CASE("a picture is turned upright, its sides too") {
  const Image file = numbered(3, 2); // 0 1 2 / 3 4 5
  const auto upright_values = [&](int orientation) {
    const Image image = upright(file, orientation);
    return std::vector<float>(image.data().begin(), image.data().end());
  };
  using Values = std::vector<float>;
  CHECK(upright_values(0) == Values{0, 1, 2, 3, 4, 5});
  CHECK(upright_values(1) == Values{0, 1, 2, 3, 4, 5});
  CHECK(upright_values(2) == Values{2, 1, 0, 5, 4, 3});
  CHECK(upright_values(3) == Values{5, 4, 3, 2, 1, 0});
  CHECK(upright_values(4) == Values{3, 4, 5, 0, 1, 2});
  CHECK(upright_values(5) == Values{0, 3, 1, 4, 2, 5});
  CHECK(upright_values(6) == Values{3, 0, 4, 1, 5, 2});
  CHECK(upright_values(7) == Values{5, 2, 4, 1, 3, 0});
  CHECK(upright_values(8) == Values{2, 5, 1, 4, 0, 3});
  CHECK(upright(file, 6).size() == Size{2, 3});

  const ScratchFolder folder;
  for (const char* format : {"tiff", "jpeg"}) {
    ImageSpec spec;
    spec.attribute("Orientation", 6);
    spec.attribute("Compression", "jpeg:100");
    Image half(16, 8, 1);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 16; ++x) half.texel(x, y)[0] = x < 8 ? 0.0f : 1.0f;
    if (format == std::string("tiff")) spec.erase_attribute("Compression");
    write_foreign(folder.path / "a", format, half, TypeDesc::UINT8, spec);
    const Image read = read_image(folder.path / "a").image;
    CAPTURE(format);
    CHECK(read.size() == Size{8, 16});
    CHECK(read_image_header(folder.path / "a").size == Size{8, 16});
    CHECK(read.texel(3, 2)[0] < 0.1f);
    CHECK(read.texel(3, 13)[0] > 0.9f);
  }
  const std::string exif = std::string("MM\0\x2A", 4) + tiny::big(8, 4) + tiny::big(1, 2) +
                           tiny::big(274, 2) + tiny::big(3, 2) + tiny::big(1, 4) + tiny::big(8, 2) +
                           tiny::big(0, 2) + tiny::big(0, 4);
  const ImageFile png = read_bytes(folder.path / "a.png", tiny::png(3, 2, 1, tiny::png_chunk("eXIf", exif)));
  CHECK(png.image.size() == Size{2, 3});
  CHECK(png.image.texel(0, 0)[0] == 2 / 255.0f);
}

TEST_CASE("pictures larger than the limit are refused before memory is taken") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.png";
  std::ofstream(file, std::ios::binary) << tiny::png(40, 30, 3, "");
  ReadOptions options;
  options.most_texels = 1199;
  CHECK_THAT(refusal(file, ErrorKind::invalid_content, options),
             Contains("40 x 30 texels") && Contains("--max-texels 1200"));
  options.most_texels = 1200;
  CHECK(read_image(file, options).image.size() == Size{40, 30});
  CHECK(read_image_header(file).size == Size{40, 30});

  // Its decoder takes memory when it opens the file.
  const fs::path jp2 = folder.path / "a.jp2";
  write_foreign(jp2, "jpeg2000", Image(64, 40, 3, 0.5f), TypeDesc::UINT8);
  CHECK(read_image_header(jp2).size == Size{64, 40});
  std::ifstream in(jp2, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::size_t header = bytes.find("ihdr");
  REQUIRE(header != std::string::npos);
  bytes.replace(header + 4, 8, tiny::big(50000, 4) + tiny::big(60000, 4));
  std::ofstream(jp2, std::ios::binary) << bytes;
  CHECK_THAT(refusal(jp2, ErrorKind::invalid_content), Contains("60000 x 50000") && Contains("--max-texels"));
}
