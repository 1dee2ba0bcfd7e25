#pragma once

#include "tilepack/bake/material_values.h"
#include "tilepack/bake/packing.h"
#include "tilepack/numeric/enum_names.h"
#include "tilepack/synth/synth_options.h"

namespace tilepack {

/// Which tiles of the colors asked for are made.
enum class SetKind {
  complete,   ///< every combination: (Kh · Kv)² edge-colored tiles, or K⁴ corner-colored ones
  sequential, ///< 2 · Kh · Kv edge-colored tiles for an index map filled row by row
              ///< (tileset/sequential_set.h)
};

template <>
inline constexpr auto enum_names<SetKind> =
    std::array{EnumName{SetKind::complete, "complete"}, EnumName{SetKind::sequential, "sequential"}};

/// Whether the sample goes on at its opposite borders (exemplar/sample_wrap.h).
enum class WrapChoice {
  found, ///< along each axis where it looks so
  yes,   ///< along both
  no,
};

template <>
inline constexpr auto enum_names<WrapChoice> = std::array{
    EnumName{WrapChoice::yes, "yes"}, EnumName{WrapChoice::no, "no"}, EnumName{WrapChoice::found, "auto"}};

/// Everything that decides a pack besides its sample. Field by field the options of `tilepack bake` and the
/// keys of a preset: see bake/bake_fields.h, which holds their names, ranges and help.
/// The defaults are those of `tilepack bake`, 2 corner colors in a de Bruijn layout, but for the size of tiles,
/// which there follows the sample, and flattening (bake_options of no setting sets fit_tile_size and fit_flatten). Edge colors take three
/// fields together, synth.coloring, synth.colors and layout (tile_index for a complete set).
struct BakeOptions : PackingOptions {
  BakeOptions() {
    layout = LayoutKind::de_bruijn;
    synth.coloring = Coloring::corner;
    synth.colors = {0, 0, 2};
  }

  MaterialOptions material; ///< for prepare_maps(), before bake()
  SynthOptions synth;
  bool fit_tile_size =
      false; ///< tile sides follow the sample (bake/tile_size_choice.h) in place of synth.tile_size
  bool straighten = true; ///< courses that repeat unevenly are made even (exemplar/straighten.h)
  SetKind set = SetKind::complete;
  WrapChoice wraps = WrapChoice::found;
  int flatten = 0;          ///< percent of slow shading taken out of the sample, 0..100 (exemplar/flatten.h)
  bool fit_flatten = false; ///< it follows the sample (exemplar/tone_choice.h) in place of `flatten`
};

} // namespace tilepack
