#include "tilepack/scanline/view_render.h"

#include "tilepack/error/error.h"
#include "tilepack/scanline/span_constants.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace tilepack {
namespace {

// Rows stepped and shaded as one: as many scanlines as walk side by side. Fixed, and counted from the top of
// the picture, since a batch shares its re-seeding interval.
constexpr int band_rows = scanlines_side_by_side;

} // namespace

ViewRenderer::ViewRenderer(const Texture& of_texture, const Scene& of_scene, const Camera& camera,
                           Size picture, const ViewOptions& of_options, const RenderTarget& of_target)
    : options(of_options), scene(of_scene, Projection(camera, picture)), texture(&of_texture),
      target(of_target) {
  check_reseed(options.stepping.options);
  const auto count = static_cast<std::size_t>(texture->channels());
  if (options.background.empty()) options.background.assign(count, 0.0f);
  const bool finite = std::all_of(options.background.begin(), options.background.end(),
                                  [](float value) { return std::isfinite(value); });
  if (options.background.size() != count || !finite) {
    throw Error(ErrorKind::usage, field("background"),
                std::to_string(options.background.size()) +
                    (options.background.size() == 1 ? " value" : " values") +
                    (finite ? "" : ", not all finite") + "; the map has " + std::to_string(count) +
                    " channels, and each needs a finite one");
  }
}

Image ViewRenderer::rows(int first, int count) const {
  Image picture(size().width, count, channels());
  const int first_band = first / band_rows;
  const int end_band = (first + count + band_rows - 1) / band_rows;
  tbb::parallel_for(first_band, end_band, [&](int band) {
    const int top = band * band_rows;
    const int rows = std::min(band_rows, size().height - top);
    const ViewPixels pixels = view_pixels(scene.spans(top, rows), size().width, top, rows, options.stepping);
    const Image shaded = shade(*texture, pixels, target, options.background);
    for (int y = std::max(top, first); y < std::min(top + rows, first + count); ++y) {
      std::copy_n(shaded.row(y - top).begin(), shaded.row(0).size(), picture.row(y - first).begin());
    }
  });
  return picture;
}

} // namespace tilepack
