#include "bake_report.h"

#include "tilepack/error/field.h"
#include "tilepack/pack/map_meaning.h"
#include "tilepack/report/pack_summary.h"
#include "tilepack/report/size_choice.h"

#include <fmt/format.h>

#include <filesystem>

namespace tilepack::cli {
namespace {

template <typename Count>
std::string counted(Count count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string colors_text(const Pack& pack) {
  const std::string colors =
      coloring_of(pack.tiles) == Coloring::corner
          ? counted(pack.colors.corner, "corner color")
          : fmt::format("{} x {} edge colors", pack.colors.horizontal, pack.colors.vertical);
  return pack.colors.variants > 1 ? fmt::format("{} with {} variants", colors, pack.colors.variants) : colors;
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

} // namespace

std::string title_of(const BakeJob& job) {
  if (job.transition.empty()) return std::filesystem::path(job.sample).filename().string();
  std::string title;
  for (const std::string& name : material_names_of(job)) title += (title.empty() ? "" : " to ") + name;
  return title;
}

// Only what could be better: an artist wants to know whether to look closer.
std::string verdict_text(const BakeFacts& facts) {
  const BakeVerdict verdict = bake_verdict(facts);
  std::string text = fmt::format("  {:<9} {}{}\n", "quality", name_of(verdict.grade),
                                 shows_nothing(facts) ? "" : ": " + figures_text(facts.report.figures));
  for (const BakeRemark& remark : verdict.remarks)
    if (remark.grade != Grade::good || remark.code == "fireflies" || remark.code == "levels-end")
      text += fmt::format("  {:<9} {}\n", remark.grade != Grade::good ? name_of(remark.grade) : "note",
                          spelled(remark.text, FieldSpelling::option));
  return text;
}

std::string bake_report_text(const PackDescription& made, const std::string& folder, const BakeFacts* facts) {
  const Pack& pack = made.pack;
  std::string text = fmt::format("{}: {} of {} x {} texels, {}, {} layout\n", folder,
                                 counted(tile_count(pack.tiles), "tile"), pack.tile_size.width,
                                 pack.tile_size.height, colors_text(pack), name_of(pack.layout.kind));
  for (std::size_t m = 0; m < pack.maps.size(); ++m) {
    const PackedMap& map = pack.maps[m];
    const Size size = made.map_files[m].front().levels.front();
    const std::string meaning = meaning_text(map);
    text += fmt::format("  {:<9} {} x {} texels, {}, {}, {} {}, from {}{}\n", map.name, size.width,
                        size.height, counted(levels_in(made.map_files[m]), "level"),
                        counted(map.channels, "channel"), name_of(map.depth), name_of(map.encoding),
                        made.map_files[m].front().file, meaning.empty() ? "" : "; " + meaning);
  }
  if (pack.layout.kind == LayoutKind::rotated) {
    text += turned_text(pack, made.map_files.front().front().levels.front());
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
  if (facts && facts->size_chosen)
    text +=
        fmt::format("  {:<9} {}\n", "tile size", spelled(size_choice_text(*facts), FieldSpelling::option));
  if (facts && facts->straightened > 0)
    text +=
        fmt::format("  {:<9} straightened, so that courses repeat evenly and fit tiles: they were moved by "
                    "up to {:.1f} texels; {} leaves "
                    "them as they are\n",
                    "sample", facts->straightened, spelled(field("no-straighten"), FieldSpelling::option));
  if (facts && facts->tones_chosen)
    text += fmt::format("  {:<9} {}; {} leaves it as it is\n", "sample",
                        facts->levelled
                            ? "its courses made alike in tone, so that any of them can go on in any other"
                            : "flattened, for its tones lie in lines that tiles would cut off",
                        spelled(field("flatten", "0"), FieldSpelling::option));
  return facts ? text + verdict_text(*facts) : text;
}

} // namespace tilepack::cli
