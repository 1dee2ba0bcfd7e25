#pragma once

#include "tilepack/pattern/pattern_texture.h"
#include "tilepack/sampler/render_target.h"
#include "tilepack/sampler/virtual_texture.h"
#include "tilepack/scene/scene_graph.h"

#include <array>
#include <cstdint>

namespace tilepack {

/// A window of a scene: `rect` in texels of level `level`, which are 2^level of the scene's; pixel i of the picture
/// shows rect.x + (i + 0.5) / scale.
struct SceneView {
  VirtualRect rect;
  int level = 0;
  double scale = 1; ///< above 0
};

/// Draws a window in bands of rows, any rows in any order: the pixels are the same for any banding and any number of
/// threads.
class SceneWindow {
public:
  /// `texture` must outlive this; `graph` is the one it is of, `size` the texels of the whole scene. Throws Error (usage)
  /// as output_size() of windows of packs does.
  SceneWindow(const PatternTexture& texture, const PatternGraph& graph, std::array<std::int64_t, 2> size,
              const SceneView& view, const RenderTarget& target);

  Size size() const { return picture; }
  int channels() const { return texture->channels(); }

  /// Rows first..first+count-1, encoded and rounded as the target says.
  Image rows(int first, int count) const;

private:
  const PatternTexture* texture;
  SceneView view;
  RenderTarget target;
  Size picture;
  Footprint footprint;
  PatternPlace corner; ///< of the window, in units
  Size unit;
};

/// The map that a picture of it is stored as: its name, role, encoding and depth.
MapFormat picture_format(const SceneMap& map);

} // namespace tilepack
