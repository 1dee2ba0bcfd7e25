#include "tilepack/bake/material_normals.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace tilepack {
namespace {

struct Extent {
  float low = 0;
  float high = 0;
  float width() const { return high - low; }
};

Extent extent_of(const Image& image, std::size_t channel) {
  const auto channels = static_cast<std::size_t>(image.channels());
  const Texels& values = image.data();
  Extent e{values[channel], values[channel]};
  for (std::size_t at = channel; at < values.size(); at += channels) {
    e.low = std::min(e.low, values[at]);
    e.high = std::max(e.high, values[at]);
  }
  return e;
}

// What a decoder or a filter may be off by: 2 codes of 8 bits.
constexpr float slack = 2.0f / 255.0f;

float stored_z(float x, float y) {
  const double dx = 2.0 * static_cast<double>(x) - 1, dy = 2.0 * static_cast<double>(y) - 1;
  return static_cast<float>(0.5 + 0.5 * std::sqrt(std::max(0.0, 1 - dx * dx - dy * dy)));
}

// A map of three channels whose first two are channels `x` and `y` of the image.
Image with_z(const Image& image, std::size_t x, std::size_t y, Depth depth) {
  Image result = Image::unset(image.size(), 3);
  for (int row = 0; row < image.height(); ++row)
    for (int column = 0; column < image.width(); ++column) {
      const auto from = image.texel(column, row);
      const auto to = result.texel(column, row);
      to[0] = from[x];
      to[1] = from[y];
      to[2] = quantised(stored_z(from[x], from[y]), depth);
    }
  return result;
}

// Components of -1 to 1 instead of 0..1; only floats can hold them.
bool is_signed(const Image& image) {
  const std::size_t components = std::min<std::size_t>(3, static_cast<std::size_t>(image.channels()));
  for (std::size_t c = 0; c < components; ++c)
    if (extent_of(image, c).low < -slack) return true;
  if (components < 3) return false;
  // A surface that leans one way everywhere has no negative ones: unit vectors as they stand, and not decoded.
  double as_they_are = 0, decoded = 0;
  const auto channels = static_cast<std::size_t>(image.channels());
  for (std::size_t at = 0; at < image.data().size(); at += channels) {
    double plain = 0, halved = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double v = static_cast<double>(image.data()[at + c]);
      plain += v * v;
      halved += (2 * v - 1) * (2 * v - 1);
    }
    as_they_are += std::fabs(std::sqrt(plain) - 1);
    decoded += std::fabs(std::sqrt(halved) - 1);
  }
  const double texels = static_cast<double>(image.data().size()) / static_cast<double>(channels);
  return as_they_are / texels < 0.02 && decoded / texels > 0.1;
}

void check_components(const SampleMap& map, bool signed_ones) {
  const auto channels = static_cast<std::size_t>(map.image.channels());
  const float low = (signed_ones ? -1.0f : 0.0f) - 4 * slack, high = 1.0f + 4 * slack;
  for (std::size_t at = 0; at < map.image.data().size(); ++at) {
    const float v = map.image.data()[at];
    if (at % channels >= 3 || (v >= low && v <= high)) continue;
    const int texel = static_cast<int>(at / channels);
    throw Error(ErrorKind::invalid_content, map.label(),
                fmt::format("holds {} at texel ({}, {}); components of normals are 0 to 1, or -1 to 1: scale "
                            "the map, or give it another role",
                            v, texel % map.image.width(), texel / map.image.width()));
  }
}

} // namespace

std::vector<std::string> complete_normals(SampleMap& map) {
  const int channels = map.image.channels();
  if (channels == 1)
    throw Error(ErrorKind::invalid_content, map.label(),
                "has 1 channel, and a normal map has 3: x, y and z; give another role, such as height");
  std::vector<std::string> notes;
  const bool floats = map.depth == Depth::f16 || map.depth == Depth::f32;
  const bool signed_ones = floats && is_signed(map.image);
  if (floats) check_components(map, signed_ones);
  if (signed_ones) {
    for (std::size_t at = 0; at < map.image.data().size(); ++at)
      if (channels != 4 || at % 4 != 3) {
        float& v = map.image.data()[at];
        v = quantised(v * 0.5f + 0.5f, map.depth);
      }
    notes.emplace_back("holds normals of -1 to 1; they are stored as n * 0.5 + 0.5, 0 to 1");
  }
  const auto varies = [&](std::size_t c) { return extent_of(map.image, c).width() > slack; };
  if (channels == 2) {
    map.image = with_z(map.image, 0, 1, map.depth);
    notes.emplace_back("holds x and y of its normals; z is worked out and stored beside them");
  } else if (channels == 4 && !varies(0) && !varies(2) && varies(1) && varies(3)) {
    map.image = with_z(map.image, 3, 1, map.depth);
    notes.emplace_back(
        "holds x in alpha and y in green (DXT5nm); they are put in red and green, z is worked out");
  } else if (!varies(2) && (varies(0) || varies(1))) {
    for (int y = 0; y < map.image.height(); ++y)
      for (int x = 0; x < map.image.width(); ++x) {
        const auto n = map.image.texel(x, y);
        n[2] = quantised(stored_z(n[0], n[1]), map.depth);
      }
    notes.emplace_back("holds nothing in blue; z is worked out from x and y and put there");
  }
  return notes;
}

