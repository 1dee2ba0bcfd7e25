#include "tilepack/pack/image_header_check.h"

#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/image_format.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {

void check_image_header(const std::filesystem::path& file, Size size, int channels,
                        std::span<const Depth> depths) {
  check_complete(file, image_format(file)); // a decoder that finds a header cut complains on stderr
  const ImageHeader header = read_image_header(file);
  const auto refuse = [&](const std::string& has, const std::string& announced) {
    throw Error(ErrorKind::invalid_content, file.string(),
                fmt::format("has {}, and pack.json announces {}", has, announced));
  };
  if (header.size != size)
    refuse(fmt::format("{} x {} texels", header.size.width, header.size.height),
           fmt::format("{} x {}", size.width, size.height));
  if (header.channels != channels)
    refuse(fmt::format("{} channels", header.channels), fmt::format("{}", channels));
  if (std::find(depths.begin(), depths.end(), header.depth) == depths.end())
    refuse(fmt::format("depth {}", name_of(header.depth)), std::string(name_of(depths.front())));
}

} // namespace tilepack
