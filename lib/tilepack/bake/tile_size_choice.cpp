#include "tilepack/bake/tile_size_choice.h"

#include "tilepack/exemplar/object_scale.h"
#include "tilepack/tileset/limits.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tilepack {
namespace {

constexpr double usual_tiles = 16;

// Strips reach five scales to either side of an edge (synth/framed_set_settings.h). Reaching less than a quarter of
// the tile, 16 tiles of a sixteenth of the sample show .82 to .87 of it up to 1024 x 1024 texels (gravel, grass,
// asphalt), and .78 to .83 of larger ones; reaching further .73 (a stone wall). Tiles a quarter wider show .80 to
// .96.
constexpr double reach_of_scale = 5.0;
constexpr double usual_reach = 0.25;
constexpr double large_side = 320;
constexpr double wider = 1.25;
constexpr double least_scales = 6;   // of a tile's side
constexpr double most_texels = 2.44; // of 16 tiles, in those of the sample: 1.25⁴, wider and rounded up
constexpr double most_texels_in_all = 8;

// The smallest of 4, 5, 6 and 7 times a power of two that is not more than 3 % smaller.
int rounded_up(double side) {
  for (int unit = 1;; unit *= 2)
    for (int m = 4; m < 8; ++m)
      if (m * unit >= 0.97 * side) return m * unit;
}

int rounded_down(double side) {
  int best = limits::smallest_tile_side_made;
  for (int unit = 1; 4 * unit <= side; unit *= 2)
    for (int m = 4; m < 8 && m * unit <= side; ++m) best = m * unit;
  return best;
}

int side_in_step(const Period& period, int side, int sample, int otherwise) {
  if (period.length <= 0 || whole_periods(period, side) > 0) return side;
  int grain = 16;
  while (8 * grain <= side) grain *= 2;
  for (; grain >= 16; grain /= 2) {
    int best = 0;
    for (int other = grain; other <= std::min(side + side / 3, sample / 2); other += grain)
      if (4 * other >= 3 * side && whole_periods(period, other) > 0 &&
          (best == 0 || std::abs(other - side) < std::abs(best - side)))
        best = other;
    if (best > 0) return best;
  }
  return otherwise;
}

} // namespace

int tile_side_for(Size sample, double object_scale, int tiles) {
  const double area = static_cast<double>(sample.width) * sample.height;
  const double plain = std::sqrt(area / usual_tiles);
  double side = plain;
  if (plain > large_side || reach_of_scale * object_scale > usual_reach * plain) side *= wider;
  side = std::max(side, std::min(least_scales * object_scale, plain * std::sqrt(most_texels) / wider));
  const int shorter = std::min(sample.width, sample.height);
  int chosen = rounded_up(side);
  if (static_cast<double>(tiles) * chosen * chosen > most_texels_in_all * area)
    chosen = rounded_down(std::sqrt(most_texels_in_all * area / tiles));
  if (2 * chosen > shorter) chosen = rounded_down(shorter / 2.0);
  return std::clamp(chosen, limits::smallest_tile_side_made, limits::largest_tile_side);
}

int largest_tile_side_for(Size sample, int tiles) {
  return tile_side_for(sample, largest_object_scale(sample), tiles);
}

Size tile_size_in_step(const Periodicity& periods, int side, Size sample) {
  const Size fitting = fitting_tile_size(periods, {side, side}, sample).size;
  return {
      std::max(limits::smallest_tile_side_made, side_in_step(periods.x, side, sample.width, fitting.width)),
      std::max(limits::smallest_tile_side_made,
               side_in_step(periods.y, side, sample.height, fitting.height))};
}

} // namespace tilepack
