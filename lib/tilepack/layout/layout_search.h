#pragma once

#include "tilepack/layout/arrangement.h"
#include "tilepack/layout/layout.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace tilepack {

/// The gutter of a rotated layout whose colors can't be made to match: a bilinear filter reads up to √2
/// texels beyond a turned border.
inline constexpr int default_gutter = 2;

/// What a rotated layout is wanted for.
struct LayoutRequest {
  int tiles = 0;
  int tile_side = 128;                 ///< texels
  std::optional<RotatedScheme> scheme; ///< only this one
  std::optional<int> gutter;           ///< unset: 0 where colors match, else default_gutter
  bool power_of_two = false;           ///< both sides of the texture
};

/// One way to lay the tiles out.
struct LayoutCandidate {
  RotatedScheme scheme;
  int gutter = 0;
  Size size;                          ///< of the texture, texels
  std::int64_t wasted = 0;            ///< texels of the texture beyond tiles * tile_side²
  bool copied = false;                ///< not turned and not scaled: texels are stored as they are
  Matching matching = Matching::none; ///< of the tiles' colors with their neighbours'
  std::vector<int> arrangement;       ///< site → tile
};

/// All plans, best first: fewest wasted texels; then least resampling loss, which is none where tiles are
/// copied and else falls with the size at which they are stored; then the order of rotated_schemes. `colors`
/// may be null: then nothing is known to match.
///
/// Throws Error (usage): a tile count that no scheme reaches (naming the next ones below and above), a scheme
/// of another count, and the errors of rotated_texture_size.
std::vector<LayoutCandidate> layout_plans(const LayoutRequest& request, const TileColors* colors = nullptr);

/// The rotated layout of a plan.
Layout planned_layout(const LayoutCandidate& plan, int tile_side);

/// The texels of the smallest grid whose sides are powers of two that holds `tiles` tiles of tile_side
/// texels, what one would store without turning: sides may differ by a factor of two.
std::int64_t padded_texels(int tiles, int tile_side);

} // namespace tilepack
