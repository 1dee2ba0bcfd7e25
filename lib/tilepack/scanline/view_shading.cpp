#include "tilepack/scanline/view_shading.h"

#include <algorithm>
#include <array>

namespace tilepack {

Image shade(const Texture& texture, const ViewPixels& pixels, const RenderTarget& target,
            std::span<const float> background) {
  const auto count = static_cast<std::size_t>(texture.channels());
  Image image(pixels.width, pixels.rows, texture.channels());
  std::array<double, 4> buffer{};
  const std::span<double> value(buffer.data(), count);
  for (std::size_t at = 0; at < pixels.span.size(); ++at) {
    const auto out = std::span(image.data()).subspan(at * count, count);
    if (pixels.span[at] < 0) {
      std::copy(background.begin(), background.end(), out.begin());
      continue;
    }
    const ViewSpan& view = pixels.spans[static_cast<std::size_t>(pixels.span[at])];
    const double u = pixels.u[at], v = pixels.v[at];
    texture.sample({view.span.u.tile, view.span.u.fraction + u}, {view.span.v.tile, view.span.v.fraction + v},
                   footprint(view, pixels.step[at], u, v), value);
    store_pixel(value, target, out);
  }
  return image;
}

} // namespace tilepack
