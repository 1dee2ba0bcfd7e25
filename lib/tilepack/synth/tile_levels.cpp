#include "tilepack/synth/tile_levels.h"

#include "tilepack/match/row_ssd.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace tilepack {

TileLevels::TileLevels(const SearchSpace& search_space, const SourceCanvas& tile)
    : space(&search_space), canvas(&tile) {
  const std::size_t wanted = space->pyramid.size() - 1;
  if (wanted > 0) smaller.push_back(half_of(full_size()));
  while (smaller.size() < wanted) smaller.push_back(half_of(smaller.back()));
}

Overlap TileLevels::overlap(std::size_t level) const {
  if (level == 0) {
    const FeatureImage& image = space->image();
    Overlap overlap(canvas->width, canvas->height, image.channels);
    for (int y = 0; y < canvas->height; ++y)
      for (int x = 0; x < canvas->width; ++x) {
        const SourceTexel s = canvas->at(x, y);
        if (s != no_source && !in_guard(space->shape, x, y)) overlap.add(x, y, image.texel(s.x, s.y));
      }
    return overlap;
  }
  const auto& [f, known] = smaller[level - 1];
  Overlap overlap(f.width, f.height, f.channels);
  std::size_t i = 0;
  for (int y = 0; y < f.height; ++y)
    for (int x = 0; x < f.width; ++x, ++i)
      if (known[i]) overlap.add(x, y, f.texel(x, y));
  return overlap;
}

SourceTexel TileLevels::best_near(std::size_t level, SourceTexel start, int distance) const {
  const FeatureImage& image = space->pyramid[level];
  const int w = canvas->width >> level, h = canvas->height >> level;
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<SourceTexel> places; // of the tile's north-west texel
  for (int dy = -distance; dy <= distance; ++dy)
    for (int dx = -distance; dx <= distance; ++dx)
      places.push_back(
          {std::clamp(start.x + dx, 0, image.width - w), std::clamp(start.y + dy, 0, image.height - h)});
  std::vector<std::int64_t> mismatches(places.size());
  std::vector<std::uint8_t> row(static_cast<std::size_t>(w) * channels);
  std::vector<std::uint8_t> known(static_cast<std::size_t>(w));
  for (int y = 0; y < h; ++y) {
    const std::uint8_t* shown = row.data();
    const std::uint8_t* is_known = known.data();
    if (level == 0) {
      for (int x = 0; x < w; ++x) {
        const SourceTexel s = canvas->at(x, y);
        const auto i = static_cast<std::size_t>(x);
        known[i] = s != no_source && !in_guard(space->shape, x, y);
        if (known[i])
          std::copy_n(image.texel(s.x, s.y), channels,
                      row.begin() + static_cast<std::ptrdiff_t>(i * channels));
      }
    } else {
      const Level& own = smaller[level - 1];
      shown = own.features.texel(0, y);
      is_known =
          own.known.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(own.features.width);
    }
    for (int x = 0; x < w;) {
      if (!is_known[x]) {
        ++x;
        continue;
      }
      int end = x + 1;
      while (end < w && is_known[end]) ++end;
      const std::size_t bytes = static_cast<std::size_t>(end - x) * channels;
      for (std::size_t p = 0; p < places.size(); ++p)
        mismatches[p] += squared_difference_of_bytes(shown + static_cast<std::size_t>(x) * channels,
                                                     image.texel(places[p].x + x, places[p].y + y), bytes);
      x = end;
    }
  }
  return places[static_cast<std::size_t>(std::min_element(mismatches.begin(), mismatches.end()) -
                                         mismatches.begin())];
}

TileLevels::Level TileLevels::full_size() const {
  const FeatureImage& image = space->image();
  Level level{{canvas->width, canvas->height, image.channels, {}}, {}};
  level.features.values.resize(canvas->texels.size() * static_cast<std::size_t>(image.channels));
  level.known.resize(canvas->texels.size());
  for (int y = 0; y < canvas->height; ++y)
    for (int x = 0; x < canvas->width; ++x) {
      const std::size_t i = canvas->index(x, y);
      const SourceTexel s = canvas->texels[i];
      if (s == no_source || in_guard(space->shape, x, y)) continue;
      level.known[i] = 1;
      std::copy_n(image.texel(s.x, s.y), image.channels,
                  level.features.values.begin() + static_cast<std::ptrdiff_t>(i) * image.channels);
    }
  return level;
}

TileLevels::Level TileLevels::half_of(const Level& fine) {
  Level coarse{halved(fine.features), {}};
  for (int y = 0; y < coarse.features.height; ++y)
    for (int x = 0; x < coarse.features.width; ++x) {
      const auto known = [&](int i, int j) {
        return fine.known[static_cast<std::size_t>(2 * y + j) *
                              static_cast<std::size_t>(fine.features.width) +
                          static_cast<std::size_t>(2 * x + i)] != 0;
      };
      coarse.known.push_back(known(0, 0) && known(1, 0) && known(0, 1) && known(1, 1));
    }
  return coarse;
}

std::vector<TileLevels> tile_levels(const SearchSpace& space, const std::vector<SourceCanvas>& framed) {
  std::vector<std::optional<TileLevels>> built(framed.size());
  tbb::parallel_for(std::size_t{0}, framed.size(),
                    [&](std::size_t id) { built[id].emplace(space, framed[id]); });
  std::vector<TileLevels> levels;
  levels.reserve(built.size());
  for (auto& one : built) levels.push_back(std::move(*one));
  return levels;
}

} // namespace tilepack
