#include "tilepack/pattern/pattern_source.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/place_tiles.h"
#include "tilepack/tileset/value_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

// Tiles as the layers of an array: what FastSampler looks up whatever layout the pack came with, each tile ending at its
// own border.
void lay_as_array(Pack& pack) {
  const Layout before = pack.layout;
  const int tiles = static_cast<int>(before.cells.size());
  PackedMap& map = pack.maps[0];
  for (std::size_t level = 0; level < map.levels.size(); ++level) {
    const std::vector<Image> images =
        tiles_at_level(map.levels[level], before, pack.tile_size, static_cast<int>(level));
    Image column(images[0].width(), images[0].height() * tiles, map.channels);
    std::size_t at = 0;
    for (const Image& image : images) {
      std::copy(image.data().begin(), image.data().end(),
                column.data().begin() + static_cast<std::ptrdiff_t>(at));
      at += image.data().size();
    }
    map.levels[level] = std::move(column);
  }
  map.far_levels.clear(); // of the texture as it was
  pack.full_chain = false;
  pack.layout = {};
  pack.layout.kind = LayoutKind::array;
  pack.layout.columns = 1;
  pack.layout.rows = tiles;
  for (int tile = 0; tile < tiles; ++tile) pack.layout.cells.push_back({tile, 0, tile});
}

} // namespace

// By map of the graph and use. A finer reading takes the place of a coarser one, which stays for who still has it.
struct PatternSource::Stored {
  struct Read {
    Levels levels;
    std::unique_ptr<FastSampler> sampler;
  };
  struct Slot {
    std::atomic<const Levels*> newest{nullptr};
    std::vector<std::unique_ptr<Read>> all;
  };
  std::vector<std::array<Slot, 2>> slots;
  explicit Stored(std::size_t maps) : slots(maps) {}
};

PatternSource::PatternSource(PackFacts facts, Open open)
    : about(std::move(facts)), opener(std::move(open)),
      stored(std::make_unique<Stored>(about.map_of.size())) {}
PatternSource::~PatternSource() = default;

namespace {

// The means of the tiles, of the coarsest level, and how they lie round their own.
void find_means(const Pack& pack, PatternSource::Levels& levels) {
  const PackedMap& map = pack.maps[0];
  const int last = static_cast<int>(map.levels.size()) - 1;
  const std::vector<Image> tiles =
      tiles_at_level(to_linear(map.levels.back(), map.encoding), pack.layout, pack.tile_size, last);
  const bool alpha = value_space(map).has_alpha();
  const auto channels = static_cast<std::size_t>(map.channels);
  ValueSums all;
  std::array<double, 4> squares{}, plain{};
  for (const Image& tile : tiles) {
    ValueSums sums;
    for (int y = 0; y < tile.height(); ++y)
      for (int x = 0; x < tile.width(); ++x) sums.add(tile.texel(x, y), 1.0, alpha);
    std::array<double, 4> mean{};
    sums.resolve({mean.data(), channels}, alpha, static_cast<double>(tile.width()) * tile.height());
    all.add(std::span<const double>(mean.data(), channels), 1.0, alpha);
    for (std::size_t c = 0; c < channels; ++c) {
      plain[c] += mean[c];
      squares[c] += mean[c] * mean[c];
    }
    std::array<float, 4> stored{};
    for (std::size_t c = 0; c < channels; ++c) stored[c] = static_cast<float>(mean[c]);
    levels.means.push_back(stored);
  }
  const auto count = static_cast<double>(tiles.size());
  all.resolve({levels.mean.data(), channels}, alpha, count);
  for (std::size_t c = 0; c < channels; ++c)
    levels.deviation[c] = std::sqrt(std::max(0.0, squares[c] / count - plain[c] * plain[c] / count / count));
}

} // namespace

Pack PatternSource::opened_pack(int map, int first_level) const {
  Pack pack = opener({about.map_of[static_cast<std::size_t>(map)], first_level});
  if (pack.maps.size() != 1 || pack.layout.cells.empty())
    throw Error(ErrorKind::internal, about.name,
                fmt::format("{} maps were read where one was asked for", pack.maps.size()));
  return pack;
}

Pack PatternSource::stored_pack(int map, Use use, int first_level) const {
  const std::scoped_lock lock(opening);
  Pack pack = opened_pack(map, first_level);
  if (use == Use::patterns) lay_as_array(pack);
  return pack;
}

const PatternSource::Levels& PatternSource::levels(int map, Use use, int level) const {
  Stored::Slot& slot = stored->slots[static_cast<std::size_t>(map)][use == Use::wang ? 0 : 1];
  const int wanted = std::clamp(level, 0, about.levels - 1);
  const Levels* newest = slot.newest.load(std::memory_order_acquire);
  if (newest != nullptr && newest->first_level <= wanted) return *newest;
  const std::scoped_lock lock(opening);
  newest = slot.newest.load(std::memory_order_relaxed);
  if (newest != nullptr && newest->first_level <= wanted) return *newest;
  Pack pack = opened_pack(map, wanted);
  auto read = std::make_unique<Stored::Read>();
  read->levels.first_level = wanted;
  find_means(pack, read->levels);
  if (use == Use::patterns || pack.layout.kind == LayoutKind::rotated) lay_as_array(pack);
  if (use == Use::patterns) {
    pack.corner_pack.reset();
    pack.mapping = {};
    pack.mapping.kind = MappingKind::index;
    const auto tiles = static_cast<int>(pack.layout.cells.size());
    pack.mapping.size = {tiles, 1};
    for (int tile = 0; tile < tiles; ++tile) pack.mapping.ids.push_back(tile);
  }
  read->sampler = std::make_unique<FastSampler>(pack, 0);
  (use == Use::wang ? read->levels.wang : read->levels.patterns) = read->sampler.get();
  held += read->sampler->bytes() + read->levels.means.size() * sizeof(read->levels.means[0]);
  ++opened;
  slot.all.push_back(std::move(read));
  slot.newest.store(&slot.all.back()->levels, std::memory_order_release);
  return slot.all.back()->levels;
}

int PatternSource::finest_level(int map) const {
  int finest = -1;
  for (const Stored::Slot& slot : stored->slots[static_cast<std::size_t>(map)])
    if (const Levels* newest = slot.newest.load();
        newest != nullptr && (finest < 0 || newest->first_level < finest))
      finest = newest->first_level;
  return finest;
}

} // namespace tilepack
