#pragma once

#include "tilepack/numeric/rect.h"
#include "tilepack/tileset/limits.h"
#include "tilepack/tileset/tile_colors.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace tilepack {

/// How much each place of a tile belongs to each of the materials at its corners: the bilinear weights of the corners
/// plus noise, so that no border runs straight. Borders of a tile depend on the two corners of that border alone, where
/// noise is the same in all tiles which have them.
///
/// Weights are about 0..1, the highest is the material that belongs there. Values are the same on every machine.
class TransitionField {
public:
  /// `roughness` 0..1: how far noise moves borders; `seed` draws it. `wave`: texels, the longer of the two lengths
  /// of its waves.
  /// Each material has so many corner colors, those of material 0 first.
  TransitionField(Size tile, int colors_of_material, double roughness, double wave, std::uint64_t seed);

  /// At the centre of texel (x, y) of a tile; `variant` tells tiles of equal corners apart, `take` several tries at one.
  double weight(const CornerTile& corners, int variant, int take, int material, int x, int y) const;

  /// Beside an edge from `first` (west or north) to `second`: at `along` and `across` texels from its first end, across
  /// counted from the edge to the south or east.
  double edge_weight(bool horizontal, int first, int second, int material, int along, int across) const;

  /// Moves where a border crosses edges from `first` to `second`, by a share of their length; 0 at first.
  void set_shift(bool horizontal, int first, int second, double shift) {
    shifts[shift_index(horizontal, first, second)] = shift;
  }

private:
  static std::size_t shift_index(bool horizontal, int first, int second) {
    return static_cast<std::size_t>(
        ((horizontal ? 1 : 0) * limits::most_corner_colors + first) * limits::most_corner_colors + second);
  }
  double noise(std::uint64_t of, double x, double y) const;
  double edge_noise(bool horizontal, int first, int second, int material, double along, double across) const;

  int material_of(int color) const { return color / colors_of_material; }

  Size tile;
  int colors_of_material;
  double roughness;
  double wave;
  std::uint64_t seed;
  std::array<double, std::size_t{2} * limits::most_corner_colors * limits::most_corner_colors> shifts{};
};

} // namespace tilepack
