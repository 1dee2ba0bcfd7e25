#include "tilepack/pattern/pixel_map.h"

#include "tilepack/error/error.h"
#include "tilepack/numeric/wrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace tilepack {
namespace {

constexpr int most_materials = 16;
constexpr std::int64_t longest_pixel_side = std::int64_t{1} << 24;

void check_materials(int materials, std::int64_t width, std::int64_t height) {
  if (materials < 1 || materials > most_materials || width < 1 || height < 1 || width > longest_pixel_side ||
      height > longest_pixel_side)
    throw Error(
        ErrorKind::invalid_content, "pixel map",
        fmt::format("{} x {} pixels of {} materials; there are 1 to 2^24 pixels a side and 1 to {} materials",
                    width, height, materials, most_materials));
}

std::int64_t square_side(std::int64_t width, std::int64_t height) {
  return static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(std::max(width, height))));
}

} // namespace

// Joins four squares into one: of one material, if they are.
std::int32_t PixelMap::joined(const Square& square) {
  const std::int32_t first = square.child[0];
  if (first < 0 && std::all_of(square.child, square.child + 4, [&](std::int32_t c) { return c == first; }))
    return first;
  std::vector<double> share(static_cast<std::size_t>(count));
  for (const std::int32_t child : square.child) share_of(child, 0.25, share);
  for (const double s : share) shares.push_back(static_cast<float>(s));
  squares.push_back(square);
  return static_cast<std::int32_t>(squares.size() - 1);
}

void PixelMap::share_of(std::int32_t square, double weight, std::span<double> out) const {
  if (square >= 0) {
    const float* share = shares.data() + static_cast<std::size_t>(square) * static_cast<std::size_t>(count);
    for (std::size_t m = 0; m < out.size(); ++m) out[m] += weight * static_cast<double>(share[m]);
  } else if (-1 - square < count) {
    out[static_cast<std::size_t>(-1 - square)] += weight;
  }
}

// Squares from top to bottom: of stored pixels, or of outlines.
struct PixelMap::Builder {
  struct Edge {
    double x0, y0, x1, y1;
    std::size_t outline;
  };
  // Whether a square's first pixel lies inside each outline.
  using Inside = std::vector<char>;

  PixelMap& map;
  std::span<const MaterialOutline> outlines = {};
  int ground = 0;

  bool beyond(std::int64_t x, std::int64_t y) const { return x >= map.width || y >= map.height; }

  template <typename Part>
  std::int32_t quartered(std::int64_t x, std::int64_t y, std::int64_t size, Part&& part) {
    const std::int64_t half = size / 2;
    Square square{};
    for (int i = 0; i < 4; ++i) square.child[i] = part(x + (i & 1) * half, y + (i >> 1) * half, half);
    return map.joined(square);
  }

  std::int32_t of_pixels(const Grid<std::uint8_t>& pixels, std::int64_t x, std::int64_t y,
                         std::int64_t size) {
    if (beyond(x, y)) return -1 - map.count;
    if (size == 1) return -1 - pixels.at(static_cast<int>(x), static_cast<int>(y));
    return quartered(x, y, size, [&](std::int64_t px, std::int64_t py, std::int64_t half) {
      return of_pixels(pixels, px, py, half);
    });
  }

  // Moved by much less than a pixel, and so that no point is likely to lie on a line through pixel centres, where "inside"
  // is a matter of rounding.
  std::vector<Edge> edges() const {
    constexpr double aside_x = 0x1.3c6ef372fe94fp-21, aside_y = 0x1.6a09e667f3bcdp-21;
    std::vector<Edge> all;
    for (std::size_t o = 0; o < outlines.size(); ++o) {
      const std::vector<double>& p = outlines[o].points;
      for (std::size_t i = 0; i + 1 < p.size(); i += 2) {
        const std::size_t next = i + 3 < p.size() ? i + 2 : 0;
        all.push_back({p[i] + aside_x, p[i + 1] + aside_y, p[next] + aside_x, p[next + 1] + aside_y, o});
      }
    }
    return all;
  }

  static bool spans(double a, double b, double at) { return (a <= at) != (b <= at); }

  // Turns `inside` over for each edge between (x0, y) and (x1, y), resp. (x, y0) and (x, y1).
  static void cross_east(std::span<const Edge> edges, double x0, double x1, double y, Inside& inside) {
    for (const Edge& e : edges)
      if (spans(e.y0, e.y1, y) && spans(x0, x1, e.x0 + (y - e.y0) / (e.y1 - e.y0) * (e.x1 - e.x0)))
        inside[e.outline] ^= 1;
  }
  static void cross_south(std::span<const Edge> edges, double x, double y0, double y1, Inside& inside) {
    for (const Edge& e : edges)
      if (spans(e.x0, e.x1, x) && spans(y0, y1, e.y0 + (x - e.x0) / (e.x1 - e.x0) * (e.y1 - e.y0)))
        inside[e.outline] ^= 1;
  }

