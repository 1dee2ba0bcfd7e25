#pragma once

#include "tilepack/sampler/address.h"
#include "tilepack/sampler/corner_blend.h"
#include "tilepack/sampler/filter.h"
#include "tilepack/sampler/footprint.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/render_target.h"
#include "tilepack/sampler/virtual_texture.h"

#include <optional>
#include <vector>

namespace tilepack {

/// What to render: a window of the virtual texture at one level, magnified or shrunk.
struct View {
  VirtualRect
      rect; ///< in texels of `level`, 2^level of level 0 wide, also at far levels, where tiles have no whole ones
  int level = 0;    ///< 0..tile_levels-1, and of a full chain (mip/far_levels.h) on to its last
  double scale = 1; ///< output pixels a texel, > 0: pixel i samples rect.x + (i + 0.5) / scale
  Filter filter = Filter::trilinear;          ///< trilinear reads the level whose texels are a pixel apart
  double corner_width = default_corner_width; ///< see corner_weight; 0 leaves a corner pack aside
  WrapMode border = WrapMode::wrap;           ///< of the virtual texture
  bool elliptical = false; ///< instead of `filter`, the mean over what each pixel covers (footprint.h)
};

/// Each side of the window times the scale, rounded, at least 1. Throws Error (usage) if a side of the window
/// is below 1, the scale isn't a positive number, or a side of the picture would pass max_render_side.
Size output_size(const View& view);
constexpr int max_render_side = 65536;

/// Renders a view in bands of rows, any rows in any order: the pixels are the same for any banding and any
/// number of threads, and those of ReferenceSampler.
///
/// Trilinear and bilinear views read far levels, where there are any; nearest and elliptical ones stay at the last level of
/// tiles. At scale 1 and a level of tiles pixels lie on texels: every filter but the elliptical one gives the texels of the level
/// themselves, and if encoding and depth are those of the map, bit for bit (of a rotated layout, whose texels
/// lie elsewhere, what tiles_at_level reads back). Elsewhere filtered normals are renormalised.
class Renderer {
public:
  /// `pack` must outlive this. Throws Error (usage): a map or level the pack doesn't hold, and the errors of
  /// output_size.
  Renderer(const Pack& pack, int map, const View& view, const RenderTarget& target);

  Size size() const { return picture; }
  int channels() const { return texels.channels(); }

  /// Rows first..first+count-1 of the picture, encoded and rounded as the target says.
  Image rows(int first, int count) const;

private:
  void render_row(int row, std::span<float> out) const;
  bool copies_texels() const;
  int last_of_tiles() const; // the view's level, or the last of tiles before it
  int far_steps() const;     // how far the view's level lies past that

  const Pack* pack;
  const PackedMap* map;
  View view;
  RenderTarget target;
  Size picture;
  FootprintEllipse pixel; ///< what one covers, wherever it lies
  LevelBlend levels;
  PackTexels texels;
  std::optional<CornerTexels> corners;
  VirtualEdge edge;
  std::vector<Image> stored;           ///< at scale 1: the tiles of the level as the target wants them, by id
  std::vector<TileCoordinate> columns; ///< elsewhere: where the pixels of a row lie
};

} // namespace tilepack
