#include "tilepack/image/png_bytes.h"

#include "tilepack/error/error.h"
#include "tilepack/image/encoding.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace tilepack {

std::vector<std::byte> png_bytes(const Image& image) {
  std::vector<std::uint8_t> codes(image.data().size());
  std::transform(image.data().begin(), image.data().end(), codes.begin(),
                 [](float v) { return static_cast<std::uint8_t>(code_of(v, 255)); });
  OIIO::ImageSpec spec(image.width(), image.height(), image.channels(), OIIO::TypeDesc::UINT8);
  spec.alpha_channel = image.channels() % 2 == 0 ? image.channels() - 1 : -1;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("png:compressionLevel", 4);
  OIIO::Filesystem::IOVecOutput memory;
  const auto output = OIIO::ImageOutput::create("png");
  if (!output || !output->set_ioproxy(&memory) || !output->open("memory.png", spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, codes.data()) || !output->close())
    throw Error(ErrorKind::internal, "PNG", output ? output->geterror() : OIIO::geterror());
  std::vector<std::byte> bytes(memory.buffer().size());
  std::memcpy(bytes.data(), memory.buffer().data(), bytes.size());
  return bytes;
}

} // namespace tilepack
