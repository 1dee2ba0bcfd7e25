#pragma once

#include "tilepack/report/view_page.h"
#include "tilepack/scene/scene_file.h"
#include "tilepack/scene/scene_files.h"

#include <string>

namespace tilepack {

/// A page that stands alone and shows a scene by WebGL 2: its blocks are evaluated where they are looked at
/// (graph_program()), so it goes on as far as the scene does, and its animations play. Pixels that cover several
/// cells are the mean of up to 16 places; farther off they fade into an overview of the whole scene, which is drawn
/// beforehand, at the time `time`.
struct SceneViewPage {
  std::string text;
  double cells_a_texel =
      1; ///< of the overview, in cells of the finest grid: above 4 the picture is blurred in between
};

/// `settings.metres` is the width of 256 texels, a tile of camera views; `settings.content` is found here. Throws what
/// scene_graph() and graph_program() do, and Error (invalid_content) for more textures than a fragment program reads and
/// more texels than a page holds.
SceneViewPage scene_view_page(const SceneFile& scene, SceneFiles& files, ViewPageSettings settings,
                              double time);

} // namespace tilepack
