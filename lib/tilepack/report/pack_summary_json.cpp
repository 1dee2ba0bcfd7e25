#include "tilepack/error/field.h"
#include "tilepack/json/json_value.h"
#include "tilepack/measure/pack_memory.h"
#include "tilepack/pack/map_meaning.h"
#include "tilepack/report/pack_summary.h"
#include "tilepack/report/size_choice.h"

#include <algorithm>

namespace tilepack {
namespace {

using MapFiles = std::vector<TextureFile>;

// What maps are, without their files.
JsonValue map_json(const PackedMap& map) {
  JsonValue json{{"name", map.name},
                 {"role", name_of(map.role)},
                 {"encoding", name_of(map.encoding)},
                 {"depth", name_of(map.depth)},
                 {"channels", map.channels}};
  add_meaning(map, json);
  for (const RoundTrip& trip : map.round_trips)
    json["round_trip_psnr"][std::string(name_of(trip.filter))] = trip.psnr;
  return json;
}

JsonValue rotated_json(const RotatedGrid& grid) {
  return {{"scheme", formula(grid.scheme)},
          {"angle", angle_in_degrees(grid.scheme)},
          {"gutter", grid.gutter},
          {"matching", name_of(grid.matching)}};
}

JsonValue corner_pack_json(const CornerPack& corners) {
  return {{"columns", corners.columns}, {"rows", corners.rows}, {"width", corners.width}};
}

JsonValue figures_json(const SetFigures& figures) {
  JsonValue json = JsonValue::object();
  for (const SetFigureField& field : set_figure_fields) json[std::string(field.name)] = figures.*field.value;
  return json;
}

JsonValue maps_json(const PackSummary& summary, const std::vector<PackedMap>& maps,
                    const std::vector<MapFiles>& files) {
  JsonValue list = JsonValue::array();
  for (std::size_t m = 0; m < std::min(maps.size(), files.size()); ++m) {
    JsonValue levels = JsonValue::array();
    for (const TextureFile& file : files[m]) {
      const auto found = summary.file_bytes.find(file.file);
      for (const Size& size : file.levels)
        levels.push_back(
            {{"file", file.file},
             {"size", JsonValue::array({size.width, size.height})},
             {"bytes", found == summary.file_bytes.end() ? JsonValue(nullptr) : JsonValue(found->second)}});
    }
    list.push_back(map_json(maps[m]));
    list.back()["levels"] = std::move(levels);
  }
  return list;
}

JsonValue tiles_json(const Pack& pack) {
  JsonValue list = JsonValue::array();
  std::vector<const Cell*> cell_of(static_cast<std::size_t>(tile_count(pack.tiles)), nullptr);
  for (const Cell& cell : pack.layout.cells) cell_of[static_cast<std::size_t>(cell.tile)] = &cell;
  for (int tile = 0; tile < tile_count(pack.tiles); ++tile) {
    JsonValue json{{"id", tile}};
    if (const auto* edges = std::get_if<std::vector<EdgeTile>>(&pack.tiles)) {
      const EdgeTile& t = (*edges)[static_cast<std::size_t>(tile)];
      json["north"] = t.north;
      json["east"] = t.east;
      json["south"] = t.south;
      json["west"] = t.west;
    } else {
      const CornerTile& t = std::get<std::vector<CornerTile>>(pack.tiles)[static_cast<std::size_t>(tile)];
      json["nw"] = t.nw;
      json["ne"] = t.ne;
      json["sw"] = t.sw;
      json["se"] = t.se;
    }
    if (const Cell* cell = cell_of[static_cast<std::size_t>(tile)]) {
      json["column"] = cell->column;
      json["row"] = cell->row;
    }
    list.push_back(std::move(json));
  }
  return list;
}

JsonValue seams_json(const SeamFigures& seams) {
  JsonValue worst = JsonValue::array();
  for (const BorderStep& border : seams.worst)
    worst.push_back({{"tile", border.tile},
                     {"side", name_of(border.side)},
                     {"neighbour", border.neighbour},
                     {"ratio", border.ratio},
                     {"window", border.window},
                     {"window_at", border.window_at}});
  return {{"pairs", seams.pairs},
          {"seam", seams.seam},
          {"window_texels", seam_window},
          {"worst", std::move(worst)}};
}

JsonValue synthesis_json(const BakeFacts& facts) {
  JsonValue json = figures_json(facts.report.figures);
  json["border_step"] = facts.seams.seam;
  json["periods"] = JsonValue::array({facts.nature.periods.x.length, facts.nature.periods.y.length});
  json["drift"] = facts.nature.drift;
  json["shading"] = facts.nature.shading;
  json["two_tone"] = facts.nature.two_tone;
  json["ink"] = facts.nature.ink;
  const Landmark& mark = facts.report.landmark;
  json["landmark"] = {{"at", JsonValue::array({mark.centre.x, mark.centre.y})},
                      {"deviation", mark.deviation},
                      {"shown", mark.shown}};
  return json;
}

// Of each material what is shown of it, and its figures as a set by itself.
JsonValue transition_json(const BakeFacts& facts) {
  JsonValue json{{"border_length", facts.transition.border_length},
                 {"through_things", facts.transition.through_things},
                 {"straight_through_things", facts.transition.expected}};
  json["materials"] = JsonValue::array();
  for (std::size_t m = 0; m < facts.materials.size(); ++m)
    json["materials"].push_back({{"name", facts.materials[m].material},
                                 {"shown", facts.transition.shown[m]},
                                 {"synthesis", figures_json(facts.materials[m].report.figures)}});
  return json;
}

JsonValue verdict_json(const BakeFacts& facts) {
  const BakeVerdict verdict = bake_verdict(facts);
  JsonValue json;
  json["grade"] = name_of(verdict.grade);
  json["remarks"] = JsonValue::array();
  for (const BakeRemark& remark : verdict.remarks) {
    JsonValue entry{{"grade", name_of(remark.grade)},
                    {"code", remark.code},
                    {"text", spelled(remark.text, FieldSpelling::option)}};
    if (remark.cure) entry["cure"] = {{"field", remark.cure->field}, {"value", remark.cure->value}};
    json["remarks"].push_back(std::move(entry));
  }
  return json;
}

JsonValue options_json(const std::vector<Cure>& options) {
  JsonValue json = JsonValue::object();
  for (const Cure& option : options) json[option.field] = option.value;
  return json;
}

JsonValue size_choice_json(const BakeFacts& facts) {
  const SizeChoice choice = size_choice(facts);
  JsonValue json;
  json["times_sample"] = choice.times_sample;
  json["smaller"] = options_json(choice.smaller);
  json["richer"] = options_json(choice.richer);
  return json;
}

} // namespace

std::string summary_json(const PackSummary& summary) {
  const PackDescription& description = summary.description;
  const Pack& pack = description.pack;
  const bool edge = coloring_of(pack.tiles) == Coloring::edge;
  JsonValue colors =
      edge ? JsonValue{{"horizontal", pack.colors.horizontal}, {"vertical", pack.colors.vertical}}
           : JsonValue{{"corner", pack.colors.corner}};
  if (pack.colors.variants > 1) colors["variants"] = pack.colors.variants;
  JsonValue options = JsonValue::object();
  for (const auto& [name, value] : pack.generator.options) options[name] = value;
  const std::uint64_t in_memory = bytes_in_memory(pack, description);
  JsonValue json{
      {"pack", summary.subject},
      {"tile_size", JsonValue::array({pack.tile_size.width, pack.tile_size.height})},
      {"coloring", name_of(coloring_of(pack.tiles))},
      {"colors", std::move(colors)},
      {"layout",
       {{"kind", name_of(pack.layout.kind)}, {"columns", pack.layout.columns}, {"rows", pack.layout.rows}}},
      {"tiles", tiles_json(pack)},
      {"maps", maps_json(summary, pack.maps, description.map_files)},
      {"mapping",
       {{"kind", name_of(pack.mapping.kind)},
        {"virtual_size", JsonValue::array({pack.mapping.size.width, pack.mapping.size.height})}}},
      {"mips",
       {{"mode", name_of(pack.mip_mode)},
        {"levels", pack.tile_levels},
        {"full_chain", pack.full_chain},
        {"guard", pack.guard}}},
      {"bytes",
       {{"files", bytes_on_disk(summary)},
        {"file_count", summary.file_bytes.size()},
        {"memory", in_memory},
        {"stored_whole", bytes_stored_whole(pack)}}},
      {"generator",
       {{"name", pack.generator.name},
        {"version", pack.generator.version},
        {"seed", pack.generator.seed},
        {"options", std::move(options)}}}};
  if (pack.layout.kind == LayoutKind::rotated) json["layout"]["rotated"] = rotated_json(pack.layout.rotated);
  if (pack.corner_pack) {
    json["corner_pack"] = corner_pack_json(*pack.corner_pack);
    json["corner_pack"]["maps"] = maps_json(summary, pack.corner_pack->maps, description.corner_files);
  }
  if (!pack.materials.empty()) json["materials"] = pack.materials;
  if (pack.synthesis) json["synthesis"] = figures_json(*pack.synthesis);
  if (summary.seams) json["seams"] = seams_json(*summary.seams);
  return json_text(json);
}

std::string made_json(const PackDescription& made, const std::string& folder, const BakeFacts* facts) {
  const Pack& pack = made.pack;
  JsonValue json;
  json["pack"] = folder;
  json["tiles"] = tile_count(pack.tiles);
  json["tile_size"] = JsonValue::array({pack.tile_size.width, pack.tile_size.height});
  json["tile_levels"] = pack.tile_levels;
  json["layout"] = name_of(pack.layout.kind);
  json["mapping"] = name_of(pack.mapping.kind);
  json["virtual_size"] = JsonValue::array({pack.mapping.size.width, pack.mapping.size.height});
  if (!pack.materials.empty()) json["materials"] = pack.materials;
  if (pack.layout.kind == LayoutKind::rotated) json["rotated"] = rotated_json(pack.layout.rotated);
  if (pack.corner_pack) json["corner_pack"] = corner_pack_json(*pack.corner_pack);
  json["maps"] = JsonValue::array();
  for (const PackedMap& map : pack.maps) json["maps"].push_back(map_json(map));
  json["files"] = made.all_files();
  json["files"].push_back("pack.json");
  if (facts) {
    if (facts->straightened > 0) json["straightened"] = facts->straightened;
    if (facts->tones_chosen) json["flattened"] = facts->levelled ? "courses" : "all";
    json["synthesis"] =
        facts->materials.empty() ? synthesis_json(*facts) : figures_json(facts->report.figures);
    if (!facts->materials.empty()) json["transition"] = transition_json(*facts);
    json["verdict"] = verdict_json(*facts);
    if (facts->size_chosen) json["size_choice"] = size_choice_json(*facts);
  }
  return json_text(json, JsonLetters::ascii);
}

std::string judged_json(const BakeFacts& facts) {
  return json_text({{"synthesis", synthesis_json(facts)}, {"verdict", verdict_json(facts)}},
                   JsonLetters::ascii);
}

} // namespace tilepack
