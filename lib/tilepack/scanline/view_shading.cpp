#include "tilepack/scanline/view_shading.h"

#include "tilepack/error/error.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

constexpr int most_probes = 16;
constexpr double fade_levels = 2;

// The mean of the coarsest level in linear light, colors weighed by alpha as the sampler does.
std::array<double, 4> mean_of(const Pack& pack, int map) {
  const int level = static_cast<int>(pack.maps[static_cast<std::size_t>(map)].levels.size()) - 1;
  const PackTexels texels(pack, map, level, level);
  const Size tile = texels.tile_size(level);
  const auto channels = static_cast<std::size_t>(texels.channels());
  const int width = tile.width * pack.layout.columns, height = tile.height * pack.layout.rows;
  std::array<double, 4> plain{}, weighed{};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto texel = texels.texel(level, {0, 0}, x, y);
      const double coverage = texels.has_alpha() ? static_cast<double>(texel.back()) : 1.0;
      for (std::size_t c = 0; c < channels; ++c) {
        plain[c] += static_cast<double>(texel[c]);
        weighed[c] += coverage * static_cast<double>(texel[c]);
      }
    }
  const double count = static_cast<double>(width) * height;
  const bool alpha = texels.has_alpha() && plain[channels - 1] > 0;
  std::array<double, 4> mean{};
  for (std::size_t c = 0; c < channels; ++c) {
    const bool color = alpha && c + 1 < channels;
    mean[c] = color ? weighed[c] / plain[channels - 1] : plain[c] / count;
  }
  return mean;
}

// One weighed sum of colors and coverage, so that probes over transparent texels do not bleed.
void add_weighed(std::span<double> sum, std::span<const double> value, double weight, bool alpha) {
  const double coverage = alpha ? value.back() : 1.0;
  for (std::size_t c = 0; c + 1 < value.size(); ++c) sum[c] += weight * coverage * value[c];
  sum.back() += weight * value.back();
}

void resolve(std::span<double> sum, bool alpha) {
  if (!alpha || !(sum.back() > 0)) return;
  for (std::size_t c = 0; c + 1 < sum.size(); ++c) sum[c] /= sum.back();
}

void renormalise(std::span<double> normal) {
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) square += (2 * normal[c] - 1) * (2 * normal[c] - 1);
  if (!(square > 0)) return;
  const double length = std::sqrt(square);
  for (std::size_t c = 0; c < 3; ++c) normal[c] = 0.5 + 0.5 * ((2 * normal[c] - 1) / length);
}

} // namespace

std::string_view name_of(ViewFilter filter) {
  switch (filter) {
  case ViewFilter::trilinear:
    return "trilinear";
  case ViewFilter::anisotropic:
    return "anisotropic";
  case ViewFilter::ewa:
    break;
  }
  return "elliptical";
}

ViewFilter view_filter_of(const std::string& name) {
  for (ViewFilter filter : {ViewFilter::trilinear, ViewFilter::anisotropic, ViewFilter::ewa}) {
    if (name == name_of(filter)) return filter;
  }
  throw Error(ErrorKind::usage, "--filter",
              "'" + name + "' is no filter of camera views; there are trilinear, anisotropic and elliptical");
}

