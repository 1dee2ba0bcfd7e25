#include "bake_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tilepack::cli {
namespace {

std::string colors_text(const Pack& pack) {
  if (coloring_of(pack.tiles) == Coloring::corner) return fmt::format("{} corner colors", pack.colors.corner);
  return fmt::format("{} x {} edge colors", pack.colors.horizontal, pack.colors.vertical);
}

template <typename Count>
std::string counted(Count count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

// "3² + 3² turned by 45.00°, 0.35 % unused, borders match".
std::string turned_text(const Pack& pack, Size texture) {
  const RotatedGrid& grid = pack.layout.rotated;
  const double texels = static_cast<double>(texture.width) * texture.height;
  const double needed =
      static_cast<double>(tile_count(pack.tiles)) * pack.tile_size.width * pack.tile_size.height;
  std::string neighbours;
  switch (grid.matching) {
  case Matching::found:
    neighbours = "neighbours match across all borders";
    break;
  case Matching::none:
    neighbours = "no arrangement has neighbours that all match";
    break;
  case Matching::not_found:
    neighbours = "no arrangement was found whose neighbours all match";
    break;
  }
  return fmt::format("  turned    {} by {:.2f}°, {:.2f} % of the texture wasted; {}: {}\n",
                     formula(grid.scheme), angle_in_degrees(grid.scheme), 100 * (1 - needed / texels),
                     neighbours, grid.gutter == 0 ? "no gutter" : fmt::format("gutter {}", grid.gutter));
}

std::string loss_text(const PackedMap& map) {
  std::string text;
  for (const RoundTrip& trip : map.round_trips)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name_of(trip.filter),
                        trip.psnr ? fmt::format("{:.2f} dB", *trip.psnr) : "exact");
  return fmt::format("  {:<9} stored turned and read back: {}\n", map.name, text);
}

std::string escaped(const std::string& path) {
  std::string text;
  for (const char c : path) {
    if (c == '$') text += '$';
    if (c == ' ' || c == '\t' || c == '#' || c == ':') text += '\\';
    text += c;
  }
  return text;
}

// Only what could be better: an artist wants to know whether to look closer.
std::string verdict_text(const BakeFacts& facts) {
  const SetFigures& f = facts.report.figures;
  const BakeVerdict verdict = bake_verdict(facts);
  std::string text =
      fmt::format("  {:<9} {}: {:.0f} % of the sample shown, as varied as {:.1f} tiles; cuts {:.1f}, "
                  "95 % below {:.1f}, sample {:.1f}; borders {:.1f}\n",
                  "quality", name_of(verdict.grade), f.coverage * 100, f.distinct_tiles, f.cut_mean,
                  f.cut_p95, f.sample_step, f.border_mean);
  for (const BakeRemark& remark : verdict.remarks)
    if (remark.grade != Grade::good) text += fmt::format("  {:<9} {}\n", name_of(remark.grade), remark.text);
  return text;
}

nlohmann::ordered_json synthesis_json(const BakeFacts& facts) {
  nlohmann::ordered_json json;
  for (const SetFigureField& field : set_figure_fields)
    json[std::string(field.name)] = facts.report.figures.*field.value;
  json["border_step"] = facts.seams.seam;
  json["periods"] = {facts.nature.periods.x.length, facts.nature.periods.y.length};
  json["drift"] = facts.nature.drift;
  json["two_tone"] = facts.nature.two_tone;
  json["ink"] = facts.nature.ink;
  const Landmark& mark = facts.report.landmark;
  json["landmark"] = {
      {"at", {mark.centre.x, mark.centre.y}}, {"deviation", mark.deviation}, {"shown", mark.shown}};
  return json;
}

nlohmann::ordered_json verdict_json(const BakeFacts& facts) {
  const BakeVerdict verdict = bake_verdict(facts);
  nlohmann::ordered_json json;
  json["grade"] = name_of(verdict.grade);
  json["remarks"] = nlohmann::ordered_json::array();
  for (const BakeRemark& remark : verdict.remarks)
    json["remarks"].push_back({{"grade", name_of(remark.grade)}, {"text", remark.text}});
  return json;
}

} // namespace

