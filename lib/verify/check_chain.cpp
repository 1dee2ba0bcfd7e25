#include "tilepack/mip/downsample.h"
#include "tilepack/verify/level_view.h"
#include "tilepack/verify/structure_checks.h"

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

// Levels whose texels are plain boxes of the finer level's. Normals are renormalised, roughness takes up what
// they lose, and alpha may be scaled to keep its coverage: those are the mip stage's own affair.
bool plain_boxes(const PackedMap& map) {
  const bool averaged = map.role == Role::color || map.role == Role::height || map.role == Role::data;
  return averaged && map.channels % 2 == 1;
}

double full_range(const PackedMap& map) {
  if (map.depth == Depth::u8 || map.depth == Depth::u16) return 1;
  double largest = 0;
  for (const float v : map.levels.front().data())
    if (std::isfinite(v)) largest = std::max(largest, std::abs(static_cast<double>(v)));
  return largest > 0 ? largest : 1;
}

// to_linear() with the 256 codes of 8-bit maps looked up: it is most of the work otherwise.
Image decoded(Image tile, Encoding encoding, Depth depth) {
  if (encoding == Encoding::linear) return tile;
  if (depth != Depth::u8) return to_linear(tile, encoding);
  static const std::vector<float> table = [] {
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
  const Encoding encoding = fine.map->role == Role::color ? fine.map->encoding : Encoding::linear;
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

std::vector<Issue> check_map(const Pack& pack, const PackedMap& map) {
  std::vector<Issue> issues;
  const int levels = std::min(static_cast<int>(map.levels.size()), level_count(pack.tile_size));
  if (levels < 2 || !plain_boxes(map)) return issues;
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

} // namespace

std::vector<Issue> check_chain(const Pack& pack) {
  std::vector<Issue> issues;
  for (const PackedMap& map : pack.maps) {
    std::vector<Issue> found = check_map(pack, map);
    issues.insert(issues.end(), found.begin(), found.end());
  }
  return issues;
}

} // namespace tilepack
