#pragma once

#include "tilepack/scanline/view_shading.h"

namespace tilepack {

struct ViewOptions {
  ViewStepping stepping;
  ViewFilter filter = ViewFilter::trilinear;
  WrapMode border = WrapMode::wrap; ///< of the virtual texture
  std::vector<float> background;    ///< values as stored, one a channel; empty: 0
};

/// A perspective view of a scene textured from a pack, in bands of rows, any rows in any order: the pixels
/// are the same for any banding and any number of threads.
///
/// A pixel shows the surface at its centre: silhouettes are not smoothed. Nothing in front of the camera,
/// planes edge-on and triangles without area simply do not show; no pixel is NaN (where the pack's own texels
/// are finite).
class ViewRenderer {
public:
  /// `pack` must outlive this. Throws Error (usage): a map the pack doesn't hold, a background of another
  /// number of channels or not finite, a reseed out of its range; and what Projection throws.
  ViewRenderer(const Pack& pack, int map, const Scene& scene, const Camera& camera, Size picture,
               const ViewOptions& options, const RenderTarget& target);

  Size size() const { return scene.size(); }
  int channels() const { return texture.channels(); }

  /// Rows first..first+count-1, encoded and rounded as the target says.
  Image rows(int first, int count) const;

private:
  ViewOptions options;
  ProjectedScene scene;
  ViewTexture texture;
};

} // namespace tilepack