std::string bake_report_text(const PackDescription& made, const std::string& folder, const BakeFacts* facts) {
  const Pack& pack = made.pack;
  std::string text =
      fmt::format("{}: {} tiles of {} x {} texels, {}, {} layout\n", folder, tile_count(pack.tiles),
                  pack.tile_size.width, pack.tile_size.height, colors_text(pack), name_of(pack.layout.kind));
  for (std::size_t m = 0; m < pack.maps.size(); ++m) {
    const PackedMap& map = pack.maps[m];
    const Size size = made.map_files[m].front().size;
    text += fmt::format("  {:<9} {} x {} texels, {}, {}, {} {}, from {}\n", map.name, size.width, size.height,
                        counted(made.map_files[m].size(), "level"), counted(map.channels, "channel"),
                        name_of(map.depth), name_of(map.encoding), made.map_files[m].front().file);
  }
  if (pack.layout.kind == LayoutKind::rotated) {
    text += turned_text(pack, made.map_files.front().front().size);
    for (const PackedMap& map : pack.maps) text += loss_text(map);
  }
  if (pack.corner_pack)
    text += pack.corner_pack->width > 0
                ? fmt::format("  {:<9} {} x {} cells, read up to {} texels from corners\n", "corners",
                              pack.corner_pack->columns, pack.corner_pack->rows, pack.corner_pack->width)
                : fmt::format("  {:<9} not read: {}\n", "corners",
                              "the corners of all tiles agree already, or don't follow from edge colors");
  text += fmt::format("  {:<9} {}, {} x {} tiles\n", "mapping", name_of(pack.mapping.kind),
                      pack.mapping.size.width, pack.mapping.size.height);
  return facts ? text + verdict_text(*facts) : text;
}

std::string bake_report_json(const PackDescription& made, const std::string& folder, const BakeFacts* facts) {
  const Pack& pack = made.pack;
  nlohmann::ordered_json json;
  json["pack"] = folder;
  json["tiles"] = tile_count(pack.tiles);
  json["tile_size"] = {pack.tile_size.width, pack.tile_size.height};
  json["tile_levels"] = pack.tile_levels;
  json["layout"] = name_of(pack.layout.kind);
  json["mapping"] = name_of(pack.mapping.kind);
  json["virtual_size"] = {pack.mapping.size.width, pack.mapping.size.height};
  if (pack.layout.kind == LayoutKind::rotated) {
    const RotatedGrid& grid = pack.layout.rotated;
    json["rotated"] = {{"scheme", formula(grid.scheme)},
                       {"angle", angle_in_degrees(grid.scheme)},
                       {"gutter", grid.gutter},
                       {"matching", name_of(grid.matching)}};
  }
  if (pack.corner_pack)
    json["corner_pack"] = {{"columns", pack.corner_pack->columns},
                           {"rows", pack.corner_pack->rows},
                           {"width", pack.corner_pack->width}};
  json["maps"] = nlohmann::ordered_json::array();
  for (const PackedMap& map : pack.maps) {
    json["maps"].push_back({{"name", map.name},
                            {"role", name_of(map.role)},
                            {"encoding", name_of(map.encoding)},
                            {"depth", name_of(map.depth)},
                            {"channels", map.channels}});
    for (const RoundTrip& trip : map.round_trips)
      json["maps"].back()["round_trip_psnr"][std::string(name_of(trip.filter))] =
          trip.psnr ? nlohmann::ordered_json(*trip.psnr) : nlohmann::ordered_json(nullptr);
  }
  json["files"] = made.all_files();
  json["files"].push_back("pack.json");
  if (facts) {
    json["synthesis"] = synthesis_json(*facts);
    json["verdict"] = verdict_json(*facts);
  }
  return json.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

Progress StageClock::around(Progress onward) {
  return [this, onward = std::move(onward)](std::string_view stage, double done) {
    begin(stage);
    report(onward, stage, done);
  };
}

void StageClock::begin(std::string_view stage) {
  const auto now = std::chrono::steady_clock::now();
  if (current < stages.size()) stages[current].share += std::chrono::duration<double>(now - since).count();
  since = now;
  current = 0;
  while (current < stages.size() && stages[current].stage != stage) ++current;
  if (current == stages.size()) stages.push_back({std::string(stage), 0.0});
}

std::vector<StageShare> StageClock::shares() {
  begin(stages.empty() ? "reading" : stages[current].stage); // counts what has passed
  double total = 0.0;
  for (const StageShare& s : stages) total += s.share;
  std::vector<StageShare> result;
  for (const StageShare& s : stages)
    if (s.share >= 0.01 * total && total > 0) result.push_back({s.stage, s.share / total});
  return result;
}

std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs) {
  std::string text = escaped(target) + ":";
  for (const std::string& input : inputs) text += fmt::format(" \\\n  {}", escaped(input));
  text += '\n';
  for (const std::string& input : inputs) text += fmt::format("\n{}:\n", escaped(input));
  return text;
}

} // namespace tilepack::cli
