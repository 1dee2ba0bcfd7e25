#include "tilepack/image/stored_format.h"

#include "tilepack/image/image_format.h"

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

std::optional<ImageContainer> container_by_name(const std::filesystem::path& file) {
  const std::string ending = file_ending(file);
  return ending.empty() ? std::nullopt : enum_named<ImageContainer>(std::string_view(ending).substr(1));
}

} // namespace tilepack