Probes probes_for(const Footprint& f, Size tile, ViewFilter filter) {
  if (filter == ViewFilter::ewa) return {1, level_of(ellipse_of(f, tile)), 0, 0};
  // J = (ux uy; vx vy) in texels; J Jᵀ = (a b; b c) has the squares of the half axes as eigenvalues.
  const double ux = f.u_across * tile.width, uy = f.u_down * tile.width;
  const double vx = f.v_across * tile.height, vy = f.v_down * tile.height;
  const double a = ux * ux + uy * uy, b = ux * vx + uy * vy, c = vx * vx + vy * vy;
  const double middle = 0.5 * (a + c), half = 0.5 * (a - c);
  const double spread = std::sqrt(half * half + b * b);
  const double major = std::sqrt(middle + spread);
  Probes probes;
  if (!(major > 1)) return probes; // magnified: level 0
  if (filter == ViewFilter::anisotropic) {
    // The product of the eigenvalues is det², which keeps the small one's digits.
    const double minor = std::abs(ux * vy - uy * vx) / major;
    const double ratio = major / std::max(minor, 1.0);
    probes.count = static_cast<int>(std::clamp(std::ceil(ratio), 1.0, static_cast<double>(most_probes)));
    // The eigenvector of the larger eigenvalue, from whichever row of the matrix is the longer.
    const double x = half >= 0 ? half + spread : b, y = half >= 0 ? b : spread - half;
    const double length = std::sqrt(x * x + y * y);
    if (length > 0) {
      probes.u_axis = x / length * major / tile.width;
      probes.v_axis = y / length * major / tile.height;
    }
  }
  probes.level = std::max(0.0, exact_log2(major / probes.count));
  return probes;
}

ViewTexture::ViewTexture(const Pack& pack, int map, const RenderTarget& of_target, ViewFilter of_filter,
                         WrapMode border)
    : sampler(pack, map, default_corner_width, border), target(of_target), filter(of_filter),
      tile(pack.tile_size) {
  const PackedMap& packed = pack.maps[static_cast<std::size_t>(map)];
  coarsest = static_cast<int>(packed.levels.size()) - 1;
  normals = packed.role == Role::normal && packed.channels >= 3;
  alpha = packed.role == Role::color && packed.channels % 2 == 0;
  mean = mean_of(pack, map);
}

void ViewTexture::shade_pixel(const ViewPixels& pixels, std::size_t at, std::span<double> value) const {
  const ViewSpan& view = pixels.spans[static_cast<std::size_t>(pixels.span[at])];
  const double u = pixels.u[at], v = pixels.v[at];
  const Footprint covered = footprint(view, pixels.step[at], u, v);
  const Probes probes = probes_for(covered, tile, filter);
  const double fade = std::clamp((probes.level - coarsest) / fade_levels, 0.0, 1.0);
  std::fill(value.begin(), value.end(), 0.0);
  if (fade < 1) {
    std::array<double, 4> buffer{};
    const std::span<double> probe(buffer.data(), value.size());
    for (int i = 0; i < probes.count; ++i) {
      const double t = (i + 0.5) / probes.count - 0.5;
      const Span& span = view.span;
      const TileCoordinate x{span.u.tile, span.u.fraction + (u + t * probes.u_axis)};
      const TileCoordinate y{span.v.tile, span.v.fraction + (v + t * probes.v_axis)};
      if (filter == ViewFilter::ewa)
        sampler.sample(x, y, covered, probe);
      else
        sampler.sample(x, y, probes.level, Filter::trilinear, probe);
      add_weighed(value, probe, (1 - fade) / probes.count, alpha);
    }
  }
  if (fade > 0) add_weighed(value, std::span<const double>(mean.data(), value.size()), fade, alpha);
  resolve(value, alpha);
  if (normals) renormalise(value);
}

Image ViewTexture::shade(const ViewPixels& pixels, std::span<const float> background) const {
  const auto count = static_cast<std::size_t>(channels());
  const std::size_t encoded = target.encoding == Encoding::srgb ? count - (count % 2 == 0 ? 1 : 0) : 0;
  Image image(pixels.width, pixels.rows, channels());
  std::array<double, 4> buffer{};
  const std::span<double> value(buffer.data(), count);
  for (std::size_t at = 0; at < pixels.span.size(); ++at) {
    float* const out = image.data().data() + at * count;
    if (pixels.span[at] < 0) {
      std::copy_n(background.begin(), count, out);
      continue;
    }
    shade_pixel(pixels, at, value);
    for (std::size_t c = 0; c < encoded; ++c) value[c] = linear_to_srgb(value[c]);
    for (std::size_t c = 0; c < count; ++c) out[c] = quantised(static_cast<float>(value[c]), target.depth);
  }
  return image;
}

} // namespace tilepack
