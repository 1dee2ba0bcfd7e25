#include "tilepack/image/stored_format.h"

#include <fmt/format.h>

namespace tilepack {

bool holds(ImageContainer container, Depth depth) {
  return is_integer(depth) == (container == ImageContainer::png);
}

ImageContainer usual_container(Depth depth) {
  return is_integer(depth) ? ImageContainer::png : ImageContainer::exr;
}

StoredFormat usual_format(Depth depth, Encoding encoding) {
  const ImageContainer container = usual_container(depth);
  return {container, depth, encoding, container == ImageContainer::exr};
}

std::string_view name_of(ImageContainer container) {
  return container == ImageContainer::png ? "png" : "exr";
}

std::optional<ImageContainer> container_by_name(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  for (const ImageContainer container : {ImageContainer::png, ImageContainer::exr})
    if (ending == fmt::format(".{}", name_of(container))) return container;
  return {};
}

} // namespace tilepack
