#include "tilepack/synth/border_match_costs.h"

#include <tbb/parallel_for.h>

#include <utility>

namespace tilepack {
namespace {

constexpr EdgeSide both_sides[] = {EdgeSide::before, EdgeSide::after};

Positions inside_positions(const FeatureImage& image, Size tile, std::size_t most_positions) {
  Positions p;
  for (;; ++p.stride) {
    p.columns = (image.width - tile.width) / p.stride + 1;
    p.rows = (image.height - tile.height) / p.stride + 1;
    if (p.count() <= most_positions) return p;
  }
}

FeatureImage transposed(const FeatureImage& image) {
  FeatureImage result{image.height, image.width, image.channels, {}};
  result.values.reserve(image.values.size());
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      result.values.insert(result.values.end(), image.texel(y, x), image.texel(y, x) + image.channels);
  return result;
}

// What a strip shows of a tile on one side of its edge is a row of texels for each distance from the edge,
// shorter from row to row by the squares that belong to the strips of the other direction.
struct SideRow {
  int from = 0;         // along the edge, in the tile
  int to = 0;           // past the last
  int tile_line = 0;    // across the edge, in the tile
  int strip_across = 0; // in the strip's window
};

// `extent`: of the tile, across the edge. `other`: how far strips of the other direction reach.
SideRow side_row(const StripAxes& axes, EdgeSide side, int extent, int other, int distance) {
  // As framed_tiles() has it: the diagonal belongs to the horizontal strips.
  const int skip = axes.direction == Direction::horizontal ? (distance * other + axes.reach - 1) / axes.reach
                                                           : distance * other / axes.reach + 1;
  const bool before = side == EdgeSide::before;
  return {skip, std::max(skip, axes.length - skip), before ? extent - 1 - distance : distance,
          before ? axes.reach - 1 - distance : axes.reach + distance};
}

SideRow side_row(const FrameShape& shape, const StripAxes& axes, EdgeSide side, int distance) {
  return axes.direction == Direction::horizontal
             ? side_row(axes, side, shape.tile.height, shape.reach.x, distance)
             : side_row(axes, side, shape.tile.width, shape.reach.y, distance);
}

} // namespace

const std::uint8_t* StripAt::shown(int along, int across) const {
  const int half = axes.corner_reach / 2;
  const SourceTexel t = axes.at(along, across);
  SourceTexel s = sum(place, t);
  if (along < half) s = sum(corner_origin(axes, first, End::first), t);
  if (along >= axes.length - half) s = sum(corner_origin(axes, second, End::second), t);
  return image.clamped_texel(s.x, s.y);
}

BorderMatchCosts::BorderMatchCosts(const FeatureImage& image, const FrameShape& frame_shape,
                                   std::size_t most_positions)
    : shape(frame_shape), places(inside_positions(image, shape.tile, most_positions)),
      views{view_of(image, axes_of(shape, Direction::horizontal)),
            view_of(transposed(image), axes_of(shape, Direction::vertical))} {}

BorderMatchCosts::View BorderMatchCosts::view_of(FeatureImage image, const StripAxes& axes) const {
  const bool swapped = axes.direction == Direction::vertical;
  PairPlanes pairs(image, places.stride);
  View view{std::move(image),
            std::move(pairs),
            swapped ? places.columns : places.rows,
            swapped ? places.rows : places.columns,
            {}};
  const FeatureImage& own = view.image;
  const auto stride = static_cast<std::size_t>(own.width) + 1;
  std::vector<std::int64_t> sums(stride * static_cast<std::size_t>(own.height)); // of the texels before
  for (int y = 0; y < own.height; ++y)
    for (int x = 0; x < own.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x);
      sums[i + 1] = sums[i];
      for (int c = 0; c < own.channels; ++c) sums[i + 1] += own.texel(x, y)[c] * own.texel(x, y)[c];
    }
  for (const EdgeSide side : both_sides) {
    std::vector<std::int64_t>& squares = view.squares[static_cast<std::size_t>(side)];
    squares.resize(places.count());
    for (int distance = 0; distance < axes.reach; ++distance) {
      const SideRow row = side_row(shape, axes, side, distance);
      for (int line = 0; line < view.lines; ++line) {
        const std::int64_t* of_line =
            sums.data() + static_cast<std::size_t>(line * places.stride + row.tile_line) * stride;
        std::int64_t* square =
            squares.data() + static_cast<std::size_t>(line) * static_cast<std::size_t>(view.places);
        for (int i = 0; i < view.places; ++i)
          square[i] += of_line[i * places.stride + row.to] - of_line[i * places.stride + row.from];
      }
    }
  }
  return view;
}

MatchCostMap BorderMatchCosts::of_side(const StripAt& strip, EdgeSide side) const {
  const StripAxes& axes = strip.axes;
  const bool swapped = axes.direction == Direction::vertical;
  const View& view = views[swapped ? 1 : 0];
  // sum |S - v|² = sum S² - 2 sum S v + sum v², S of the inside and v of the strip.
  std::vector<PairTerm> terms;
  std::int64_t constant = 0;
  for (int distance = 0; distance < axes.reach; ++distance) {
    const SideRow row = side_row(shape, axes, side, distance);
    for (int along = row.from; along < row.to; along += 2) {
      const std::uint8_t* first = strip.shown(along, row.strip_across);
      const std::uint8_t* second = along + 1 < row.to ? strip.shown(along + 1, row.strip_across) : nullptr;
      for (int c = 0; c < view.image.channels; ++c) {
        const int v = first[c], w = second != nullptr ? second[c] : 0;
        terms.push_back({view.pairs.index(c, along, row.tile_line), static_cast<std::int16_t>(v),
                         static_cast<std::int16_t>(w)});
        constant += v * v + w * w;
      }
    }
  }
  MatchCostMap map(places.count());
  std::vector<std::int64_t> products(static_cast<std::size_t>(view.places));
  const std::int64_t* squares = view.squares[static_cast<std::size_t>(side)].data();
  for (int line = 0; line < view.lines; ++line, squares += view.places) {
    correlate_pairs(view.pairs.data() + 2 * line * places.stride * view.pairs.row_pitch(), terms, products);
    for (int place = 0; place < view.places; ++place) {
      const std::int64_t sum = squares[place] - 2 * products[static_cast<std::size_t>(place)] + constant;
      const int i = swapped ? line : place;
      const int j = swapped ? place : line;
      map[static_cast<std::size_t>(j) * static_cast<std::size_t>(places.columns) +
          static_cast<std::size_t>(i)] = static_cast<float>(static_cast<double>(sum) / axes.reach);
    }
  }
  return map;
}

std::array<MatchCostMap, 2> BorderMatchCosts::of(const StripAt& strip) const {
  return {of_side(strip, EdgeSide::before), of_side(strip, EdgeSide::after)};
}

} // namespace tilepack
