#include "tilepack/mip/far_levels.h"

#include "tilepack/mip/level_values.h"
#include "tilepack/mip/normal_variance.h"
#include "tilepack/numeric/as_size.h"
#include "tilepack/tileset/value_space.h"

#include <algorithm>
#include <array>

namespace tilepack {
namespace {

Image decoded_level(const PlacedLevel& level) {
  Image image = level.texels;
  for (int y = 0; y < image.height(); ++y) decode(image.row(y), level.map, image.row(y));
  return image;
}

// What texel `index` of `count` covers of `side` finer ones along one axis: those from `first` on, each by its share.
struct CoveredRun {
  int first = 0;
  std::vector<double> shares;

  CoveredRun(int index, int count, int side) {
    const double begin = static_cast<double>(index) * side / count;
    const double end = static_cast<double>(index + 1) * side / count;
    first = static_cast<int>(begin);
    for (int at = first; at < side && at < end; ++at)
      if (const double share = std::min<double>(at + 1, end) - std::max<double>(at, begin);
          share > 1e-9 || at == first)
        shares.push_back(share);
  }
};

// `from` in fewer texels, layer by layer.
Image averaged(const Image& from, Size size, int layers, bool alpha) {
  Image to(size.width, size.height, from.channels());
  const int from_height = from.height() / layers, to_height = size.height / layers;
  std::array<double, ValueSums::max_channels> mean{};
  const std::span<double> channels(mean.data(), as_size(from.channels()));
  for (int layer = 0; layer < layers; ++layer)
    for (int y = 0; y < to_height; ++y)
      for (int x = 0; x < size.width; ++x) {
        const CoveredRun across(x, size.width, from.width()), down(y, to_height, from_height);
        ValueSums sums;
        double total = 0;
        for (std::size_t j = 0; j < down.shares.size(); ++j)
          for (std::size_t i = 0; i < across.shares.size(); ++i) {
            const double share = across.shares[i] * down.shares[j];
            sums.add(from.texel(across.first + static_cast<int>(i),
                                layer * from_height + down.first + static_cast<int>(j)),
                     share, alpha);
            total += share;
          }
        sums.resolve(channels, alpha, total);
        const auto texel = to.texel(x, layer * to_height + y);
        for (std::size_t c = 0; c < channels.size(); ++c) texel[c] = static_cast<float>(channels[c]);
      }
  return to;
}

} // namespace

std::vector<Image> far_levels(const PlacedLevel& last, int layers, const std::vector<Size>& sizes,
                              const PlacedLevel* normals) {
  const Image values = decoded_level(last);
  const bool alpha = value_space(last.map).has_alpha();
  const std::vector<RoughnessChannel> rough = roughness_channels(last.map, values.channels());
  Image directions;
  if (normals != nullptr && !rough.empty()) directions = decoded_level(*normals);
  std::vector<Image> levels;
  for (const Size size : sizes) {
    Image level = averaged(values, size, layers, alpha);
    if (!directions.empty()) add_normal_variance(level, averaged(directions, size, layers, false), rough);
    for (int y = 0; y < level.height(); ++y) encode(level.row(y), last.map, level.row(y));
    levels.push_back(std::move(level));
  }
  return levels;
}

} // namespace tilepack
