#pragma once

#include "tilepack/scanline/view_shading.h"

#include <vector>

namespace tilepack {

struct ViewOptions {
  ViewStepping stepping;
  std::vector<float> background; ///< values as stored, one a channel; empty: 0
  /// Where nothing is, a clear sky in place of the background: pale at the horizon and below, bluer the higher
  /// a pixel looks (+y is up). For textures of color; of 1 or 2 channels it is grey, with alpha opaque.
  bool sky = false;
};

/// A perspective view of a scene, all of whose surfaces show one texture, in bands of rows, any rows in any order: the pixels
/// are the same for any banding and any number of threads.
///
/// A pixel shows the surface at its centre: silhouettes are not smoothed. Nothing in front of the camera,
/// planes edge-on and triangles without area simply do not show; no pixel is NaN (where the texture's values
/// are finite).
class ViewRenderer {
public:
  /// `texture` must outlive this. Throws Error (usage): a background of another number of channels or not
  /// finite, a reseed out of its range; and what Projection throws.
  ViewRenderer(const Texture& texture, const Scene& scene, const Camera& camera, Size picture,
               const ViewOptions& options, const RenderTarget& target);

  Size size() const { return scene.size(); }
  int channels() const { return texture->channels(); }

  /// Rows first..first+count-1, encoded and rounded as the target says.
  Image rows(int first, int count) const;

private:
  void paint_sky(Image& shaded, const ViewPixels& pixels, int top) const;

  ViewOptions options;
  Projection projection;
  ProjectedScene scene;
  const Texture* texture;
  RenderTarget target;
};

} // namespace tilepack