NormalFigures normal_figures(const Image& normals) {
  std::array<double, 3> sum{};
  NormalFigures figures{0, 0, 0, 0, 0};
  for (int y = 0; y < normals.height(); ++y)
    for (int x = 0; x < normals.width(); ++x) {
      double square = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double n = 2 * static_cast<double>(normals.texel(x, y)[c]) - 1;
        sum[c] += n;
        square += n * n;
      }
      figures.length += std::sqrt(square);
      figures.off += std::fabs(std::sqrt(square) - 1);
    }
  const double texels = static_cast<double>(normals.width()) * normals.height();
  figures.length /= texels;
  figures.off /= texels;
  figures.east = sum[0] / texels;
  figures.green = sum[1] / texels;
  figures.tilt = std::atan2(std::hypot(sum[0], sum[1]), sum[2]) * 180 / std::numbers::pi;
  return figures;
}

std::vector<std::string> doubts_about_normals(const Image& normals) {
  constexpr double most_tilt = 3; // degrees
  constexpr double most_off = 0.1;
  const NormalFigures f = normal_figures(normals);
  std::vector<std::string> notes;
  if (f.tilt > 45)
    notes.push_back(
        fmt::format("has normals that point {:.0f}° away from straight up in the mean: a map in the "
                    "space of an object, or no normal map; a pack needs one in tangent space",
                    f.tilt));
  else if (f.tilt > most_tilt)
    notes.push_back(
        fmt::format("has normals that lean by {:.1f}° in the mean (red {:+.2f}, green {:+.2f}), so the "
                    "whole surface looks tilted; level it, or see whether it was saved as sRGB",
                    f.tilt, f.east, f.green));
  if (f.off > most_off)
    notes.push_back(
        fmt::format("has normals of length {:.2f} in the mean, off by {:.2f}; they are made unit vectors "
                    "past level 0: export the map as plain values, without a color profile",
                    f.length, f.off));
  return notes;
}

namespace {

// Sums of products of two series, for how alike they are: 1 equal but for a factor, -1 opposite.
struct Likeness {
  double ab = 0, aa = 0, bb = 0;
  void add(double a, double b) {
    ab += a * b;
    aa += a * a;
    bb += b * b;
  }
  double value() const { return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0; }
};

struct Slope {
  double east = 0;  // the surface rises so much a texel to the east
  double green = 0; // the second component over the third
};

Slope slope_at(const Image& normals, int x, int y) {
  constexpr double steepest = 0.1; // third component: what is steeper counts as this
  const auto n = normals.texel(x, y);
  const auto component = [&](std::size_t c) { return 2 * static_cast<double>(n[c]) - 1; };
  const double up = std::max(steepest, component(2));
  return {-component(0) / up, component(1) / up};
}

} // namespace

std::optional<GreenEvidence> green_evidence(const Image& normals, const Image* heights) {
  constexpr double clear = 0.15; // likeness; of noise over a million texels it is .001
  constexpr int most_rows = 1024;
  const int step = std::max(1, normals.height() / most_rows);
  Likeness curl, east, south;
  const bool with_heights = heights != nullptr && heights->size() == normals.size();
  for (int y = 1; y + 1 < normals.height(); y += step)
    for (int x = 1; x + 1 < normals.width(); ++x) {
      const double x_along_y = slope_at(normals, x, y + 1).east - slope_at(normals, x, y - 1).east;
      const double y_along_x = slope_at(normals, x + 1, y).green - slope_at(normals, x - 1, y).green;
      curl.add(x_along_y, y_along_x);
      if (!with_heights) continue;
      const auto height = [&](int column, int row) {
        return static_cast<double>(heights->texel(column, row)[0]);
      };
      const Slope here = slope_at(normals, x, y);
      east.add(here.east, height(x + 1, y) - height(x - 1, y));
      south.add(here.green, height(x, y + 1) - height(x, y - 1));
    }
  // Green up is a slope that rises to the south: what faces north lies on the near side of a hill.
  const double by_heights = east.value() * south.value();
  if (std::fabs(east.value()) > clear && std::fabs(south.value()) > clear)
    return GreenEvidence{by_heights > 0 ? NormalY::up : NormalY::down, true};
  if (std::fabs(curl.value()) > clear)
    return GreenEvidence{curl.value() > 0 ? NormalY::up : NormalY::down, false};
  return std::nullopt;
}

void flip_green(SampleMap& map) {
  for (int y = 0; y < map.image.height(); ++y)
    for (int x = 0; x < map.image.width(); ++x) {
      float& green = map.image.texel(x, y)[1];
      green = quantised(1.0f - green, map.depth);
    }
  if (map.normal_y) map.normal_y = *map.normal_y == NormalY::up ? NormalY::down : NormalY::up;
}

} // namespace tilepack
