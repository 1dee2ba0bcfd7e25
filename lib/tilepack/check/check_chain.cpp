#include "tilepack/check/level_view.h"
#include "tilepack/check/structure_checks.h"
#include "tilepack/layout/place_tiles.h"
#include "tilepack/mip/downsample.h"
#include "tilepack/mip/far_levels.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/mip/normal_variance.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tilepack {
namespace {

// Rounding a level to 8 bits and then its halves moves a texel by 1/255 at most, half of that in the mean; an
// edit that can be seen moves it by more. 16-bit maps and floats are held to the same measure of what can be
// seen.
constexpr double largest_rms = 1.5 / 255;

// Sides of turned tiles whose few texels still tell a blur from an edit.
constexpr int smallest_turned = 8;

// to_linear() with the 256 codes of 8-bit maps looked up: it is most of the work otherwise.
Image decoded(Image tile, Encoding encoding, Depth depth) {
  if (encoding == Encoding::linear) return tile;
  if (depth != Depth::u8) return to_linear(tile, encoding);
  static const Texels table = [] {
    Image codes(256, 1, 1);
    for (int i = 0; i < 256; ++i) codes.texel(i, 0)[0] = static_cast<float>(i) / 255.0f;
    return to_linear(codes, Encoding::srgb).data();
  }();
  for (float& value : tile.data()) value = table[static_cast<std::size_t>(code_of(value, 255))];
  return tile;
}

// RMS of a tile's texels against the boxes of the finer level, without the outermost row: that one is
// sanitized. Only finer texels off the border go into the others, so what was sanitized there does not
// matter.
std::optional<double> rms_inside(const LevelView& fine, const LevelView& coarse, int tile) {
  const auto& from = fine.rects[static_cast<std::size_t>(tile)];
  const auto& to = coarse.rects[static_cast<std::size_t>(tile)];
  if (!from || !to || to->width < 3 || to->height < 3) return std::nullopt;
  if (from->width != 2 * to->width || from->height != 2 * to->height) return std::nullopt;
  const Encoding encoding = is_light(fine.map->role) ? fine.map->encoding : Encoding::linear;
  const Image boxes = halved(decoded(crop(*fine.image, *from), encoding, fine.map->depth), Weighting::plain);
  const Image expected = from_linear(crop(boxes, {1, 1, to->width - 2, to->height - 2}), encoding);
  double sum = 0;
  for (int y = 1; y < to->height - 1; ++y)
    for (int x = 1; x < to->width - 1; ++x) {
      const auto is = coarse.image->texel(to->x + x, to->y + y);
      const auto should = expected.texel(x - 1, y - 1);
      for (std::size_t c = 0; c < is.size(); ++c) {
        const double difference = static_cast<double>(is[c]) - static_cast<double>(should[c]);
        if (std::isfinite(difference)) sum += difference * difference;
      }
    }
  return std::sqrt(sum / (static_cast<double>(to->width - 2) * (to->height - 2) * fine.image->channels()));
}

// The mean step between texels next to each other, as a root of squares: what moving a tile by a part of a
// texel changes at most.
double rms_step(const Image& image) {
  double sum = 0;
  double count = 0;
  const auto add = [&](std::span<const float> a, std::span<const float> b) {
    for (std::size_t c = 0; c < a.size(); ++c) {
      const double step = static_cast<double>(a[c]) - static_cast<double>(b[c]);
      if (std::isfinite(step)) sum += step * step;
      ++count;
    }
  };
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      if (x > 0) add(image.texel(x, y), image.texel(x - 1, y));
      if (y > 0) add(image.texel(x, y), image.texel(x, y - 1));
    }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

Image inner(const Image& tile) {
  return crop(tile, {1, 1, tile.width() - 2, tile.height() - 2});
}

double rms_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.data().size(); ++i) {
    const double difference = static_cast<double>(a.data()[i]) - static_cast<double>(b.data()[i]);
    if (std::isfinite(difference)) sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(a.data().size()));
}

