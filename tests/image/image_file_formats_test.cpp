#include "support/foreign_file.h"
#include "support/scratch_folder.h"

#include "tilepack/image/image_file.h"

#include <catch2/catch.hpp>
#include <fstream>

using namespace tilepack;
using OIIO::ImageSpec;
using OIIO::TypeDesc;
namespace fs = std::filesystem;

namespace {

ImageFile read_bytes(const fs::path& file, std::string_view hex) {
  std::ofstream(file, std::ios::binary) << from_hex(hex);
  return read_image(file);
}

Texels codes(std::initializer_list<int> values) {
  Texels result;
  for (const int v : values) result.push_back(static_cast<float>(v) / 255.0f);
  return result;
}

Image ramp16() {
  Image image(256, 256, 1);
  for (int i = 0; i < 65536; ++i)
    image.data()[static_cast<std::size_t>(i)] = static_cast<float>(i) / 65535.0f;
  return image;
}

} // namespace

// The PNG files below are made by program: signature, IHDR, what is named, IDAT, IEND.

TEST_CASE("palettes, alpha beside grey and single bits expand to channels") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.png";

  const ImageFile palette =
      read_bytes(file, "89504e470d0a1a0a0000000d49484452000000030000000108030000002c3ee486"
                       "00000009504c5445ff0000003300000066887ce3b00000000c49444154789c6360"
                       "606402000008000436e0b0a60000000049454e44ae426082");
  CHECK(palette.image.channels() == 3);
  CHECK(palette.image.data() == codes({255, 0, 0, 0, 51, 0, 0, 0, 102}));

  const ImageFile palette_alpha =
      read_bytes(file, "89504e470d0a1a0a0000000d4948445200000002000000010203000000894c9719"
                       "00000006504c5445ff0000003300b5c877330000000174524e5380ad5e5b46000000"
                       "0a49444154789c6310000000120011a556c74e0000000049454e44ae426082");
  CHECK(palette_alpha.image.channels() == 4);
  CHECK(palette_alpha.image.data() == codes({255, 0, 0, 128, 0, 51, 0, 255}));

  // Color under alpha 0 is kept.
  const ImageFile grey_alpha =
      read_bytes(file, "89504e470d0a1a0a0000000d49484452000000020000000108040000005e2bb701"
                       "0000000d49444154789c63304e9bc9000003350133c1f12e270000000049454e44ae426082");
  CHECK(grey_alpha.image.channels() == 2);
  CHECK(grey_alpha.image.data() == codes({51, 102, 153, 0}));

  const ImageFile bits =
      read_bytes(file, "89504e470d0a1a0a0000000d4948445200000008000000010100000000cb7bd2ee"
                       "0000000a49444154789c63580a0000a700a6e5b9c5e20000000049454e44ae426082");
  CHECK(bits.depth == Depth::u8);
  CHECK(bits.image.data() == codes({255, 0, 255, 0, 0, 255, 0, 255}));
}

TEST_CASE("a PNG that says its gamma is 1 is linear, others are sRGB") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.png";
  CHECK(read_bytes(file, "89504e470d0a1a0a0000000d49484452000000010000000108000000003a7e9b55"
                         "0000000467414d41000186a031e8965f0000000a49444154789c6330060000350034"
                         "cab499ed0000000049454e44ae426082")
            .encoding == Encoding::linear);
  CHECK(read_bytes(file, "89504e470d0a1a0a0000000d49484452000000010000000108000000003a7e9b55"
                         "0000000467414d410000b18f0bfc61050000000a49444154789c6330060000350034"
                         "cab499ed0000000049454e44ae426082")
            .encoding == Encoding::srgb);
}

TEST_CASE("all 65536 codes of a 16-bit map survive PNG and TIFF, in and out") {
  const ScratchFolder folder;
  const Image ramp = ramp16();
  write_image(folder.path / "a.png", ramp, Depth::u16, Encoding::linear);
  CHECK(read_image(folder.path / "a.png").image == ramp);
  for (const char* compression : {"none", "lzw", "zip"}) {
    ImageSpec spec;
    spec.attribute("compression", compression);
    write_foreign(folder.path / "a.tif", "tiff", ramp, TypeDesc::UINT16, spec);
    const ImageFile back = read_image(folder.path / "a.tif");
    CHECK(back.image == ramp);
    CHECK(back.depth == Depth::u16);
  }
  write_foreign(folder.path / "a.tif", "tiff", ramp, TypeDesc::UINT32);
  const ImageFile wide = read_image(folder.path / "a.tif");
  CHECK(wide.depth == Depth::u16);
  CHECK(wide.image == ramp);
}

TEST_CASE("float and double TIFF and their encoding") {
  const ScratchFolder folder;
  const Image image(5, 4, 3, 1.25f);
  for (const TypeDesc stored : {TypeDesc::FLOAT, TypeDesc::DOUBLE}) {
    write_foreign(folder.path / "a.tif", "tiff", image, stored);
    const ImageFile back = read_image(folder.path / "a.tif");
    CHECK(back.image == image);
    CHECK(back.encoding == Encoding::linear);
    CHECK(back.depth == Depth::f32);
  }
}

