#include "tilepack/measure/against_reference.h"

#include "tilepack/image/peak_to_noise.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/numeric/random.h"
#include "tilepack/sampler/ground_truth.h"
#include "tilepack/sampler/reference_sampler.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tilepack {
namespace {

using Value = std::array<double, 4>;

double drawn(std::uint64_t seed, std::string_view purpose, std::uint64_t index) {
  return static_cast<double>(random_bits(seed, purpose, index) >> 11) * 0x1p-53;
}

// A fraction of the tile whose two texels along this axis lie within the tile, or across a border of it.
double inside(double u, int side) {
  return (0.5 + u * (side - 1)) / side;
}
double across(double u, int side) {
  return u < 0.5 ? u / side : 1.0 - (1.0 - u) / side;
}

struct DrawnPlace {
  TileCoordinate x;
  TileCoordinate y;
};

DrawnPlace drawn_place(const Pack& pack, Size tile, Zone zone, std::uint64_t seed, std::uint64_t index) {
  const auto cell = [&](std::string_view axis, std::int64_t side) {
    return static_cast<std::int64_t>(drawn(seed, axis, index) * static_cast<double>(side));
  };
  const double u = drawn(seed, "zone x", index);
  const double v = drawn(seed, "zone y", index);
  // Edges: half of the places on vertical ones, half on horizontal, as far as tiles have an inside.
  const bool vertical = index % 2 == 0 ? tile.height > 1 : tile.width <= 1;
  const bool cross_x = zone == Zone::corner || (zone == Zone::edge && vertical);
  const bool cross_y = zone == Zone::corner || (zone == Zone::edge && !vertical);
  return {
      {cell("cell x", pack.mapping.size.width), cross_x ? across(u, tile.width) : inside(u, tile.width)},
      {cell("cell y", pack.mapping.size.height), cross_y ? across(v, tile.height) : inside(v, tile.height)}};
}

bool has_places(Size tile, Zone zone) {
  switch (zone) {
  case Zone::interior:
    return tile.width > 1 && tile.height > 1;
  case Zone::edge:
    return tile.width > 1 || tile.height > 1;
  case Zone::corner:
    break;
  }
  return true;
}

class ReferenceRun {
public:
  ReferenceRun(const Pack& of_pack, int map_index)
      : pack(of_pack), map(of_pack.maps[static_cast<std::size_t>(map_index)]),
        through_pack(of_pack, map_index), truth(GroundTruth::of_level_0(of_pack, map_index)),
        stored(GroundTruth::of_stored_levels(of_pack, map_index)) {}

  ZoneError zone_error(int level, Zone zone, int lookups, std::uint64_t seed) const;
  double jump(int level, bool corners, int lookups, std::uint64_t seed) const;

private:
  std::size_t channels() const { return static_cast<std::size_t>(map.channels); }
  std::span<double> part(Value& value) const { return {value.data(), channels()}; }

  // In 8-bit units of the encoded value; alpha, the last of 2 or 4, is not encoded.
  double encoded(double linear, std::size_t channel) const {
    const bool light = static_cast<int>(channel) < color_channels(map.channels);
    return 255.0 * (map.encoding == Encoding::srgb && light ? linear_to_srgb(linear) : linear);
  }

  const Pack& pack;
  const PackedMap& map;
  ReferenceSampler through_pack;
  GroundTruth truth;
  GroundTruth stored;
};

ZoneError ReferenceRun::zone_error(int level, Zone zone, int lookups, std::uint64_t seed) const {
  const Size tile = level_size(pack.tile_size, level);
  ZoneError error;
  error.zone = zone;
  if (!has_places(tile, zone)) return error;
  error.lookups = lookups;
  std::vector<std::array<Value, 3>> values(static_cast<std::size_t>(lookups));
  tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t i) {
    const DrawnPlace place = drawn_place(pack, tile, zone, seed, i);
    through_pack.sample(place.x, place.y, level, Filter::bilinear, part(values[i][0]));
    truth.sample(place.x, place.y, level, Filter::bilinear, part(values[i][1]));
    stored.sample(place.x, place.y, level, Filter::bilinear, part(values[i][2]));
  });
  double sum = 0;
  double squares = 0;
  for (const auto& [got, wanted, wanted_stored] : values)
    for (std::size_t c = 0; c < channels(); ++c) {
      const double own = encoded(got[c], c);
      const double off = std::fabs(own - encoded(wanted[c], c));
      sum += off;
      squares += off * off;
      error.largest = std::max(error.largest, off);
      if (got[c] != wanted_stored[c])
        error.neighbours = std::max(error.neighbours, std::fabs(own - encoded(wanted_stored[c], c)));
    }
  const double count = static_cast<double>(lookups) * map.channels;
  error.mean = sum / count;
  error.rms = std::sqrt(squares / count);
  constexpr double rounding = 1e-9; // what sums of doubles in another order differ by, in 8-bit units
  if (error.rms > rounding) error.psnr = peak_to_noise(255.0, error.rms);
  return error;
}

// On a border itself: once as the end of the western (or northern) tile, once as the start of the next.
double ReferenceRun::jump(int level, bool corners, int lookups, std::uint64_t seed) const {
  const Size tile = level_size(pack.tile_size, level);
  if (!corners && !has_places(tile, Zone::interior)) return 0;
  const double before_end = std::nextafter(1.0, 0.0);
  std::vector<std::array<Value, 2>> values(static_cast<std::size_t>(lookups));
  tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t i) {
    DrawnPlace place = drawn_place(pack, tile, corners ? Zone::corner : Zone::interior, seed, i);
    TileCoordinate& axis = i % 2 == 0 ? place.x : place.y;
    axis.fraction = before_end;
    through_pack.sample(place.x, place.y, level, Filter::bilinear, part(values[i][0]));
    axis = {axis.tile + 1, 0.0};
    through_pack.sample(place.x, place.y, level, Filter::bilinear, part(values[i][1]));
  });
  double squares = 0;
  for (const auto& [before, after] : values)
    for (std::size_t c = 0; c < channels(); ++c) {
      const double step = encoded(before[c], c) - encoded(after[c], c);
      squares += step * step;
    }
  const double rms = std::sqrt(squares / (static_cast<double>(lookups) * map.channels));
  return rms < 1e-9 ? 0.0 : rms; // `before_end` is not quite the border
}

} // namespace

ReferenceErrors against_reference(const Pack& pack, int map, int lookups, std::uint64_t seed,
                                  const Progress& progress) {
  const ReferenceRun run(pack, map);
  const PackedMap& packed = pack.maps[static_cast<std::size_t>(map)];
  ReferenceErrors result{packed.name, std::string(name_of(pack.mip_mode)), pack.guard, {}};
  const int levels = static_cast<int>(packed.levels.size());
  for (int level = 0; level < levels; ++level) {
    report(progress, "against the ground truth", static_cast<double>(level) / levels);
    LevelError error;
    error.level = level;
    for (const Zone zone : {Zone::interior, Zone::edge, Zone::corner})
      error.zones.push_back(run.zone_error(level, zone, lookups, seed));
    error.jump = run.jump(level, false, lookups, seed);
    error.corner_jump = run.jump(level, true, lookups, seed);
    result.levels.push_back(std::move(error));
  }
  return result;
}

std::vector<ReferenceErrors> against_reference(const Pack& pack, int lookups, std::uint64_t seed,
                                               const Progress& progress) {
  std::vector<ReferenceErrors> all;
  for (std::size_t map = 0; map < pack.maps.size(); ++map)
    all.push_back(against_reference(pack, static_cast<int>(map), lookups, seed, progress));
  return all;
}

} // namespace tilepack
