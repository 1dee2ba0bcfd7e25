#include "tilepack/match/patch_search.h"

#include "tilepack/match/plane_transform.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tilepack {

Overlap::Overlap(int patch_width, int patch_height, int channel_count)
    : width(patch_width), height(patch_height), channels(channel_count),
      weight(static_cast<std::size_t>(patch_width) * static_cast<std::size_t>(patch_height)),
      weighted(weight.size() * static_cast<std::size_t>(channel_count)) {}

void Overlap::add(int x, int y, const std::uint8_t* texel, int texel_weight) {
  const std::size_t i =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  weight[i] += texel_weight;
  for (int c = 0; c < channels; ++c) {
    const int value = texel[c];
    weighted[i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c)] += texel_weight * value;
    constant += static_cast<std::int64_t>(texel_weight) * value * value;
  }
}

struct PatchSearch::Spectra {
  struct Part {
    Rect area; // of the image
    PlaneTransform transform;
    std::vector<ComplexPlane> pairs; // the transforms of the pairs of values below
  };
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<Part> parts;
};

namespace {

// What is correlated are channels + 1 planes of values: the sums of squares with the weights, and each channel with
// what the patch has of it. Two of them make one complex plane, for (a + ib) times the conjugate of (c + id) has the
// real part ac + bd, and the sum of all is what is wanted. Squares are far larger than values, and weights far
// smaller than weighted values; a power of two makes them alike, so that neither drowns the other's low digits.
constexpr double square_scale = 1.0 / 512;

int pair_count(int channels) {
  return (channels + 2) / 2;
}

// Exact for |v| < 2^51: adding 1.5 * 2^52 leaves no room for a fraction, so the sum is rounded to an integer.
std::int64_t nearest_integer(double v) {
  constexpr double shift = 6755399441055744.0;
  return static_cast<std::int64_t>((v + shift) - shift);
}

// The whole image, or the middles of its quarters.
std::vector<Rect> searched_parts(const FeatureImage& image, Size largest_patch, std::int64_t most_texels) {
  const double texels = static_cast<double>(image.width) * image.height;
  if (texels <= static_cast<double>(most_texels)) return {{0, 0, image.width, image.height}};
  const double share = std::sqrt(static_cast<double>(most_texels) / 4.0 / texels);
  const auto side = [&](int whole, int patch) {
    return std::min(whole, std::max(static_cast<int>(whole * share), 2 * patch));
  };
  const int w = side(image.width, largest_patch.width);
  const int h = side(image.height, largest_patch.height);
  struct Run {
    int from, length;
  };
  const auto runs = [](int whole, int part) {
    if (2 * part >= whole) return std::vector{Run{0, whole}};
    return std::vector{Run{std::clamp(whole / 4 - part / 2, 0, whole - part), part},
                       Run{std::clamp(3 * whole / 4 - part / 2, 0, whole - part), part}};
  };
  std::vector<Rect> parts;
  for (const Run& y : runs(image.height, h))
    for (const Run& x : runs(image.width, w)) parts.push_back({x.from, y.from, x.length, y.length});
  return parts;
}

} // namespace

PatchSearch::PatchSearch(const FeatureImage& image, Size largest_patch, std::int64_t most_texels)
    : spectra(std::make_unique<Spectra>()) {
  Spectra& s = *spectra;
  s.width = image.width;
  s.height = image.height;
  s.channels = image.channels;
  for (const Rect& area : searched_parts(image, largest_patch, most_texels)) {
    const int rows = transform_size(area.height), columns = transform_size(area.width);
    Spectra::Part& part = s.parts.emplace_back(Spectra::Part{area, PlaneTransform(rows, columns), {}});
    const auto value = [&](const std::uint8_t* texel, int plane) {
      if (plane > 0) return plane > image.channels ? 0.0 : texel[plane - 1];
      int sum = 0;
      for (int i = 0; i < image.channels; ++i) sum += texel[i] * texel[i];
      return square_scale * sum;
    };
    for (int pair = 0; pair < pair_count(image.channels); ++pair) {
      ComplexPlane& plane = part.pairs.emplace_back(rows, columns);
      for (int y = 0; y < area.height; ++y)
        for (int x = 0; x < area.width; ++x) {
          const std::uint8_t* texel = image.texel(area.x + x, area.y + y);
          plane.real_row(y)[x] = value(texel, 2 * pair);
          plane.imaginary_row(y)[x] = value(texel, 2 * pair + 1);
        }
      part.transform.forward(plane, {area.width, area.height});
    }
  }
}