  // Whether an edge may pass between the centres of a square's pixels.
  static bool touches(const Edge& e, double x, double y, double reach) {
    if (std::max(e.x0, e.x1) < x || std::min(e.x0, e.x1) > x + reach) return false;
    if (std::max(e.y0, e.y1) < y || std::min(e.y0, e.y1) > y + reach) return false;
    int above = 0;
    for (int i = 0; i < 4; ++i) {
      const double px = x + (i & 1) * reach, py = y + (i >> 1) * reach;
      above += (e.x1 - e.x0) * (py - e.y0) - (e.y1 - e.y0) * (px - e.x0) > 0 ? 1 : 0;
    }
    return above != 0 && above != 4;
  }

  std::int32_t of_edges(std::span<const Edge> edges, const Inside& inside, std::int64_t x, std::int64_t y,
                        std::int64_t size) {
    if (beyond(x, y)) return -1 - map.count;
    const double left = static_cast<double>(x) + 0.5, top = static_cast<double>(y) + 0.5;
    std::vector<Edge> here;
    for (const Edge& e : edges)
      if (touches(e, left, top, static_cast<double>(size - 1))) here.push_back(e);
    if (size == 1 || (here.empty() && !beyond(x + size - 1, y + size - 1))) {
      int material = ground;
      for (std::size_t o = 0; o < outlines.size(); ++o)
        if (inside[o] != 0) material = outlines[o].material;
      return -1 - material;
    }
    return quartered(x, y, size, [&](std::int64_t px, std::int64_t py, std::int64_t half) {
      Inside there = inside;
      const double to_x = static_cast<double>(px) + 0.5, to_y = static_cast<double>(py) + 0.5;
      cross_east(here, left, to_x, top, there);
      cross_south(here, to_x, top, to_y, there);
      return of_edges(here, there, px, py, half);
    });
  }
};

PixelMap::PixelMap(const Grid<std::uint8_t>& pixels, int materials)
    : width(pixels.width), height(pixels.height), count(materials) {
  check_materials(materials, width, height);
  for (const std::uint8_t material : pixels.values)
    if (material >= materials)
      throw Error(ErrorKind::invalid_content, "pixel map",
                  fmt::format("a pixel is of material {}; there are 0 to {}", material, materials - 1));
  side = square_side(width, height);
  root = Builder{*this}.of_pixels(pixels, 0, 0, side);
}

PixelMap::PixelMap(std::int64_t pixels_wide, std::int64_t pixels_high, int materials, int ground,
                   std::span<const MaterialOutline> outlines)
    : width(pixels_wide), height(pixels_high), count(materials) {
  check_materials(materials, width, height);
  const auto unknown = [&](int material) { return material < 0 || material >= materials; };
  for (const MaterialOutline& outline : outlines)
    if (unknown(outline.material) || outline.points.size() < 6 || outline.points.size() % 2 != 0)
      throw Error(
          ErrorKind::invalid_content, "pixel map",
          fmt::format(
              "an outline of material {} with {} numbers; materials are 0 to {}, and outlines have 3 points "
              "or more, 2 numbers each",
              outline.material, outline.points.size(), materials - 1));
  if (unknown(ground))
    throw Error(ErrorKind::invalid_content, "pixel map",
                fmt::format("the ground is of material {}; there are 0 to {}", ground, materials - 1));
  side = square_side(width, height);
  Builder builder{*this, outlines, ground};
  const std::vector<Builder::Edge> edges = builder.edges();
  Builder::Inside inside(outlines.size(), 0);
  double west = 0;
  for (const Builder::Edge& e : edges) west = std::min({west, e.x0, e.x1});
  Builder::cross_east(edges, west - 1, 0.5, 0.5, inside);
  root = builder.of_edges(edges, inside, 0, 0, side);
}

PixelMap::Run PixelMap::at(std::int64_t x, std::int64_t y) const {
  std::int64_t size = side;
  std::int32_t square = root;
  while (square >= 0) {
    size /= 2;
    const int child = ((x & size) != 0 ? 1 : 0) + ((y & size) != 0 ? 2 : 0);
    square = squares[static_cast<std::size_t>(square)].child[child];
  }
  return {-1 - square, std::min(width, (x & -size) + size)};
}

void PixelMap::add_shares(std::int64_t x, std::int64_t y, int level, double weight,
                          std::span<double> out) const {
  x = wrapped(x, width);
  y = wrapped(y, height);
  std::int64_t size = side;
  std::int32_t square = root;
  while (square >= 0 && size > std::int64_t{1} << level) {
    size /= 2;
    const int child = ((x & size) != 0 ? 1 : 0) + ((y & size) != 0 ? 2 : 0);
    square = squares[static_cast<std::size_t>(square)].child[child];
  }
  share_of(square, weight, out);
}

} // namespace tilepack
