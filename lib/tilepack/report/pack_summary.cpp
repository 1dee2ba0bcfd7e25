#include "tilepack/report/pack_summary.h"

#include "tilepack/error/field.h"
#include "tilepack/measure/pack_memory.h"
#include "tilepack/numeric/grid.h"
#include "tilepack/pack/map_meaning.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tilepack {
namespace {

using MapFiles = std::vector<TextureFile>;

constexpr int widest_table = 8; // columns of the layout that still fit a line

std::string bytes_text(double bytes) {
  const char* units[] = {"B", "kB", "MB", "GB", "TB", "PB", "EB", "ZB"};
  std::size_t unit = 0;
  while (bytes >= 1000 && unit + 1 < std::size(units)) {
    bytes /= 1000;
    ++unit;
  }
  return unit == 0 ? fmt::format("{:.0f} B", bytes) : fmt::format("{:.3g} {}", bytes, units[unit]);
}

std::uint64_t file_bytes(const PackSummary& summary, const MapFiles& files) {
  std::uint64_t bytes = 0;
  for (const TextureFile& file : files) {
    const auto found = summary.file_bytes.find(file.file);
    if (found != summary.file_bytes.end()) bytes += found->second;
  }
  return bytes;
}

std::string colors_of(const TileColors& tiles, int tile) {
  if (const auto* edges = std::get_if<std::vector<EdgeTile>>(&tiles)) {
    const EdgeTile& t = (*edges)[static_cast<std::size_t>(tile)];
    return fmt::format("{}{}{}{}", t.north, t.east, t.south, t.west);
  }
  const CornerTile& t = std::get<std::vector<CornerTile>>(tiles)[static_cast<std::size_t>(tile)];
  return fmt::format("{}{}{}{}", t.nw, t.ne, t.sw, t.se);
}

bool edge_colored(const Pack& pack) {
  return coloring_of(pack.tiles) == Coloring::edge;
}

std::string layout_text(const Layout& layout) {
  const RotatedGrid& rotated = layout.rotated;
  if (layout.kind == LayoutKind::rotated)
    return fmt::format("rotated, {} turned by {:.3f} degrees, gutter {}, neighbours {},",
                       formula(rotated.scheme), angle_in_degrees(rotated.scheme), rotated.gutter,
                       rotated.matching == Matching::found ? "match" : "don't match");
  if (layout.kind == LayoutKind::array)
    return fmt::format("array, {} layers, border {},", layout.rows, layout.border);
  return fmt::format("{}, {} x {} cells", name_of(layout.kind), layout.columns, layout.rows);
}

// Which corner color is which material, and how pictures of the pack mark it (color_paint).
std::string materials_text(const std::vector<std::string>& materials) {
  constexpr std::array marks{"orange", "blue", "green", "pink"};
  std::string text;
  for (std::size_t i = 0; i < materials.size(); ++i)
    text += fmt::format("{}{} {} ({} in pictures)", i == 0 ? "materials " : ", ", i, materials[i],
                        marks[i % marks.size()]);
  return text.empty() ? text : text + "\n";
}

// The grid as it lies in the texture: id and colors a cell.
std::string grid_text(const Pack& pack) {
  const Layout& layout = pack.layout;
  if (layout.kind == LayoutKind::rotated) return "";
  std::string text = fmt::format("          cells: tile id, colors {}\n",
                                 edge_colored(pack) ? "north east south west" : "nw ne sw se");
  if (layout.columns > widest_table || layout.rows > 4 * widest_table)
    return fmt::format("          (the grid is too large for a table; {} draws it)\n",
                       spelled(field("picture"), FieldSpelling::option));
  Grid<std::string> cells(layout.columns, layout.rows, "-");
  for (const Cell& cell : layout.cells)
    cells.at(cell.column, cell.row) = fmt::format("{:>4} {}", cell.tile, colors_of(pack.tiles, cell.tile));
  for (int row = 0; row < layout.rows; ++row) {
    text += "        ";
    for (int column = 0; column < layout.columns; ++column)
      text += fmt::format("{:>10}", cells.at(column, row));
    text += "\n";
  }
  return text;
}

std::string maps_text(const PackSummary& summary, const std::vector<PackedMap>& maps,
                      const std::vector<MapFiles>& files) {
  const bool turned = summary.description.pack.layout.kind == LayoutKind::rotated;
  std::string text;
  for (std::size_t m = 0; m < std::min(maps.size(), files.size()); ++m) {
    if (files[m].empty()) continue;
    const PackedMap& map = maps[m];
    const Size fine = files[m].front().levels.front();
    const Size coarse = files[m].back().levels.back();
    const int levels = levels_in(files[m]);
    text += fmt::format(
        "          {}: role {}, {}, {} channel{}, {}; {} level{}, {} x {} down to {} x {}; {} in files\n",
        map.name, name_of(map.role), name_of(map.encoding), map.channels, map.channels == 1 ? "" : "s",
        name_of(map.depth), levels, levels == 1 ? "" : "s", fine.width, fine.height, coarse.width,
        coarse.height, bytes_text(static_cast<double>(file_bytes(summary, files[m]))));
    if (const std::string meaning = meaning_text(map); !meaning.empty())
      text += fmt::format("            {}\n", meaning);
    for (const RoundTrip& trip : map.round_trips)
      text += fmt::format(
          "{}{} {}",
          trip.filter == ResampleFilter::bilinear ? "            stored turned and read back: " : ", ",
          name_of(trip.filter), trip.psnr ? fmt::format("{:.2f} dB", *trip.psnr) : "exact");
    if (!map.round_trips.empty()) text += "\n";
    if (map.round_trips.empty() && turned)
      text += "            stored turned; what that loses was not measured\n";
  }
  return text;
}

std::string seams_text(const SeamFigures& seams) {
  std::string text =
      fmt::format("borders   step across over step inside tiles: {:.3f} (1 can't be seen), {} pairs\n",
                  seams.seam, seams.pairs);
  if (!seams.worst.empty()) text += fmt::format("          worst {} texels of a border:\n", seam_window);
  for (const BorderStep& border : seams.worst)
    text += fmt::format("            tile {} and tile {} to its {}: {:.2f} from texel {} on ({:.2f} along "
                        "the whole border)\n",
                        border.tile, border.neighbour, name_of(border.side), border.window, border.window_at,
                        border.ratio);
  return text;
}

std::string mapping_text(const Pack& pack) {
  const VirtualSize& size = pack.mapping.size;
  std::string kind(name_of(pack.mapping.kind));
  if (pack.mapping.kind == MappingKind::permutation)
    kind += fmt::format(" of {} entries", pack.mapping.table.size());
  if (pack.mapping.kind == MappingKind::mix || pack.mapping.kind == MappingKind::even)
    kind += fmt::format(", seed {}", pack.mapping.seed);
  return fmt::format("mapping   {}; {} x {} tiles = {} x {} texels\n", kind, size.width, size.height,
                     size.width * pack.tile_size.width, size.height * pack.tile_size.height);
}

} // namespace

