#include "tilepack/report/worst_places.h"

#include "tilepack/exemplar/feature_pyramid.h"
#include "tilepack/match/patch_search.h"
#include "tilepack/seam/window_lookup.h"

#include <algorithm>

namespace tilepack {
namespace {

constexpr int window_side = 48;                  // texels
constexpr std::int64_t most_looked_at = 100'000; // texels of the sample, at the scale of the look-up
constexpr int enlargement = 3;
constexpr int gap_between = 14;
constexpr int number_room = 24;
constexpr int pairs_in_a_row = 3;

Rect window_round(const Rect& area, Size tile) {
  const int w = std::min(window_side, tile.width), h = std::min(window_side, tile.height);
  return {std::clamp(area.x + area.width / 2 - w / 2, 0, tile.width - w),
          std::clamp(area.y + area.height / 2 - h / 2, 0, tile.height - h), w, h};
}

// Looks windows of tiles up in the sample, at a scale at which all of it can be searched, and then at each larger one.
class LikePlaces {
public:
  explicit LikePlaces(const FeatureImage& features) : pyramid(features) {
    while (static_cast<std::int64_t>(pyramid.back().width) * pyramid.back().height > most_looked_at)
      pyramid.add_half();
  }

  SourceTexel like(const SourceCanvas& tile, Rect window) const {
    int scale = 1 << (pyramid.size() - 1);
    const PatchSearch search(pyramid.back());
    PositionMap map = search.mismatches(overlap(tile, window, scale));
    SourceTexel place{0, 0};
    if (!take_best(map, 1, place)) return place;
    for (std::size_t level = pyramid.size() - 1; level-- > 0;) {
      scale /= 2;
      place = best_near(pyramid[level], overlap(tile, window, scale), {2 * place.x, 2 * place.y}, 2);
    }
    return place;
  }

private:
  Overlap overlap(const SourceCanvas& tile, Rect window, int scale) const {
    Overlap shown(window.width / scale, window.height / scale, pyramid.front().channels);
    add_shown(pyramid.front(), tile, {window.x, window.y}, scale, {}, shown);
    return shown;
  }

  FeaturePyramid pyramid;
};

void draw_enlarged(Image& picture, int left, int top, Rect window, auto&& texel) {
  for (int y = 0; y < window.height * enlargement; ++y)
    for (int x = 0; x < window.width * enlargement; ++x) {
      const auto from = texel(window.x + x / enlargement, window.y + y / enlargement);
      std::copy(from.begin(), from.end(), picture.texel(left + x, top + y).begin());
    }
}

} // namespace

std::vector<WorstPlace> worst_places(const BakedPack& made, int count) {
  const Size tile = made.sources.tile_size;
  const FeatureImage& features = made.sample.features;
  const LikePlaces look_up(features);
  std::vector<WorstPlace> places;
  const auto add = [&](const TilePlace& found, bool tone) {
    const Rect window = window_round(found.area, tile);
    for (const WorstPlace& other : places)
      if (other.tile == found.tile && std::abs(other.area.x - window.x) < window.width / 2 &&
          std::abs(other.area.y - window.y) < window.height / 2)
        return;
    SourceCanvas canvas(tile.width, tile.height);
    canvas.texels = made.sources.texels[static_cast<std::size_t>(found.tile)];
    places.push_back({found.tile, window, look_up.like(canvas, window), tone});
  };
  for (const TilePlace& found : made.report.tones.worst)
    if (static_cast<int>(places.size()) < count / 2) add(found, true);
  for (const TilePlace& found : dearest_places(features, made.sources, 2 * count))
    if (static_cast<int>(places.size()) < count) add(found, false);
  return places;
}

VectorDrawing worst_places_picture(const Image& sample, const SourceMap& sources,
                                   const std::vector<WorstPlace>& places) {
  const int side_x = std::min(window_side, sources.tile_size.width) * enlargement;
  const int side_y = std::min(window_side, sources.tile_size.height) * enlargement;
  const int rows = (static_cast<int>(places.size()) + pairs_in_a_row - 1) / pairs_in_a_row;
  const int wide = 2 * side_x + 3 * gap_between, high = side_y + number_room;
  VectorDrawing drawing{
      Image(pairs_in_a_row * wide, std::max(1, rows) * high + gap_between, 3, 1.0f), {}, {}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const WorstPlace& place = places[i];
    const auto& texels = sources.texels[static_cast<std::size_t>(place.tile)];
    const int left = static_cast<int>(i) % pairs_in_a_row * wide + gap_between;
    const int top = static_cast<int>(i) / pairs_in_a_row * high + number_room;
    draw_enlarged(drawing.background, left, top, place.area, [&](int x, int y) {
      const SourceTexel s =
          texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(sources.tile_size.width) +
                 static_cast<std::size_t>(x)];
      return sample.texel(s.x, s.y);
    });
    draw_enlarged(drawing.background, left + side_x + gap_between / 2, top,
                  {place.like.x, place.like.y, place.area.width, place.area.height}, [&](int x, int y) {
                    return sample.texel(std::min(x, sample.width() - 1), std::min(y, sample.height() - 1));
                  });
    drawing.numbers.push_back(
        {{left + side_x / 2.0, top - number_room / 2.0}, 12, static_cast<int>(i) + 1, {0.75, 0, 0.55, 1}});
  }
  return drawing;
}

} // namespace tilepack