// Levels of turned tiles: the tiles read back from them.
std::vector<Issue> check_turned_map(const Pack& pack, const PackedMap& map) {
  std::vector<Issue> issues;
  const int levels = std::min(static_cast<int>(map.levels.size()), level_count(pack.tile_size));
  const Encoding encoding = is_light(map.role) ? map.encoding : Encoding::linear;
  const double range = full_range(map);
  const auto tiles_of_level = [&](int level) -> std::vector<Image> {
    const Image& image = map.levels[static_cast<std::size_t>(level)];
    if (!has_right_size(pack, image, level)) return {};
    return tiles_at_level(image, pack.layout, pack.tile_size, level);
  };
  std::vector<Image> fine = tiles_of_level(0);
  for (int level = 1; level < levels; ++level) {
    std::vector<Image> coarse = tiles_of_level(level);
    for (std::size_t id = 0; id < std::min(fine.size(), coarse.size()); ++id) {
      if (coarse[id].width() < smallest_turned) break;
      const Image boxes =
          inner(from_linear(halved(decoded(fine[id], encoding, map.depth), Weighting::plain), encoding));
      const double rms = rms_difference(boxes, inner(coarse[id]));
      const double allowed = largest_rms * range + rms_step(boxes);
      if (rms > allowed)
        issues.push_back(
            {Rule::level_stale, fmt::format("{}, tile {}", place_name(map, level), id),
             fmt::format("differs from the boxes of level {} by {:.3g}/255 of the range (RMS)", level - 1,
                         rms / range * 255),
             fmt::format("at most {:.2g}/255, what turning and rounding explain", allowed / range * 255)});
    }
    fine = std::move(coarse);
  }
  return issues;
}

std::vector<Issue> check_map(const Pack& pack, const PackedMap& map) {
  std::vector<Issue> issues;
  const int levels = std::min(static_cast<int>(map.levels.size()), level_count(pack.tile_size));
  if (levels < 2 || !plain_boxes(map)) return issues;
  if (pack.layout.kind == LayoutKind::rotated)
    return places_are_sound(pack.layout, tile_count(pack.tiles)) ? check_turned_map(pack, map) : issues;
  const double range = full_range(map);
  const auto tiles = static_cast<std::size_t>(tile_count(pack.tiles));
  LevelView fine = view_of(pack, map, 0);
  for (int level = 1; level < levels; ++level) {
    LevelView coarse = view_of(pack, map, level);
    std::vector<std::optional<double>> rms(tiles);
    if (fine.image->channels() == coarse.image->channels())
      tbb::parallel_for(std::size_t{0}, tiles,
                        [&](std::size_t i) { rms[i] = rms_inside(fine, coarse, static_cast<int>(i)); });
    for (std::size_t i = 0; i < tiles; ++i)
      if (rms[i] && *rms[i] > largest_rms * range)
        issues.push_back({Rule::level_stale, fmt::format("{}, tile {}", place_name(map, level), i),
                          fmt::format("differs from the boxes of level {} by {:.3g}/255 of the range (RMS)",
                                      level - 1, *rms[i] / range * 255),
                          fmt::format("at most {:.2g}/255, what rounding explains", largest_rms * 255)});
    fine = std::move(coarse);
  }
  return issues;
}

// Far levels against the means of the last level of tiles. Roughness takes up what normals lose, if it was told to.
std::vector<Issue> check_far_levels(const Pack& pack, const PackedMap& map) {
  std::vector<Issue> issues;
  if (map.levels.empty() || map.far_levels.empty() || !roughness_channels(map, map.channels).empty())
    return issues;
  const int last = static_cast<int>(map.levels.size()) - 1;
  if (last + 1 != pack.tile_levels || !has_right_size(pack, map.levels.back(), last)) return issues;
  const TileMap format{map, {Image(1, 1, map.channels)}};
  const std::vector<Image> expected =
      far_levels({map.levels.back(), format}, pack.layout.kind == LayoutKind::array ? pack.layout.rows : 1,
                 far_level_sizes(pack.layout, pack.tile_size, pack.tile_levels));
  const double range = full_range(map);
  for (std::size_t i = 0; i < std::min(expected.size(), map.far_levels.size()); ++i) {
    const Image& stored = map.far_levels[i];
    if (stored.size() != expected[i].size() || stored.channels() != map.channels) continue;
    const double rms = rms_difference(expected[i], stored);
    if (rms > largest_rms * range)
      issues.push_back({Rule::level_stale, place_name(map, last + 1 + static_cast<int>(i)),
                        fmt::format("differs from the means of level {} by {:.3g}/255 of the range (RMS)",
                                    last, rms / range * 255),
                        fmt::format("at most {:.2g}/255, what rounding explains", largest_rms * 255)});
  }
  return issues;
}

} // namespace

std::vector<Issue> check_chain(const Pack& pack) {
  std::vector<Issue> issues;
  for (const PackedMap& map : pack.maps)
    for (std::vector<Issue> found : {check_map(pack, map), check_far_levels(pack, map)})
      issues.insert(issues.end(), found.begin(), found.end());
  return issues;
}

} // namespace tilepack
