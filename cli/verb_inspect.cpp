#include "value_check.h"
#include "verb.h"

#include "tilepack/bake/output_check.h"
#include "tilepack/error/nearest_name.h"
#include "tilepack/image/image_file.h"
#include "tilepack/image/image_format.h"
#include "tilepack/mapping/index_json.h"
#include "tilepack/pack/pack_folder.h"
#include "tilepack/pack/pack_maps.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/staged_outputs.h"
#include "tilepack/report/mapping_picture.h"
#include "tilepack/report/pack_picture.h"
#include "tilepack/report/pack_summary.h"
#include "tilepack/report/scene_picture.h"
#include "tilepack/scene/scene_graph.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tilepack::cli {
namespace {

namespace fs = std::filesystem;

struct InspectArguments {
  std::string pack;
  std::string format = "text";
  std::string picture;
  std::string corner_picture;
  std::string index_map;
  std::string preview;
  std::string map;
  std::optional<int> level;
  int tiles = 8;
  int worst = 3;
  bool bare = false;
  bool mapping = false;
};

void check_outputs_of(const InspectArguments& a) {
  check_outputs(std::vector<OutputFile>{{"--picture", a.picture},
                                        {"--index-map", a.index_map},
                                        {"--corner-picture", a.corner_picture},
                                        {"--preview", a.preview}},
                files_of_pack(a.pack));
  check_text_name({"--index-map", a.index_map});
}

void add_drawing(StagedOutputs& outputs, const OutputFile& output, const VectorDrawing& drawing) {
  const std::string& file = output.file;
  const std::string extension = file_ending(file);
  if (extension == ".svg")
    outputs.add_text(file, svg(drawing));
  else if (extension == ".png")
    write_image(outputs.add_file(file), rasterised(drawing), usual_format(Depth::u8, Encoding::srgb));
  else
    throw Error(ErrorKind::usage, output.where, without_ending(file, ".png or .svg"));
}

int run_inspect_mapping(const InspectArguments& arguments, Console& console) {
  check_outputs_of(arguments);
  const Pack pack = read_pack(arguments.pack);
  const auto survey = mapping_survey(pack.mapping, pack.colors, pack.generator.seed);
  StagedOutputs outputs;
  if (!arguments.picture.empty())
    add_drawing(outputs, {"--picture", arguments.picture}, mapping_survey_picture(survey, pack.colors));
  outputs.commit(console.progress());
  console.print(arguments.format == "json" ? survey_json(survey) : survey_text(survey));
  return 0;
}

int run_inspect_scene(const InspectArguments& arguments, Console& console) {
  const SceneFile scene = read_scene(arguments.pack);
  SceneFiles files(scene);
  scene_graph(scene, files); // whatever is wrong is said first
  check_outputs(std::vector<OutputFile>{{"--picture", arguments.picture}}, files.inputs());
  StagedOutputs outputs;
  if (!arguments.picture.empty())
    add_drawing(outputs, {"--picture", arguments.picture}, scene_picture(scene, files));
  outputs.commit(console.progress());
  console.print(arguments.format == "json" ? scene_summary_json(scene) : scene_summary_text(scene));
  return 0;
}

int run_inspect(const InspectArguments& arguments, Console& console) {
  check_outputs_of(arguments);
  auto [summary, pack] = reading_pack(arguments.pack, [&](const PackFolder& folder) {
    PackSummary read{arguments.pack, folder.description(), {}, {}};
    std::vector<std::string> files = read.description.all_files();
    files.push_back(folder.json_path().filename().string());
    read.file_bytes = folder.bytes_of(files);
    return std::pair(std::move(read), read_pack(folder));
  });
  PackPictureOptions options;
  options.map = map_called(pack, arguments.map);
  if (arguments.level && *arguments.level >= pack.tile_levels)
    throw Error(ErrorKind::usage, "--level",
                fmt::format("{}; the pack has levels 0 to {}", *arguments.level, pack.tile_levels - 1));
  options.level = arguments.level;
  options.marks = !arguments.bare;
  StagedOutputs outputs;
  const Progress progress = console.progress();
  report(progress, "drawing", 0.0);
  if (!arguments.picture.empty())
    add_drawing(outputs, {"--picture", arguments.picture}, pack_picture(pack, options));
  if (!arguments.index_map.empty()) outputs.add_text(arguments.index_map, index_map_json(pack.mapping));
  if (!arguments.corner_picture.empty())
    add_drawing(outputs, {"--corner-picture", arguments.corner_picture}, corner_picture(pack, options));
  report(progress, "drawing", 0.5);
  if (!arguments.preview.empty())
    add_drawing(outputs, {"--preview", arguments.preview},
                expansion_picture(pack, arguments.tiles, arguments.tiles, options));
  report(progress, "measuring", 0.8);
  summary.seams = seam_figures(pack, options.map, 0, arguments.worst);
  outputs.commit(progress);
  console.print(arguments.format == "json" ? summary_json(summary) : summary_text(summary));
  return 0;
}

Action declare_inspect(Options& options) {
  auto arguments = std::make_shared<InspectArguments>();
  options.option("PACK", arguments->pack, "folder or pack.json of a pack, or a scene").required();
  options.option("--format", arguments->format, "of the summary on stdout (default text)")
      .one_of("text|json");
  options
      .option("--picture", arguments->picture,
              "draw the packed texture with its colors and tile ids; of a scene, its graph and each map")
      .value("FILE.png|.svg");
  options.option("--index-map", arguments->index_map, "write the tile ids of an index mapping, row by row")
      .value("FILE.json");
  options.option("--corner-picture", arguments->corner_picture, "draw the corner pack likewise")
      .value("FILE.png|.svg");
  options
      .option("--preview", arguments->preview, "draw a piece of the virtual texture with its colors and ids")
      .value("FILE.png|.svg");
  options.option("--tiles", arguments->tiles, "tiles a side of the preview, 1 to 64 (default 8)")
      .check(whole_number(1, 64))
      .value("N");
  options.option("--map", arguments->map, "name of the map drawn and measured (default: the first)")
      .value("NAME");
  options
      .option("--level", arguments->level,
              "the level drawn, 0 the finest (default: the finest that fits 4096 pixels)")
      .check(whole_number(0, 30))
      .value("L");
  options
      .option("--worst", arguments->worst, "how many of the worst borders are listed, 0 to 1000 (default 3)")
      .check(whole_number(0, 1000))
      .value("N");
  options.flag("--bare", arguments->bare, "draw without colors and ids");
  options.flag("--mapping", arguments->mapping,
               "statistics of the mapping instead, beside tables of 8 to 4096 entries; --picture draws them");
  return [arguments, &options](Console& console) {
    if (is_scene_file(arguments->pack)) {
      for (const char* name : {"--index-map", "--corner-picture", "--preview", "--tiles", "--map", "--level",
                               "--worst", "--bare", "--mapping"})
        if (options.given(name))
          throw Error(ErrorKind::usage, name, "is for packs; leave it out, or name a pack");
      return run_inspect_scene(*arguments, console);
    }
    return arguments->mapping ? run_inspect_mapping(*arguments, console) : run_inspect(*arguments, console);
  };
}

} // namespace

Verb inspect_verb() {
  return {"inspect", "show what a pack or a scene holds, in text, JSON or pictures",
          "  tilepack inspect gravel.pack --picture pack.png --preview texture.png\n"
          "  tilepack inspect gravel.pack --format json\n"
          "  tilepack inspect landscape.json --picture graph.png\n"
          "  tilepack inspect gravel.pack --mapping --picture mapping.png\n",
          declare_inspect};
}

} // namespace tilepack::cli
