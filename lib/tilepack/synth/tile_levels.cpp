#include "tilepack/synth/tile_levels.h"

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
