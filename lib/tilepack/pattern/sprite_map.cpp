#include "tilepack/pattern/sprite_map.h"

#include "tilepack/error/error.h"
#include "tilepack/numeric/wrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

constexpr int most_sprites = 1 << 20;

// Half a side of the upright box round a sprite.
double half_box(const Sprite& sprite) {
  return 0.5 * sprite.scale * (std::fabs(sprite.cosine) + std::fabs(sprite.sine));
}

// The cells along an axis that a sprite's box touches.
std::vector<std::int64_t> touched(TileCoordinate centre, double half, std::int64_t cells) {
  const TileCoordinate c = normalised(centre);
  std::vector<std::int64_t> found{wrapped(c.tile, cells)};
  if (c.fraction - half < 0) found.push_back(wrapped(c.tile - 1, cells));
  if (c.fraction + half > 1) found.push_back(wrapped(c.tile + 1, cells));
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

} // namespace

std::vector<PatternCell> SpriteMap::covered(const Sprite& sprite) const {
  std::vector<PatternCell> found;
  for (const std::int64_t y : touched(sprite.centre.v, half_box(sprite), cells.height))
    for (const std::int64_t x : touched(sprite.centre.u, half_box(sprite), cells.width))
      found.push_back({x, y});
  return found;
}

void SpriteMap::set(int number, const Sprite& sprite) {
  if (number < 0 || number >= most_sprites)
    throw Error(ErrorKind::usage, fmt::format("sprite {}", number),
                fmt::format("sprites are numbered 0 to {}", most_sprites - 1));
  // A box of a whole cell touches three where it lies astride: a hair is taken off it.
  const double box = 2 * half_box(sprite);
  if (!(sprite.scale > 0) || !(box <= 1 + 1e-9) || !std::isfinite(sprite.centre.u.fraction) ||
      !std::isfinite(sprite.centre.v.fraction))
    throw Error(
        ErrorKind::usage, fmt::format("sprite {}", number),
        fmt::format("its box is {:.3g} cells wide; it must be no larger than a cell, and its place finite",
                    box));
  const auto free_for = [&](PatternCell cell) {
    const std::span<const int> there = in_cell(cell);
    return static_cast<int>(there.size()) < most ||
           std::find(there.begin(), there.end(), number) != there.end();
  };
  const std::vector<PatternCell> written = covered(sprite);
  for (const PatternCell& cell : written)
    if (!free_for(cell))
      throw Error(
          ErrorKind::usage, fmt::format("sprite {}", number),
          fmt::format("cell ({}, {}) holds {} sprites already, the most it may", cell.x, cell.y, most));
  remove(number);
  if (sprites.size() <= static_cast<std::size_t>(number))
    sprites.resize(static_cast<std::size_t>(number) + 1);
  sprites[static_cast<std::size_t>(number)] = {true, sprite};
  for (const PatternCell& cell : written) {
    std::vector<int>& there = held[{cell.y, cell.x}];
    there.insert(std::lower_bound(there.begin(), there.end(), number), number);
  }
}

void SpriteMap::remove(int number) {
  if (number < 0 || static_cast<std::size_t>(number) >= sprites.size()) return;
  auto& [there, sprite] = sprites[static_cast<std::size_t>(number)];
  if (!there) return;
  for (const PatternCell& cell : covered(sprite)) {
    const auto at = held.find({cell.y, cell.x});
    std::erase(at->second, number);
    if (at->second.empty()) held.erase(at);
  }
  there = false;
}

std::vector<int> SpriteMap::numbers() const {
  std::vector<int> found;
  for (std::size_t i = 0; i < sprites.size(); ++i)
    if (sprites[i].first) found.push_back(static_cast<int>(i));
  return found;
}

std::span<const int> SpriteMap::in_cell(PatternCell cell) const {
  const auto at = held.find({cell.y, cell.x});
  return at == held.end() ? std::span<const int>{} : std::span<const int>(at->second);
}

TileTransform SpriteMap::seen_from(int number, PatternCell cell) const {
  const Sprite& shown = sprite(number);
  // The centre from this cell, the shortest way round.
  const auto offset = [](TileCoordinate centre, std::int64_t from, std::int64_t count) {
    const TileCoordinate c = normalised(centre);
    std::int64_t away = wrapped(c.tile - from, count);
    if (away > count / 2) away -= count;
    return static_cast<double>(away) + c.fraction;
  };
  return {offset(shown.centre.u, cell.x, cells.width), offset(shown.centre.v, cell.y, cells.height),
          shown.scale, shown.cosine, shown.sine};
}

TileTransform::Inside SpriteMap::inside(int number, PatternCell cell, double u, double v) const {
  return seen_from(number, cell).overflowed(u, v);
}

} // namespace tilepack
