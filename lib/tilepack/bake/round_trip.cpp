#include "tilepack/bake/round_trip.h"

#include "tilepack/error/error.h"
#include "tilepack/image/peak_to_noise.h"
#include "tilepack/numeric/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

constexpr ResampleFilter all_filters[] = {ResampleFilter::bilinear, ResampleFilter::bicubic,
                                          ResampleFilter::lanczos};

bool copies(const Layout& layout, Size tile_size) {
  const RotatedGrid& grid = layout.rotated;
  return grid.scheme.k == 0 && grid.size.height == grid.scheme.n * (tile_size.width + 2 * grid.gutter);
}

// Integers reach from 0 to 1; floats as far as they do.
double full_scale(const TileMap& map) {
  if (map.depth == Depth::u8 || map.depth == Depth::u16) return 1;
  double largest = 0;
  for (const Image& tile : map.tiles)
    for (const float value : tile.data())
      if (std::isfinite(value)) largest = std::max(largest, std::fabs(static_cast<double>(value)));
  return largest;
}

double rms_difference(const std::vector<Image>& a, const std::vector<Image>& b) {
  double sum = 0;
  double count = 0;
  for (std::size_t id = 0; id < a.size(); ++id)
    for (std::size_t i = 0; i < a[id].data().size(); ++i) {
      const double d = static_cast<double>(a[id].data()[i]) - static_cast<double>(b[id].data()[i]);
      sum += d * d;
      ++count;
    }
  return std::sqrt(sum / count);
}

// In decibels, rounded to hundredths: as pack.json has it.
std::optional<double> loss(double peak, double rms) {
  const std::optional<double> decibels = peak_to_noise(peak, rms);
  if (!decibels) return {};
  return std::floor(*decibels * 100 + 0.5) / 100;
}

} // namespace

std::vector<RoundTrip> round_trips(const TileMap& finest, const TileColors& tiles, const Layout& layout,
                                   Size tile_size, Outside outside) {
  std::vector<RoundTrip> results;
  const double peak = full_scale(finest);
  for (const ResampleFilter filter : all_filters) {
    results.push_back({filter, std::nullopt});
    if (copies(layout, tile_size)) continue;
    const Image texture =
        quantised(place_tiles(finest, tiles, layout, tile_size, 0, {filter, outside}), finest.depth);
    results.back().psnr =
        loss(peak, rms_difference(tiles_at_level(texture, layout, tile_size, 0), finest.tiles));
  }
  return results;
}

std::vector<RoundTrip> round_trips(const SampleMap& sample, const LayoutCandidate& plan, int tile_side) {
  const Size room{sample.image.width() - tile_side, sample.image.height() - tile_side};
  if (room.width < 0 || room.height < 0)
    throw Error(ErrorKind::invalid_content, sample.name,
                fmt::format("{} x {} texels hold no tile of {}", sample.image.width(), sample.image.height(),
                            tile_side));
  TileMap map(sample, {});
  const int tiles = tile_count(plan.scheme);
  for (int tile = 0; tile < tiles; ++tile) {
    const auto place = [&](const char* axis, int free) {
      return static_cast<int>(
          random_below(0, axis, static_cast<std::uint64_t>(tile), static_cast<std::uint32_t>(free + 1)));
    };
    map.tiles.push_back(crop(
        sample.image, {place("window x", room.width), place("window y", room.height), tile_side, tile_side}));
  }
  const TileColors colors = std::vector<EdgeTile>(static_cast<std::size_t>(tiles));
  return round_trips(map, colors, planned_layout(plan, tile_side), {tile_side, tile_side}, Outside::own);
}

} // namespace tilepack
