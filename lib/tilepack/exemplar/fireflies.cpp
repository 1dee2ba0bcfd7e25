#include "tilepack/exemplar/fireflies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace tilepack {
namespace {

constexpr float brighter = 8;
constexpr double ordinary_share = 0.99;
constexpr std::size_t at_most_one_in = 200;

// The brightest channel, alpha left out.
float brightness(std::span<const float> texel, std::size_t colors) {
  return *std::max_element(texel.begin(), texel.begin() + static_cast<std::ptrdiff_t>(colors));
}

float usual_brightness(const Image& image, std::size_t colors) {
  constexpr std::size_t most = 250'000;
  const std::size_t texels =
      static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  const std::size_t step = (texels + most - 1) / most, width = static_cast<std::size_t>(image.width());
  std::vector<float> values;
  for (std::size_t i = 0; i < texels; i += step)
    values.push_back(
        brightness(image.texel(static_cast<int>(i % width), static_cast<int>(i / width)), colors));
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(ordinary_share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

// What all neighbours but two stay below.
float most_neighbours(const Image& image, int x, int y, std::size_t colors) {
  std::vector<float> values;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (const int u = x + dx, v = y + dy;
          (dx != 0 || dy != 0) && u >= 0 && v >= 0 && u < image.width() && v < image.height())
        values.push_back(brightness(image.texel(u, v), colors));
  if (values.size() < 3) return 0;
  // A spark may be two or three texels large; the corner of a lamp has three bright neighbours.
  std::nth_element(values.begin(), values.end() - 3, values.end());
  return *(values.end() - 3);
}

} // namespace

std::vector<Firefly> fireflies(const SampleMap& map) {
  const Image& image = map.image;
  if (!is_light(map.role) || map.depth == Depth::u8 || map.depth == Depth::u16) return {};
  const auto colors = static_cast<std::size_t>(color_channels(image.channels()));
  const float usual = usual_brightness(image, colors);
  std::vector<Firefly> found;
  if (!(usual > 0)) return found;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const float value = brightness(image.texel(x, y), colors);
      if (value > brighter * usual && value > brighter * most_neighbours(image, x, y, colors))
        found.push_back({x, y, static_cast<double>(value) / static_cast<double>(usual)});
    }
  const std::size_t texels =
      static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  if (found.size() * at_most_one_in > texels) return {};
  std::stable_sort(found.begin(), found.end(),
                   [](const Firefly& a, const Firefly& b) { return a.times > b.times; });
  return found;
}

std::string listed(const std::vector<Firefly>& found) {
  if (found.empty()) return "";
  constexpr std::size_t most = 4;
  std::string text = fmt::format("{} texel{} far brighter than all round {} (fireflies):", found.size(),
                                 found.size() == 1 ? "" : "s", found.size() == 1 ? "it" : "them");
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i)
    text += fmt::format("{} ({}, {})", i == 0 ? "" : ",", found[i].x, found[i].y);
  text += fmt::format("{}, up to {:.0f} times as bright as nearly all others",
                      found.size() > most ? " …" : "", found.front().times);
  return text;
}

} // namespace tilepack