PatchSearch::~PatchSearch() = default;

std::int64_t PositionMap::at(int x, int y) const {
  for (const Part& part : parts) {
    const Rect& a = part.area;
    if (x >= a.x && y >= a.y && x < a.x + a.width && y < a.y + a.height)
      return part.values[static_cast<std::size_t>(y - a.y) * static_cast<std::size_t>(a.width) +
                         static_cast<std::size_t>(x - a.x)];
  }
  return ruled_out;
}

PositionMap PatchSearch::mismatches(const Overlap& overlap) const {
  const Spectra& s = *spectra;
  PositionMap map;
  map.width = s.width - overlap.width + 1;
  map.height = s.height - overlap.height + 1;
  for (const Spectra::Part& part : s.parts) {
    // sum w |S - v|² = (S² ⋆ w) - 2 sum over channels (S ⋆ w v) + constant, ⋆ a correlation. Positions at
    // which the patch would wrap round the padded image are not read.
    const int rows = part.pairs.front().rows, columns = part.pairs.front().columns;
    ComplexPlane total(rows, columns), plane(rows, columns);
    const auto value = [&](std::size_t texel, int number) {
      if (number == 0) return overlap.weight[texel] / square_scale;
      if (number > s.channels) return 0.0;
      return -2.0 * overlap.weighted[texel * static_cast<std::size_t>(s.channels) +
                                     static_cast<std::size_t>(number - 1)];
    };
    for (int pair = 0; pair < pair_count(s.channels); ++pair) {
      std::size_t i = 0;
      for (int y = 0; y < overlap.height; ++y)
        for (int x = 0; x < overlap.width; ++x, ++i) {
          plane.real_row(y)[x] = value(i, 2 * pair);
          plane.imaginary_row(y)[x] = value(i, 2 * pair + 1);
        }
      part.transform.forward(plane, {overlap.width, overlap.height});
      add_correlation(part.pairs[static_cast<std::size_t>(pair)], plane, total, pair == 0);
    }
    const int high = part.area.height - overlap.height + 1;
    const int wide = part.area.width - overlap.width + 1;
    part.transform.inverse(total, {wide, high});
    PositionMap::Part& found = map.parts.emplace_back();
    found.area = {part.area.x, part.area.y, wide, high};
    found.values.reserve(static_cast<std::size_t>(wide) * static_cast<std::size_t>(high));
    for (int y = 0; y < high; ++y) {
      const double* row = total.real_row(y);
      for (int x = 0; x < wide; ++x) found.values.push_back(nearest_integer(row[x]) + overlap.constant);
    }
  }
  return map;
}

std::int64_t mismatch_at(const FeatureImage& image, const Overlap& overlap, SourceTexel position) {
  std::int64_t sum = overlap.constant;
  std::size_t i = 0;
  for (int y = 0; y < overlap.height; ++y)
    for (int x = 0; x < overlap.width; ++x, ++i) {
      if (overlap.weight[i] == 0) continue;
      const std::uint8_t* texel = image.texel(position.x + x, position.y + y);
      for (int c = 0; c < overlap.channels; ++c) {
        const int value = texel[c];
        const std::size_t j = i * static_cast<std::size_t>(overlap.channels) + static_cast<std::size_t>(c);
        sum += static_cast<std::int64_t>(value) * (overlap.weight[i] * value - 2 * overlap.weighted[j]);
      }
    }
  return sum;
}

SourceTexel best_near(const FeatureImage& image, const Overlap& overlap, SourceTexel start, int distance) {
  std::int64_t best = std::numeric_limits<std::int64_t>::max();
  SourceTexel place;
  for (int dy = -distance; dy <= distance; ++dy)
    for (int dx = -distance; dx <= distance; ++dx) {
      const SourceTexel at{std::clamp(start.x + dx, 0, image.width - overlap.width),
                           std::clamp(start.y + dy, 0, image.height - overlap.height)};
      const std::int64_t mismatch = mismatch_at(image, overlap, at);
      if (mismatch < best) {
        best = mismatch;
        place = at;
      }
    }
  return place;
}

} // namespace tilepack
