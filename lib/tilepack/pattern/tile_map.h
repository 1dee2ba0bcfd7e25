#pragma once

#include "tilepack/sampler/address.h"

#include <cmath>
#include <cstdint>

namespace tilepack {

/// The blocks of [LN03, section 3] stand in this room, each a small value with a function that evaluates it; what
/// plugs them together is pattern_graph.h, what evaluates that, pattern_texture.h. PATTERNS.md tells of all.
///
/// Places. A scene is scene.width x scene.height *units* large (1..2^31 a side) and wraps. Whatever varies over it
/// does so on a grid of its own, of so many *cells* over the whole scene: as many as units, a multiple of that, or a
/// number that divides it. So a cell is found in integers however large the scene is: [LN03]'s virtual tile map,
///   g = floor(u N),  u_tile = frac(u N).
struct PatternGrid {
  std::int64_t width = 1; ///< cells over the whole scene, 1..2^31
  std::int64_t height = 1;
  bool operator==(const PatternGrid&) const = default;
};

/// A cell of a grid: 0 <= x < width, 0 <= y < height.
struct PatternCell {
  std::int64_t x = 0;
  std::int64_t y = 0;
  bool operator==(const PatternCell&) const = default;
};

/// A place of the scene, in units.
struct PatternPlace {
  TileCoordinate u, v;
};

/// Whether a grid of `cells` fits a scene of `units` along an axis: one divides the other.
constexpr bool fits_scene(std::int64_t cells, std::int64_t units) {
  return cells > 0 && units > 0 && (cells % units == 0 || units % cells == 0);
}

/// One axis of a grid against that of the scene: the virtual tile map along it. `cells` and `units` fit.
struct GridAxis {
  std::int64_t cells = 1;
  std::int64_t units = 1;
  int coarser_bits = -1; ///< log2 of units / cells, where that is a whole number: it saves divisions

  GridAxis() = default;
  GridAxis(std::int64_t of_cells, std::int64_t of_units) : cells(of_cells), units(of_units) {
    const std::int64_t ratio_down = of_units % of_cells == 0 ? of_units / of_cells : 0;
    if (ratio_down > 0 && (ratio_down & (ratio_down - 1)) == 0)
      for (coarser_bits = 0; ratio_down >> coarser_bits > 1;) ++coarser_bits;
  }

  /// Cells a unit.
  double ratio() const { return static_cast<double>(cells) / static_cast<double>(units); }

  /// The cell that holds a place, 0..cells-1, and the fraction of it before the place, 0 <= fraction < 1.
  TileCoordinate cell_of(TileCoordinate place) const {
    const bool inside = place.tile >= 0 && place.tile < units && place.fraction >= 0 && place.fraction < 1;
    const TileCoordinate at = inside ? place : within(place, units, WrapMode::wrap);
    if (cells == units) return at;
    if (cells > units) {
      const std::int64_t finer = cells / units;
      const double part = at.fraction * static_cast<double>(finer);
      const double whole = std::floor(part);
      if (whole >= static_cast<double>(finer)) return {(at.tile + 1) % units * finer, 0};
      return {at.tile * finer + static_cast<std::int64_t>(whole), part - whole};
    }
    if (coarser_bits > 0) {
      const std::int64_t rest = at.tile & ((std::int64_t{1} << coarser_bits) - 1);
      const double fraction =
          (static_cast<double>(rest) + at.fraction) / static_cast<double>(std::int64_t{1} << coarser_bits);
      return {at.tile >> coarser_bits, fraction < 1 ? fraction : std::nextafter(1.0, 0.0)};
    }
    const std::int64_t coarser = units / cells;
    const std::int64_t rest = at.tile % coarser;
    const double fraction = (static_cast<double>(rest) + at.fraction) / static_cast<double>(coarser);
    return {at.tile / coarser, fraction < 1 ? fraction : std::nextafter(1.0, 0.0)};
  }

  /// The place `fraction` of a cell into cell `cell`, any integer.
  TileCoordinate place_in(std::int64_t cell, double fraction) const {
    if (cells == units) return {cell, fraction};
    if (cells > units) {
      const std::int64_t finer = cells / units;
      const std::int64_t rest = ((cell % finer) + finer) % finer;
      return {(cell - rest) / finer, (static_cast<double>(rest) + fraction) / static_cast<double>(finer)};
    }
    const std::int64_t coarser = units / cells;
    const double inside = fraction * static_cast<double>(coarser);
    const double whole = std::floor(inside);
    return {cell * coarser + static_cast<std::int64_t>(whole), inside - whole};
  }
};

/// Both axes of a grid in a scene.
struct TileMapping {
  GridAxis x, y;

  TileMapping() = default;
  TileMapping(PatternGrid grid, PatternGrid scene)
      : x{grid.width, scene.width}, y{grid.height, scene.height} {}

  PatternCell cell_of(const PatternPlace& place) const {
    return {x.cell_of(place.u).tile, y.cell_of(place.v).tile};
  }
  /// The centre of a cell, any integers.
  PatternPlace centre_of(std::int64_t cell_x, std::int64_t cell_y) const {
    return {x.place_in(cell_x, 0.5), y.place_in(cell_y, 0.5)};
  }
};

} // namespace tilepack