std::uint64_t bytes_on_disk(const PackSummary& summary) {
  std::uint64_t bytes = 0;
  for (const auto& [file, size] : summary.file_bytes) bytes += size;
  return bytes;
}

std::string figures_text(const SetFigures& figures) {
  return fmt::format(
      "{:.0f} % of the sample shown, as varied as {:.1f} tiles; steps across cuts {:.1f} (95 % "
      "below {:.1f}), in the sample {:.1f}, across borders {:.1f}",
      figures.coverage * 100, figures.distinct_tiles, figures.cut_mean, figures.cut_p95, figures.sample_step,
      figures.border_mean);
}

std::string summary_text(const PackSummary& summary) {
  const PackDescription& description = summary.description;
  const Pack& pack = description.pack;
  const Size tile = pack.tile_size;
  const std::string colors = edge_colored(pack) ? fmt::format("{} horizontal and {} vertical edge colors",
                                                              pack.colors.horizontal, pack.colors.vertical)
                                                : fmt::format("{} corner colors", pack.colors.corner);
  const std::string variants =
      pack.colors.variants > 1 ? fmt::format(", {} variants of each combination", pack.colors.variants) : "";
  std::string text = fmt::format("{}\ntiles     {} of {} x {} texels, {}{}\n", summary.subject,
                                 tile_count(pack.tiles), tile.width, tile.height, colors, variants);
  text += materials_text(pack.materials);
  const Size texture = texture_size(pack.layout, tile, 0);
  text +=
      fmt::format("layout    {} = {} x {} texels\n", layout_text(pack.layout), texture.width, texture.height);
  text += grid_text(pack);
  text += "maps\n" + maps_text(summary, pack.maps, description.map_files);
  if (pack.corner_pack) {
    text +=
        fmt::format("corners   a pack of {} x {} cells for lattice points, read up to {} texels from them\n",
                    pack.corner_pack->columns, pack.corner_pack->rows, pack.corner_pack->width);
    text += maps_text(summary, pack.corner_pack->maps, description.corner_files);
  }
  text += mapping_text(pack);
  std::string far;
  if (pack.full_chain && !description.map_files.empty())
    far = fmt::format(" of tiles and {} on to the mean",
                      levels_in(description.map_files.front()) - pack.tile_levels);
  text += fmt::format("mips      {}, {} level{}{}, guard {} texels\n", name_of(pack.mip_mode),
                      pack.tile_levels, pack.tile_levels == 1 ? "" : "s", far, pack.guard);
  const auto in_memory = static_cast<double>(bytes_in_memory(pack, description));
  const double whole = bytes_stored_whole(pack);
  text += fmt::format("size      {} in {} files; {} in memory, uncompressed; a texture of the virtual size "
                      "{} ({:.4g} times)\n",
                      bytes_text(static_cast<double>(bytes_on_disk(summary))), summary.file_bytes.size(),
                      bytes_text(in_memory), bytes_text(whole), in_memory > 0 ? whole / in_memory : 0);
  if (pack.synthesis) text += fmt::format("synthesis {}\n", figures_text(*pack.synthesis));
  if (summary.seams) text += seams_text(*summary.seams);
  text += fmt::format("made by   {} {}, seed {}\n", pack.generator.name, pack.generator.version,
                      pack.generator.seed);
  std::string options;
  for (const auto& [name, value] : pack.generator.options) {
    if (!options.empty()) options += ", ";
    options += name + " " + value;
  }
  if (!options.empty()) text += "          " + options + "\n";
  return text;
}

} // namespace tilepack
