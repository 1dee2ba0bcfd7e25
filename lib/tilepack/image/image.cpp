#include "tilepack/image/image.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace tilepack {
namespace {

bool inside(Size size, Rect r) {
  return r.x >= 0 && r.y >= 0 && r.width >= 0 && r.height >= 0 && r.x <= size.width - r.width &&
         r.y <= size.height - r.height;
}

} // namespace

Image::Image(Size size, int channels, Texels texels)
    : size_in_texels(size), channel_count(channels), values(std::move(texels)) {
  if (values.size() != row_length() * static_cast<std::size_t>(size.height))
    throw std::invalid_argument("an image has width * height * channels values");
}

Image Image::unset(Size size, int channels) {
  return Image(size, channels,
               Texels(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) *
                      static_cast<std::size_t>(channels)));
}

Image crop(const Image& image, Rect rect) {
  if (!inside(image.size(), rect)) throw std::out_of_range("crop outside the image");
  Image result = Image::unset({rect.width, rect.height}, image.channels());
  if (result.empty()) return result;
  for (int y = 0; y < rect.height; ++y) {
    const auto from = image.row(rect.y + y).subspan(static_cast<std::size_t>(rect.x * image.channels()));
    std::copy_n(from.begin(), result.row(y).size(), result.row(y).begin());
  }
  return result;
}

void paste(Image& image, const Image& patch, int x, int y) {
  if (image.channels() != patch.channels() || !inside(image.size(), {x, y, patch.width(), patch.height()}))
    throw std::out_of_range("paste outside the image");
  for (int row = 0; row < patch.height(); ++row) {
    const auto from = patch.row(row);
    std::copy(from.begin(), from.end(), image.row(y + row).begin() + x * image.channels());
  }
}

} // namespace tilepack
