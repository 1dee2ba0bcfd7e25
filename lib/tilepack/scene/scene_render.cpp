#include "tilepack/scene/scene_render.h"

#include "tilepack/error/error.h"
#include "tilepack/sampler/render.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tilepack {
namespace {

// `whole` texels of the level, any, in texels of the scene: doubled within the texture, so that nothing overflows.
std::int64_t finest_texels(std::int64_t whole, int level, std::int64_t texels) {
  std::int64_t at = ((whole % texels) + texels) % texels;
  for (int i = 0; i < level; ++i) at = at * 2 % texels;
  return at;
}

TileCoordinate moved(const TileCoordinate& from, double texels, int unit) {
  const TileCoordinate step = from_texels(texels, unit);
  return normalised({from.tile + step.tile, from.fraction + step.fraction});
}

} // namespace

SceneWindow::SceneWindow(const PatternTexture& of_texture, const PatternGraph& graph,
                         std::array<std::int64_t, 2> size, const SceneView& of_view,
                         const RenderTarget& of_target)
    : texture(&of_texture), view(of_view), target(of_target), unit(graph.unit) {
  View window;
  window.rect = view.rect;
  window.scale = view.scale;
  picture = output_size(window);
  const double step = std::ldexp(1 / view.scale, view.level);
  footprint = {step / unit.width, 0, 0, step / unit.height};
  corner = {from_texels(finest_texels(view.rect.x, view.level, size[0]), 0, unit.width),
            from_texels(finest_texels(view.rect.y, view.level, size[1]), 0, unit.height)};
}

Image SceneWindow::rows(int first, int count) const {
  Image band(picture.width, count, channels());
  const auto width = static_cast<std::size_t>(picture.width);
  const auto channel_count = static_cast<std::size_t>(channels());
  const double step = std::ldexp(1 / view.scale, view.level); // texels of the scene
  tbb::parallel_for(0, count, [&](int row) {
    std::vector<float> values(width * channel_count);
    std::array<float*, 4> planes{};
    for (std::size_t c = 0; c < channel_count; ++c) planes[c] = values.data() + c * width;
    PatternRun run;
    run.place = {moved(corner.u, 0.5 * step, unit.width),
                 moved(corner.v, (first + row + 0.5) * step, unit.height)};
    run.step_u = footprint.u_across;
    run.count = width;
    texture->sample_run(run, footprint, std::span<float* const>(planes.data(), channel_count));
    const auto out = band.row(row);
    std::array<double, 4> pixel{};
    for (std::size_t i = 0; i < width; ++i) {
      for (std::size_t c = 0; c < channel_count; ++c) pixel[c] = static_cast<double>(planes[c][i]);
      store_pixel(std::span<const double>(pixel.data(), channel_count), target,
                  out.subspan(i * channel_count, channel_count));
    }
  });
  return band;
}

MapFormat picture_format(const SceneMap& map) {
  return {map.name, map.role, is_light(map.role) ? Encoding::srgb : Encoding::linear, Depth::u8};
}

} // namespace tilepack
