#pragma once

#include "support/samples.h"

#include "tilepack/seam/source_canvas.h"

namespace tilepack::testing {

/// 128 × 128 texels of four equal quarters: what is missing in one place stands in three more.
inline Image four_quarters() {
  const Image quarter = blobs(64, 64);
  Image image(128, 128, quarter.channels());
  for (int y = 0; y < 128; y += 64)
    for (int x = 0; x < 128; x += 64) paste(image, quarter, x, y);
  return image;
}

/// A canvas of the sample's north-west, the part from column `seam` on from `shift` further on.
inline SourceCanvas with_seam(Size size, int seam, SourceTexel shift) {
  SourceCanvas canvas(size.width, size.height);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      canvas.at(x, y) = x < seam ? SourceTexel{x, y} : SourceTexel{x + shift.x, y + shift.y};
  return canvas;
}

} // namespace tilepack::testing
