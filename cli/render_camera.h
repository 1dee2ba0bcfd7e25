#pragma once

#include "console.h"
#include "options.h"

#include "tilepack/error/progress.h"
#include "tilepack/image/staged_file.h"
#include "tilepack/sampler/render_target.h"
#include "tilepack/sampler/texture.h"

#include <optional>
#include <string>

namespace tilepack::cli {

/// What `tilepack render --camera` is told beyond the options of every rendering.
struct CameraArguments {
  std::optional<std::string> camera; ///< ten numbers; without it the window of the texture is rendered
  std::string size = "1280x720";
  std::string mesh; ///< OBJ file; empty: the ground plane
  double repeat = 1;
  std::string span = "exact";
  int reseed = 0;
  double span_error = 0;
  std::string precision = "f32";
  std::string background; ///< "sky", numbers, or empty: the sky of color maps, 0 of others
};

void add_camera_options(Options& options, CameraArguments& arguments);

/// Throw Error (usage) when an option was given that goes only with the other kind of rendering.
void refuse_camera_options(const Options& options); ///< for windows: an option that needs --camera
void refuse_window_options(const Options& options); ///< for views: --rect, --level, --scale

/// Renders the view of a texture into a file that others get its name with, and returns its size.
Size draw_camera(const CameraArguments& arguments, const Texture& texture, bool shows_color,
                 const RenderTarget& target, StagedFile& output, const Progress& progress);

/// Renders the view of a texture and writes it. `shows_color`: the map's role is color.
int render_camera(const CameraArguments& arguments, const Texture& texture, bool shows_color,
                  const RenderTarget& target, const std::string& output, Console& console);

} // namespace tilepack::cli
