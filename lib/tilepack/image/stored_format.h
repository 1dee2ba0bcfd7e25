#pragma once

#include "tilepack/image/encoding.h"

#include <filesystem>
#include <optional>
#include <string_view>

namespace tilepack {

/// The kinds of file that are written.
enum class ImageContainer {
  png, ///< u8 and u16, lossless
  exr, ///< f16 and f32, lossless
};

/// How an image stands in a file: what kind of file, how wide a channel, and how values relate to light.
struct StoredFormat {
  ImageContainer container = ImageContainer::png;
  Depth depth = Depth::u8;
  Encoding encoding = Encoding::srgb;
  bool associated_alpha =
      false; ///< color of 2 or 4 channels is multiplied by alpha, as EXR has it by definition
  bool operator==(const StoredFormat&) const = default;
};

/// u8 and u16.
constexpr bool is_integer(Depth depth) {
  return depth == Depth::u8 || depth == Depth::u16;
}

/// Whether files of this kind hold channels of this depth.
bool holds(ImageContainer container, Depth depth);

/// The kind of file for a depth where nobody asked for one: PNG for integers, EXR for floats.
ImageContainer usual_container(Depth depth);

/// An image of `depth` and `encoding` in the usual container of the depth, alpha as others expect it there.
StoredFormat usual_format(Depth depth, Encoding encoding);

/// The endings of file names, without the dot, which are also the names in options.
template <>
inline constexpr auto enum_names<ImageContainer> =
    std::array{EnumName{ImageContainer::png, "png"}, EnumName{ImageContainer::exr, "exr"}};

/// The kind of file that a name asks for by its ending, in lower case; unset: none that is written.
std::optional<ImageContainer> container_by_name(const std::filesystem::path& file);

} // namespace tilepack
