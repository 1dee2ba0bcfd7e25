#include "tilepack/image/png_bytes.h"

#include "tilepack/image/png_file.h"

#include <algorithm>
#include <cstdint>

namespace tilepack {

std::vector<std::byte> png_bytes(const Image& image) {
  std::vector<std::uint8_t> codes(image.data().size());
  std::transform(image.data().begin(), image.data().end(), codes.begin(),
                 [](float v) { return static_cast<std::uint8_t>(code_of(v, 255)); });
  std::vector<std::byte> bytes;
  const RasterWriter writer = create_png(
      [&bytes](std::uint64_t, std::span<const std::byte> part) {
        bytes.insert(bytes.end(), part.begin(), part.end());
      },
      image.size(), image.channels(), Depth::u8, Encoding::srgb);
  writer.write(0, image.height(), std::as_bytes(std::span(codes)));
  writer.finish();
  return bytes;
}

} // namespace tilepack
