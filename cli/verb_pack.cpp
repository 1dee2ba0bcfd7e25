#include "bake_field_options.h"
#include "bake_report.h"
#include "jobs.h"
#include "sample_reading.h"
#include "value_check.h"
#include "verb.h"

#include "tilepack/bake/bake_fields.h"
#include "tilepack/bake/depfile.h"
#include "tilepack/bake/hand_drawn_set.h"
#include "tilepack/bake/map_kinds.h"
#include "tilepack/bake/material_read.h"
#include "tilepack/bake/output_check.h"
#include "tilepack/bake/text_file.h"
#include "tilepack/error/error.h"
#include "tilepack/pack/pack_write.h"
#include "tilepack/report/pack_summary.h"
#include "tilepack/tileset/border_agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tilepack::cli {
namespace {

namespace fs = std::filesystem;

struct PackArguments {
  std::vector<std::string> tiles;
  std::string folder;
  std::string colors;
  std::string name; ///< empty: as the role
  std::string role = "color";
  PrintedFormat printed;
  std::string depfile;
  double tolerance = 0;
  ReadingArguments reading;
  int jobs = 0;
  std::map<std::string, std::string> fields;
};

// Unless told otherwise, the layout and mapping that go with the colors.
BakeOptions options_from(const PackArguments& arguments, const TileColors& tiles) {
  std::vector<BakeSetting> settings;
  const bool corner = coloring_of(tiles) == Coloring::corner;
  settings.push_back({"coloring", corner ? "corner" : "edge", "", ErrorKind::internal});
  for (const auto& [field, value] : arguments.fields)
    settings.push_back({field, value, tilepack::field(field), ErrorKind::usage});
  return bake_options(settings);
}

// "normal", "orm", "normal-dx": what the drawings hold, and what their map is called unless told otherwise.
MaterialFile map_of(const PackArguments& arguments) {
  MaterialFile map = meant_map(arguments.role, "role");
  if (!arguments.name.empty()) map.name = arguments.name;
  return map;
}

void check_agreement(const TileSet& set, double tolerance, Console& console) {
  const std::vector<BorderDifference> differences = border_differences(set, tolerance);
  if (differences.empty()) return;
  constexpr std::size_t most_shown = 12;
  for (std::size_t i = 0; i < std::min(most_shown, differences.size()); ++i) {
    const BorderDifference& d = differences[i];
    console.print(
        fmt::format("tile {}, {} border ({}): {} texels differ from tile {}, most at ({}, {}) channel {}: "
                    "by {:.4f}\n",
                    d.tile, d.side, d.color, d.texels, d.reference, d.x, d.y, d.channel, d.difference));
  }
  throw Error(
      ErrorKind::check_failed, "",
      fmt::format("the drawings disagree along {} borders, by up to {:.4f} of full scale; redraw them, or "
                  "allow as much with --tolerance",
                  differences.size(), differences.front().difference));
}

// What the pack will be in its folder.
std::vector<std::string> files_in(const std::string& folder, const PackDescription& made) {
  std::vector<std::string> files = made.all_files();
  files.emplace_back("pack.json");
  for (std::string& file : files) file = (fs::path(folder) / file).string();
  return files;
}

int run_pack(PackArguments& arguments, Console& console) {
  const std::string now = arguments.printed.settle(arguments.fields);
  const JobLimit limit(arguments.jobs);
  check_pack_folder_for(arguments.folder, arguments.tiles);
  if (const std::string note = replacing_note(arguments.folder); !note.empty()) console.note(note);
  std::vector<std::string> inputs = arguments.tiles;
  inputs.push_back(arguments.colors);
  const OutputFile depfile{"--depfile", arguments.depfile};
  check_outputs(std::vector{depfile}, inputs);
  check_text_name(depfile);
  const TileColors tiles =
      parsed_color_list(read_text_file(arguments.colors, "the list of colors"), arguments.colors);
  const BakeOptions options = options_from(arguments, tiles);
  std::vector<HandDrawnTile> drawings;
  const MaterialFile map = map_of(arguments);
  for (const std::string& file : arguments.tiles)
    drawings.push_back({file, read_noted(file, arguments.reading, map.role, console)});
  for (const std::string& note : complete_drawings(drawings, map.role))
    console.note(spelled(note, FieldSpelling::option));
  TileSet set = drawn_set(drawings, tiles, map);
  const PackingPlan plan = planned_packing(options, set.tiles, set.tile_size);
  check_agreement(set, arguments.tolerance, console);

  const Progress progress = console.progress();
  Pack pack = packed(std::move(set), plan, options.synth.seed, progress);
  pack.generator.version = TILEPACK_VERSION;
  pack.generator.seed = options.synth.seed;
  pack.generator.options = recorded_options(options, packing_fields());
  const PackDescription made = described(pack);
  check_outputs(std::vector{depfile}, files_in(arguments.folder, made));
  if (const fs::path file(depfile.file);
      !file.empty() && one_spelling(file).parent_path() != one_spelling(arguments.folder))
    check_writable(file); // what lies in the pack's folder has to wait for it
  write_pack(pack, arguments.folder, progress);
  if (!arguments.depfile.empty())
    write_text_file(arguments.depfile, depfile_text(arguments.folder + "/pack.json", inputs));
  if (arguments.printed.json())
    console.print(made_json(made, arguments.folder), arguments.folder);
  else if (!console.quiet || arguments.printed.asked_for())
    console.print(bake_report_text(made, arguments.folder), arguments.folder);
  if (!now.empty()) console.note(now);
  return 0;
}

Action declare_pack(Options& options) {
  auto arguments = std::make_shared<PackArguments>();
  options.option("TILE", arguments->tiles, "images of the tiles, all of one size").required();
  options.group(most_used);
  options.option("-o,--output", arguments->folder, "folder of the pack; made if it is not there")
      .value("DIR")
      .required();
  options
      .option("--colors", arguments->colors,
              "JSON list of the tiles' colors, one entry a TILE: {\"north\": 0, \"east\": 0, \"south\": 0, "
              "\"west\": 0} or {\"nw\": 0, \"ne\": 0, \"sw\": 0, \"se\": 0}")
      .value("FILE")
      .required();
  options.option("--name", arguments->name, "name of the map in the pack (default: as its role)")
      .value("NAME");
  options
      .option("--role", arguments->role,
              fmt::format("what the values mean (default color): data, or one of {}", listed_kinds()))
      .value("ROLE");
  options
      .option("--tolerance", arguments->tolerance,
              "by how much borders of one color may differ, in parts of full scale, 0 to 1 (default 0)")
      .check(number(0, 1))
      .value("X");
  const std::vector<BakeField> fields = packing_fields();
  add_field_options(options, fields, {}, arguments->fields);
  options.group("Reading samples");
  add_reading_options(options, arguments->reading);
  options.group("General");
  add_printed_format(options, arguments->printed);
  options.option("--depfile", arguments->depfile, "write a rule for make or ninja: what the pack depends on")
      .value("FILE");
  add_jobs_option(options, arguments->jobs);
  return [arguments](Console& console) { return run_pack(*arguments, console); };
}

} // namespace

Verb pack_verb() {
  return {"pack", "make a tile pack from tiles drawn by hand",
          "  tilepack pack tile_*.png -o lines.pack --colors colors.json\n"
          "  tilepack pack *.png -o eight.pack --colors eight.json --layout rotated --mapping index\n",
          declare_pack};
}

} // namespace tilepack::cli
