#include "console.h"
#include "value_check.h"
#include "verb.h"

#include "tilepack/bake/output_check.h"
#include "tilepack/bake/text_file.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/report/scene_view_page.h"
#include "tilepack/report/view_page.h"
#include "tilepack/shader/shader_text.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tilepack::cli {
namespace {

struct ViewArguments {
  std::string pack;
  std::string output;
  std::optional<double> metres;
  std::optional<double> time;
};

void say_made(const ViewArguments& a, const std::string& page, Console& console) {
  const auto bytes = static_cast<double>(page.size());
  const std::string size =
      bytes < 1e6 ? fmt::format("{:.0f} kB", bytes / 1e3) : fmt::format("{:.1f} MB", bytes / 1e6);
  console.made(fmt::format("{}: a page of {}, {}, to be opened in a browser", a.output, a.pack, size),
               a.output);
}

// The page of a scene; what it leaves out of the picture is said.
int view_scene(const ViewArguments& a, Console& console) {
  const SceneFile scene = read_scene(a.pack);
  SceneFiles files(scene);
  ViewPageSettings settings;
  settings.title = std::filesystem::path(a.pack).filename().string();
  settings.made_by = fmt::format("tilepack view {}", settings.title);
  if (a.metres) settings.made_by += fmt::format(" --metres {}", *a.metres);
  if (a.time) settings.made_by += fmt::format(" --time {}", *a.time);
  settings.metres = a.metres;
  const SceneViewPage page = scene_view_page(scene, files, settings, a.time.value_or(0));
  check_outputs(std::vector<OutputFile>{{"--output", a.output}}, files.inputs());
  write_text_file(a.output, page.text);
  say_made(a, page.text, console);
  constexpr double sharp = 4; // cells a texel: up to there the overview takes over without a blur
  if (page.cells_a_texel > sharp)
    console.note(fmt::format(
        "from afar the page shows an overview with a texel every {:.0f} cells; pixels of 2 to {:.0f} "
        "cells are blurred, which `compose` draws sharp",
        page.cells_a_texel, page.cells_a_texel));
  return 0;
}

int run_view(const ViewArguments& a, Console& console) {
  check_page_name({"--output", a.output});
  if (is_scene_file(a.pack)) return view_scene(a, console);
  check_outputs(std::vector<OutputFile>{{"--output", a.output}}, files_of_pack(a.pack));
  if (a.time)
    throw Error(
        ErrorKind::usage, "--time",
        fmt::format("goes with scenes, whose animations it is the time of; {} is a pack; leave it out",
                    a.pack));
  const Pack pack = read_pack(a.pack);
  // So that the page does not depend on where the pack lies.
  const std::string folder = pack_name(a.pack);
  ViewPageSettings settings;
  settings.title = folder;
  settings.made_by = fmt::format("tilepack view {}", folder);
  if (a.metres) settings.made_by += fmt::format(" --metres {}", *a.metres);
  settings.content = pack_content_hash(a.pack);
  settings.metres = a.metres;
  const std::string page = view_page(pack, settings);
  write_text_file(a.output, page);
  say_made(a, page, console);
  return 0;
}

Action declare_view(Options& options) {
  auto a = std::make_shared<ViewArguments>();
  options.option("PACK", a->pack, "folder of a pack, its pack.json, or a scene").required();
  options.option("-o,--output", a->output, "page to write; it stands alone and needs a browser with WebGL 2")
      .required()
      .value("FILE.html");
  options
      .option("--metres", a->metres,
              "width of a tile in metres, for a scale; of a scene that of 256 texels, as in camera views")
      .check(positive_number(1e6, " metres a tile"))
      .value("M");
  options
      .option("--time", a->time,
              "of a scene: time at which the page opens, in steps of animations; what is seen from afar "
              "stays at it "
              "(default 0)")
      .check(number(-1e6, 1e6))
      .value("T");
  return [a](Console& console) { return run_view(*a, console); };
}

} // namespace

Verb view_verb() {
  return {"view", "write a page to pan, zoom and fly over the endless texture of a pack or scene",
          "  tilepack view gravel.pack -o gravel.html\n"
          "  tilepack view rock.pack -o rock.html --metres 2.5\n"
          "  tilepack view landscape.json -o landscape.html\n",
          declare_view};
}

} // namespace tilepack::cli
