#include "tilepack/exemplar/feature_image.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <cstddef>
#include <utility>

namespace tilepack {
namespace {

// How one channel of a map becomes a feature: value → offset, slope, or the curve v / (v + mean).
struct Curve {
  bool compressed = false;
  double mean = 0.0;
  double low = 0.0;
  double scale = 255.0;
  double most = 255.0; // what lies beyond it is as good as it
};

struct Source {
  const Image* image = nullptr;
  int channel = 0;
  int alpha = -1; // channel that multiplies, if any
  Curve curve;
};

double weight_of(Role role) {
  switch (role) {
  case Role::color:
  case Role::emissive:
    return 1.0;
  case Role::normal:
    return 0.5;
  case Role::roughness:
    return 0.375;
  case Role::height:
    return 0.625;
  case Role::data:
  case Role::ao:
  case Role::metallic:
  case Role::opacity:
    break;
  }
  return 0.25;
}

std::uint8_t feature(const Source& source, std::span<const float> texel) {
  double v = static_cast<double>(texel[static_cast<std::size_t>(source.channel)]);
  if (source.curve.compressed)
    v = v > 0.0 ? v / (v + source.curve.mean) : 0.0;
  else
    v -= source.curve.low;
  v *= source.curve.scale;
  if (source.alpha >= 0)
    v *= std::clamp(static_cast<double>(texel[static_cast<std::size_t>(source.alpha)]), 0.0, 1.0);
  return static_cast<std::uint8_t>(std::clamp(v + 0.5, 0.0, source.curve.most));
}

// The value below which `share` of an image's values lie, those of the first `channels` channels. Of a large image
// evenly spread texels are asked.
double quantile(const Image& image, int channels, double share) {
  constexpr std::size_t most_texels = 250'000;
  const std::size_t texels =
      static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  const std::size_t step = (texels + most_texels - 1) / most_texels;
  std::vector<float> values;
  for (std::size_t i = 0; i < texels; i += step) {
    const auto texel = image.texel(static_cast<int>(i % static_cast<std::size_t>(image.width())),
                                   static_cast<int>(i / static_cast<std::size_t>(image.width())));
    values.insert(values.end(), texel.begin(), texel.begin() + channels);
  }
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), nth, values.end());
  return static_cast<double>(*nth);
}

// A few texels that are much brighter than all others (sparks, suns, faults of a camera) say nothing of the
// brightness of a sample: values count up to `clipped`.
constexpr double usual_share = 0.99;
constexpr double most_of_usual = 4.0; // of the largest usual brightness
constexpr double spare_range = 0.25;  // of the usual range of heights, to either side

double mean_of_positive(const Image& image, int channels, double clipped) {
  double sum = 0.0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const auto texel = image.texel(x, y);
      for (int c = 0; c < channels; ++c)
        sum += std::clamp(static_cast<double>(texel[static_cast<std::size_t>(c)]), 0.0, clipped);
    }
  return sum / (static_cast<double>(image.width()) * image.height() * channels);
}

// The range of nearly all values, and a quarter of it to either side where there are any: what lies farther out is
// as good as there.
std::pair<double, double> usual_range(const Image& image) {
  const auto [low, high] = std::minmax_element(image.data().begin(), image.data().end());
  const double from = quantile(image, image.channels(), 1.0 - usual_share);
  const double to = quantile(image, image.channels(), usual_share);
  const double spare = (to - from) * spare_range;
  if (!(spare > 0.0)) return {static_cast<double>(*low), static_cast<double>(*high)};
  return {std::max(static_cast<double>(*low), from - spare),
          std::min(static_cast<double>(*high), to + spare)};
}

void add_sources(const SampleMap& map, std::vector<Source>& sources) {
  const Image& image = map.image;
  const double weight = weight_of(map.role);
  const bool alpha = has_alpha(map.role, image.channels());
  const int plain_channels = image.channels() - (alpha ? 1 : 0);
  Curve curve;
  curve.scale = 255.0 * weight;
  if (is_light(map.role) && map.encoding == Encoding::linear) {
    curve.compressed = true;
    const double clipped = std::max(most_of_usual * quantile(image, plain_channels, usual_share), 0.0);
    curve.mean = std::max(mean_of_positive(image, plain_channels, clipped), 1e-30);
  } else if (map.role == Role::height) {
    const auto [low, high] = usual_range(image);
    curve.low = low;
    curve.most = 255.0 * weight;
    curve.scale = high > low ? 255.0 * weight / (high - low) : 0.0;
  }
  for (int c = 0; c < plain_channels; ++c) sources.push_back({&image, c, alpha ? plain_channels : -1, curve});
  if (alpha) {
    Curve plain;
    plain.scale = 255.0 * weight_of(Role::data);
    sources.push_back({&image, plain_channels, -1, plain});
  }
}

bool varies(const Source& source) {
  const Image& image = *source.image;
  const std::uint8_t first = feature(source, image.texel(0, 0));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (feature(source, image.texel(x, y)) != first) return true;
  return false;
}

} // namespace

FeatureImage feature_image(std::span<const SampleMap> samples) {
  std::vector<Source> sources;
  for (const SampleMap& map : samples) add_sources(map, sources);
  const Source fallback = sources.front();
  std::erase_if(sources, [](const Source& source) { return !varies(source); });
  if (sources.empty()) sources.push_back(fallback);
  if (sources.size() > max_feature_channels) sources.resize(max_feature_channels);

  const Image& any = samples.front().image;
  FeatureImage result{any.width(), any.height(), static_cast<int>(sources.size()), {}};
  const std::size_t row = static_cast<std::size_t>(any.width()) * sources.size();
  result.values.resize(row * static_cast<std::size_t>(any.height()));
  tbb::parallel_for(0, any.height(), [&](int y) {
    std::uint8_t* value = result.values.data() + static_cast<std::size_t>(y) * row;
    for (int x = 0; x < any.width(); ++x)
      for (const Source& source : sources) *value++ = feature(source, source.image->texel(x, y));
  });
  return result;
}

FeatureImage halved(const FeatureImage& image) {
  FeatureImage result{
      image.width / 2, image.height / 2, image.channels, {}, image.guides, image.flat_seam, {}};
  const std::size_t row = static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.channels);
  result.values.resize(row * static_cast<std::size_t>(result.height));
  tbb::parallel_for(0, result.height, [&](int y) {
    std::uint8_t* value = result.values.data() + static_cast<std::size_t>(y) * row;
    for (int x = 0; x < result.width; ++x) {
      const std::uint8_t* a = image.texel(2 * x, 2 * y);
      const std::uint8_t* b = image.texel(2 * x, 2 * y + 1);
      for (int c = 0; c < image.channels; ++c) {
        const int sum = a[c] + a[c + image.channels] + b[c] + b[c + image.channels];
        *value++ = static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  });
  if (image.sensitivity.empty()) return result;
  result.sensitivity.reserve(static_cast<std::size_t>(result.width) *
                             static_cast<std::size_t>(result.height));
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      const auto at = [&](int i, int j) {
        return image.sensitivity[static_cast<std::size_t>(2 * y + j) * static_cast<std::size_t>(image.width) +
                                 static_cast<std::size_t>(2 * x + i)];
      };
      result.sensitivity.push_back(
          static_cast<std::uint8_t>((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1) + 2) / 4));
    }
  return result;
}

} // namespace tilepack
