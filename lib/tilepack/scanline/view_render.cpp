#include "tilepack/scanline/view_render.h"

#include "tilepack/error/error.h"
#include "tilepack/scanline/span_constants.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace tilepack {
namespace {

// Rows stepped and shaded as one: as many scanlines as walk side by side. Fixed, and counted from the top of
// the picture, since a batch shares its re-seeding interval.
constexpr int band_rows = scanlines_side_by_side;

// Linear light.
constexpr std::array<double, 3> horizon_light{0.67, 0.76, 0.84};
constexpr std::array<double, 3> zenith_light{0.117, 0.287, 0.61};

} // namespace

ViewRenderer::ViewRenderer(const Texture& of_texture, const Scene& of_scene, const Camera& camera,
                           Size picture, const ViewOptions& of_options, const RenderTarget& of_target)
    : options(of_options), projection(camera, picture), scene(of_scene, projection), texture(&of_texture),
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

void ViewRenderer::paint_sky(Image& shaded, const ViewPixels& pixels, int top) const {
  const auto count = static_cast<std::size_t>(channels());
  const bool colored = count >= 3;
  std::array<double, 4> light{1, 1, 1, 1};
  for (std::size_t at = 0; at < pixels.span.size(); ++at) {
    if (pixels.span[at] >= 0) continue;
    const auto x = static_cast<double>(at % static_cast<std::size_t>(pixels.width));
    const auto y = static_cast<double>(at / static_cast<std::size_t>(pixels.width));
    const Vec3 ray = projection.corner + (x + 0.5) * projection.across + (top + y + 0.5) * projection.down;
    const double height = std::clamp(ray.y / std::sqrt(dot(ray, ray)), 0.0, 1.0); // sine of the elevation
    const double blue = 1 - (1 - height) * (1 - height);
    for (std::size_t c = 0; c < 3; ++c)
      light[c] = horizon_light[c] + blue * (zenith_light[c] - horizon_light[c]);
    if (!colored) light[0] = 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
    if (!colored) light[1] = 1; // alpha, if there is a second channel
    store_pixel(std::span<const double>(light.data(), count), target,
                std::span(shaded.data()).subspan(at * count, count));
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
    Image shaded = shade(*texture, pixels, target, options.background);
    if (options.sky) paint_sky(shaded, pixels, top);
    for (int y = std::max(top, first); y < std::min(top + rows, first + count); ++y) {
      std::copy_n(shaded.row(y - top).begin(), shaded.row(0).size(), picture.row(y - first).begin());
    }
  });
  return picture;
}

} // namespace tilepack
