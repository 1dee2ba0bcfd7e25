#include "jobs.h"
#include "render_camera.h"
#include "render_window.h"
#include "value_check.h"
#include "verb.h"

#include "tilepack/bake/depfile.h"
#include "tilepack/bake/output_check.h"
#include "tilepack/bake/text_file.h"
#include "tilepack/image/image_file.h"
#include "tilepack/pack/pack_maps.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/staged_outputs.h"
#include "tilepack/sampler/pack_texture.h"
#include "tilepack/sampler/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tilepack::cli {
namespace {

constexpr int default_tiles = 8;                     // a side of the window, unless the texture is smaller
constexpr std::size_t band_values = 8 * 1024 * 1024; // floats rendered between two writes

struct RenderArguments {
  std::string pack;
  std::string output;
  std::string map;
  std::optional<std::string> rect;
  std::string filter; ///< empty: trilinear for windows, anisotropic for camera views
  std::string border = "wrap";
  std::string encoding;
  std::string depfile;
  int level = 0;
  double scale = 1;
  double corner_width = default_corner_width;
  int jobs = 0;
  CameraArguments view;
};

constexpr const char* elliptical = "elliptical"; // no Filter: it takes a footprint in place of a level

Filter filter_of(const std::string& name) {
  if (name.empty() || name == elliptical) return Filter::trilinear;
  if (const auto filter = enum_named<Filter>(name)) return *filter;
  std::vector<std::string> known = names_of<Filter>();
  known.emplace_back(elliptical);
  refuse_name(name, "--filter", "filter", known);
}

VirtualRect default_rect(const Pack& pack, int level) {
  const auto side = [level](std::int64_t tiles, int texels) {
    const auto finest = static_cast<double>(std::min<std::int64_t>(tiles, default_tiles) * texels);
    return static_cast<int>(
        std::ceil(std::ldexp(finest, -level))); // at far levels tiles need not have whole texels
  };
  return {0, 0, side(pack.mapping.size.width, pack.tile_size.width),
          side(pack.mapping.size.height, pack.tile_size.height)};
}

std::vector<std::string> files_read_by(const RenderArguments& arguments) {
  std::vector<std::string> files = files_of_pack(arguments.pack);
  if (!arguments.view.mesh.empty()) files.push_back(arguments.view.mesh);
  return files;
}

int run_render(const RenderArguments& arguments, Console& console) {
  const JobLimit limit(arguments.jobs);
  const WrapMode border = enum_called<WrapMode>(arguments.border, "--border", "border");
  check_outputs(std::vector<OutputFile>{{"--output", arguments.output}, {"--depfile", arguments.depfile}},
                files_read_by(arguments));
  check_text_name({"--depfile", arguments.depfile});
  if (!arguments.depfile.empty()) check_writable(arguments.depfile);
  if (arguments.view.camera) {
    const Pack pack = read_pack(arguments.pack);
    const int map = map_called(pack, arguments.map);
    const PackedMap& shown = pack.maps[static_cast<std::size_t>(map)];
    const RenderTarget target = target_for(arguments.output, shown, arguments.encoding);
    const ViewFilter filter =
        arguments.filter.empty() ? ViewFilter::anisotropic : view_filter_of(arguments.filter);
    const PackTexture texture(pack, map, filter, border);
    return render_camera(arguments.view, texture, shown.role == Role::color, target, arguments.output,
                         console);
  }
  const Filter filter = filter_of(arguments.filter);
  std::optional<VirtualRect> rect;
  if (arguments.rect) rect = parsed_rect(*arguments.rect);

  const Pack pack = read_pack(arguments.pack);
  const int map = map_called(pack, arguments.map);
  const auto& packed = pack.maps[static_cast<std::size_t>(map)];
  const int levels = static_cast<int>(packed.levels.size() + packed.far_levels.size());
  if (arguments.level < 0 || arguments.level >= levels)
    throw Error(ErrorKind::usage, "--level",
                fmt::format("{}; the pack has levels 0 to {}", arguments.level, levels - 1));
  const RenderTarget target = target_for(arguments.output, packed, arguments.encoding);

  View view{rect ? *rect : default_rect(pack, arguments.level), arguments.level, arguments.scale, filter};
  view.border = border;
  view.corner_width = arguments.corner_width;
  view.elliptical = arguments.filter == elliptical;
  const Renderer renderer(pack, map, view, target);
  const Size size = renderer.size();
  const std::size_t row_values =
      static_cast<std::size_t>(size.width) * static_cast<std::size_t>(packed.channels);
  const int band = static_cast<int>(std::max<std::size_t>(1, band_values / row_values));

  const Progress progress = console.progress();
  StagedOutputs outputs;
  ImageWriter writer(outputs.add_file(arguments.output), size, packed.channels,
                     usual_format(target.depth, target.encoding));
  for (int row = 0; row < size.height; row += band) {
    report(progress, "render", static_cast<double>(row) / size.height);
    writer.write(renderer.rows(row, std::min(band, size.height - row)));
  }
  writer.finish();
  outputs.commit(progress);
  console.made(
      fmt::format("{}: {} x {} pixels of the {} map", arguments.output, size.width, size.height, packed.name),
      arguments.output);
  return 0;
}

Action declare_render(Options& options) {
  auto a = std::make_shared<RenderArguments>();
  options.option("PACK", a->pack, "folder of a pack, or its pack.json").required();
  options
      .option("-o,--output", a->output,
              "picture to write, .png or .exr; its folder is made if it is not there, and the depth of the "
              "map is kept "
              "if the format has it")
      .required()
      .value("FILE");
  options.option("--map", a->map, "name of the map (default: the first)").value("NAME");
  options
      .option(
          "--rect", a->rect,
          "window in texels of the level, anywhere, also beyond the border (default: the first 8 x 8 tiles)")
      .value("X,Y,W,H");
  options
      .option("--level", a->level,
              "mip level, 0 the finest (default 0); of a pack baked with --full-mips also those past the "
              "levels of tiles, "
              "down to the mean")
      .check(whole_number(0, 30))
      .value("L");
  options
      .option(
          "--filter", a->filter,
          "how texels are filtered: nearest, bilinear, trilinear (default), which reads the level that fits "
          "the "
          "scale, or elliptical, the mean over what a pixel covers; for camera views trilinear, anisotropic "
          "(default) or elliptical")
      .value("NAME");
  options
      .option("--border", a->border,
              "what lies beyond the virtual texture: wrap (default), clamp, which repeats its outermost "
              "texels, or mirror")
      .value("NAME");
  options
      .option("--scale", a->scale,
              "pixels a texel (default 1): pixel i samples X + (i + 0.5) / S; at 1, the texels themselves")
      .check(positive_number(max_render_side, " (1: a pixel a texel)"))
      .value("S");
  options
      .option(
          "--corner-width", a->corner_width,
          "how far round tile corners a corner pack is blended in, in texels of the level, 0 (not at all) "
          "to 4096, cut to what the pack allows (default 4)")
      .check(number(0, 4096))
      .value("W");
  options
      .option(
          "--encoding", a->encoding,
          "encoding of the picture: srgb or linear (default: that of the map; in EXR linear, in PNG of float "
          "color srgb)")
      .value("NAME");
  options.option("--depfile", a->depfile, "write a rule for make or ninja: what the picture depends on")
      .value("FILE");
  add_jobs_option(options, a->jobs);
  add_camera_options(options, a->view);
  return [a, &options](Console& console) {
    (a->view.camera ? refuse_window_options : refuse_camera_options)(options);
    const int code = run_render(*a, console);
    if (code == 0 && !a->depfile.empty())
      write_text_file(a->depfile, depfile_text(a->output, files_read_by(*a)));
    return code;
  };
}

} // namespace

Verb render_verb() {
  return {"render", "render a window of the virtual texture, or a view of it in perspective",
          "  tilepack render gravel.pack -o gravel.png\n"
          "  tilepack render gravel.pack -o far.png --rect=-512,0,4096,4096 --scale 0.25\n"
          "  tilepack render gravel.pack -o view.png --camera 0,2,0,0,0,-6,0,1,0,60 --size 1920x1080\n",
          declare_render};
}

} // namespace tilepack::cli