TEST_CASE("JPEG of one and three channels") {
  const ScratchFolder folder;
  for (const int channels : {1, 3}) {
    ImageSpec spec;
    spec.attribute("Compression", "jpeg:100");
    write_foreign(folder.path / "a.jpg", "jpeg", Image(33, 17, channels, 0.5f), TypeDesc::UINT8, spec);
    const ImageFile back = read_image(folder.path / "a.jpg");
    CHECK(back.image.size() == Size{33, 17});
    CHECK(back.image.channels() == channels);
    CHECK(back.image.texel(32, 16)[0] == Approx(0.5).margin(0.01));
    CHECK(back.encoding == Encoding::srgb);
  }
}

TEST_CASE("tiled, mip-mapped, multi-part and cropped EXR: first part, first level, data window") {
  const ScratchFolder folder;
  const fs::path file = folder.path / "a.exr";
  Image image(70, 41, 3);
  for (std::size_t i = 0; i < image.data().size(); ++i) image.data()[i] = static_cast<float>(i);

  ImageSpec tiled(70, 41, 3, TypeDesc::FLOAT);
  tiled.tile_width = tiled.tile_height = 16;
  tiled.attribute("openexr:levelmode", 1);
  tiled.attribute("textureformat", "Plain Texture");
  auto output = OIIO::ImageOutput::create("openexr");
  REQUIRE(output->open(file.string(), tiled));
  REQUIRE(output->write_image(TypeDesc::FLOAT, image.data().data()));
  ImageSpec half_size = tiled;
  half_size.width = half_size.full_width = 35;
  half_size.height = half_size.full_height = 20;
  REQUIRE(output->open(file.string(), half_size, OIIO::ImageOutput::AppendMIPLevel));
  REQUIRE(output->write_image(TypeDesc::FLOAT, image.data().data()));
  output->close();
  CHECK(read_image(file).image == image);

  ImageSpec parts[2] = {ImageSpec(70, 41, 3, TypeDesc::FLOAT), ImageSpec(70, 41, 1, TypeDesc::HALF)};
  parts[0].attribute("oiio:subimagename", "color");
  parts[1].attribute("oiio:subimagename", "depth");
  output = OIIO::ImageOutput::create("openexr");
  REQUIRE(output->open(file.string(), 2, parts));
  REQUIRE(output->write_image(TypeDesc::FLOAT, image.data().data()));
  REQUIRE(output->open(file.string(), parts[1], OIIO::ImageOutput::AppendSubimage));
  REQUIRE(output->write_image(TypeDesc::FLOAT, image.data().data()));
  output->close();
  CHECK(read_image(file).image == image);

  for (const int tile : {0, 16}) {
    ImageSpec window(70, 41, 3, TypeDesc::FLOAT);
    window.x = -7;
    window.y = 12;
    window.full_width = 400;
    window.full_height = 300;
    window.tile_width = window.tile_height = tile;
    output = OIIO::ImageOutput::create("openexr");
    REQUIRE(output->open(file.string(), window));
    REQUIRE(output->write_image(TypeDesc::FLOAT, image.data().data()));
    output->close();
    CHECK(read_image(file).image == image);
  }
}

TEST_CASE("the content decides the format, and any name will do") {
  const ScratchFolder folder;
  const Image image(3, 2, 3, 0.2f);
  for (const char* name : {"really a png.jpg", "what?x=1.exr", "%04d.tif", "no_extension", "höhe.png"}) {
    write_foreign(folder.path / "a.png", "png", image, TypeDesc::UINT8);
    fs::rename(folder.path / "a.png", folder.path / name);
    CHECK(read_image(folder.path / name).image.size() == Size{3, 2});
  }
  for (const char* name : {"what?x=1.png", "%04d.png", "höhe.png"}) {
    write_image(folder.path / name, image, Depth::u8, Encoding::srgb);
    CHECK(read_image(folder.path / name).image == quantised(image, Depth::u8));
  }
}

TEST_CASE("strips and tiles of any height") {
  const ScratchFolder folder;
  Image image(123, 77, 2);
  for (std::size_t i = 0; i < image.data().size(); ++i)
    image.data()[i] = static_cast<float>(i % 256) / 255.0f;
  for (const int rows : {1, 7, 77, 1000}) {
    ImageSpec spec;
    spec.attribute("tiff:RowsPerStrip", rows);
    write_foreign(folder.path / "a.tif", "tiff", image, TypeDesc::UINT8, spec);
    CHECK(read_image(folder.path / "a.tif").image == image);
  }
  for (const int side : {16, 64, 256}) {
    ImageSpec spec;
    spec.tile_width = side;
    spec.tile_height = side / 2 < 16 ? 16 : side / 2;
    write_foreign(folder.path / "a.tif", "tiff", image, TypeDesc::UINT8, spec);
    CHECK(read_image(folder.path / "a.tif").image == image);
  }
  ImageSpec planes;
  planes.attribute("planarconfig", "separate");
  write_foreign(folder.path / "a.tif", "tiff", image, TypeDesc::UINT8, planes);
  CHECK(read_image(folder.path / "a.tif").image == image);
}
