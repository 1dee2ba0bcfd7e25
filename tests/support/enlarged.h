#pragma once

#include "tilepack/image/image.h"

namespace tilepack::testing {

/// Each texel as `times` × `times` of them.
inline Image enlarged(const Image& image, int times) {
  Image large(image.width() * times, image.height() * times, image.channels());
  for (int y = 0; y < large.height(); ++y)
    for (int x = 0; x < large.width(); ++x)
      for (int c = 0; c < image.channels(); ++c)
        large.texel(x, y)[static_cast<std::size_t>(c)] =
            image.texel(x / times, y / times)[static_cast<std::size_t>(c)];
  return large;
}

} // namespace tilepack::testing
