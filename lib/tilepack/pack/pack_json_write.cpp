#include "tilepack/json/json_value.h"
#include "tilepack/mapping/even_pattern.h"
#include "tilepack/pack/map_meaning.h"
#include "tilepack/pack/pack_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tilepack {
namespace {

JsonValue size_json(Size size) {
  return JsonValue::array({size.width, size.height});
}

JsonValue tiles_json(const TileColors& tiles) {
  JsonValue list = JsonValue::array();
  if (const auto* edge = std::get_if<std::vector<EdgeTile>>(&tiles)) {
    for (const EdgeTile& t : *edge)
      list.push_back(
          {{"id", list.size()}, {"north", t.north}, {"east", t.east}, {"south", t.south}, {"west", t.west}});
  } else {
    for (const CornerTile& t : std::get<std::vector<CornerTile>>(tiles))
      list.push_back({{"id", list.size()}, {"nw", t.nw}, {"ne", t.ne}, {"sw", t.sw}, {"se", t.se}});
  }
  return list;
}

// Where the tile's own north-west corner lies, as fractions of the texture's sides.
JsonValue origin_json(const Layout& layout, int tile, Size tile_size) {
  const Placement::Vector origin = placement(layout, tile, tile_size, 0).origin;
  const auto fraction = [](double coordinate, int side) {
    const double turns = coordinate / side;
    return turns - std::floor(turns);
  };
  return JsonValue::array(
      {fraction(origin.x, layout.rotated.size.width), fraction(origin.y, layout.rotated.size.height)});
}

JsonValue layout_json(const Layout& layout, Size tile_size) {
  JsonValue json{{"kind", name_of(layout.kind)}};
  JsonValue cells = JsonValue::array();
  if (layout.kind == LayoutKind::rotated) {
    const RotatedScheme& scheme = layout.rotated.scheme;
    for (const Cell& cell : layout.cells)
      cells.push_back({{"tile", cell.tile},
                       {"origin", origin_json(layout, cell.tile, tile_size)},
                       {"angle", angle_in_degrees(scheme)}});
    json["n"] = scheme.n;
    json["k"] = scheme.k;
    json["squares"] = scheme.squares;
    json["gutter"] = layout.rotated.gutter;
    json["size"] = size_json(layout.rotated.size);
    json["matching"] = name_of(layout.rotated.matching);
  } else if (layout.kind == LayoutKind::array) {
    for (const Cell& cell : layout.cells) cells.push_back({{"tile", cell.tile}, {"layer", cell.row}});
    json["layers"] = layout.rows;
    json["border"] = layout.border;
  } else {
    for (const Cell& cell : layout.cells)
      cells.push_back({{"tile", cell.tile}, {"column", cell.column}, {"row", cell.row}});
    json["columns"] = layout.columns;
    json["rows"] = layout.rows;
  }
  json["cells"] = std::move(cells);
  return json;
}

using MapFiles = std::vector<TextureFile>;

// Version 1 of the format knows files of one level and one layer.
JsonValue levels_json(const MapFiles& files) {
  JsonValue levels = JsonValue::array();
  for (const TextureFile& file : files) {
    if (file.levels.size() != 1 || file.layers != 1)
      throw std::logic_error("pack.json of version 1 has a file a level");
    levels.push_back({{"file", file.file}, {"size", size_json(file.levels.front())}});
  }
  return levels;
}

JsonValue maps_json(const std::vector<PackedMap>& maps, const std::vector<MapFiles>& files) {
  JsonValue list = JsonValue::array();
  for (std::size_t m = 0; m < maps.size(); ++m) {
    list.push_back({{"name", maps[m].name},
                    {"role", name_of(maps[m].role)},
                    {"encoding", name_of(maps[m].encoding)},
                    {"depth", name_of(maps[m].depth)},
                    {"channels", maps[m].channels}});
    add_meaning(maps[m], list.back());
    list.back()["levels"] = levels_json(files[m]);
    for (const RoundTrip& trip : maps[m].round_trips)
      list.back()["round_trip_psnr"][std::string(name_of(trip.filter))] = trip.psnr;
  }
  return list;
}

// A digit an entry of the even pattern, row by row.
JsonValue digits_json(const std::vector<int>& pattern) {
  JsonValue rows = JsonValue::array();
  for (std::size_t row = 0; row < even_pattern_side; ++row) {
    std::string digits;
    for (std::size_t column = 0; column < even_pattern_side; ++column)
      digits += static_cast<char>('0' + pattern[row * even_pattern_side + column]);
    rows.push_back(digits);
  }
  return rows;
}

JsonValue mapping_json(const Mapping& mapping, const std::string& index_file) {
  JsonValue json = {{"kind", name_of(mapping.kind)},
                    {"virtual_size", JsonValue::array({mapping.size.width, mapping.size.height})}};
  switch (mapping.kind) {
  case MappingKind::permutation:
    json["table"] = mapping.table;
    break;
  case MappingKind::mix:
    json["seed"] = mapping.seed;
    break;
  case MappingKind::even:
    json["seed"] = mapping.seed;
    json["pattern"] = digits_json(mapping.table);
    if (!mapping.variants.empty()) json["variants"] = digits_json(mapping.variants);
    break;
  case MappingKind::index:
    json["file"] = index_file;
    break;
  }
  return json;
}

JsonValue generator_json(const Generator& generator) {
  auto sorted = generator.options;
  std::sort(sorted.begin(), sorted.end());
  JsonValue options = JsonValue::object();
  for (const auto& [name, value] : sorted) options[name] = value;
  return {{"name", generator.name},
          {"version", generator.version},
          {"options", std::move(options)},
          {"seed", generator.seed}};
}

JsonValue mips_json(const Pack& pack) {
  const bool filtered = pack.mip_mode != MipMode::none;
  const bool sanitized = filtered && pack.mip_mode != MipMode::box;
  JsonValue json{{"filter", filtered ? "box" : "none"},
                 {"sanitize", sanitized ? name_of(pack.mip_mode) : "none"},
                 {"guard", pack.guard},
                 {"tile_levels", pack.tile_levels}};
  if (pack.jump_weight) json["jump_weight"] = *pack.jump_weight;
  if (pack.full_chain) json["full_chain"] = true;
  return json;
}

JsonValue synthesis_json(const SetFigures& figures) {
  JsonValue json;
  for (const SetFigureField& field : set_figure_fields) json[std::string(field.name)] = figures.*field.value;
  return json;
}

std::vector<MapFiles> named_files(const std::vector<PackedMap>& maps, const std::string& prefix) {
  std::vector<MapFiles> files;
  for (const PackedMap& map : maps) {
    std::vector<Size> levels;
    for (const Image& image : map.levels) levels.push_back(image.size());
    for (const Image& image : map.far_levels) levels.push_back(image.size());
    files.push_back(texture_files(prefix + map.name, levels, map.stored().container));
  }
  return files;
}

void append_files(std::vector<std::string>& list, const std::vector<MapFiles>& maps) {
  for (const MapFiles& files : maps)
    for (const TextureFile& file : files) list.push_back(file.file);
}

std::vector<PackedMap> without_levels(const std::vector<PackedMap>& maps) {
  std::vector<PackedMap> bare;
  for (const PackedMap& m : maps) {
    PackedMap& map = bare.emplace_back(m, m.channels, std::vector<Image>{}, m.round_trips);
    map.container = m.container;
  }
  return bare;
}

} // namespace

std::vector<std::string> PackDescription::all_files() const {
  std::vector<std::string> list;
  append_files(list, map_files);
  append_files(list, corner_files);
  if (!index_file.empty()) list.push_back(index_file);
  return list;
}

PackDescription described(const Pack& pack) {
  PackDescription result;
  Pack& bare = result.pack;
  bare.generator = pack.generator;
  bare.tile_size = pack.tile_size;
  bare.colors = pack.colors;
  bare.tiles = pack.tiles;
  bare.layout = pack.layout;
  bare.maps = without_levels(pack.maps);
  bare.mapping = {pack.mapping.kind,    pack.mapping.size, pack.mapping.table, pack.mapping.seed, {},
                  pack.mapping.variants};
  bare.mip_mode = pack.mip_mode;
  bare.jump_weight = pack.jump_weight;
  bare.guard = pack.guard;
  bare.tile_levels = pack.tile_levels;
  bare.materials = pack.materials;
  bare.full_chain = pack.full_chain;
  bare.synthesis = pack.synthesis;
  result.map_files = named_files(pack.maps, "");
  if (pack.corner_pack) {
    const CornerPack& corner = *pack.corner_pack;
    bare.corner_pack = CornerPack{corner.columns, corner.rows, corner.width, without_levels(corner.maps)};
    result.corner_files = named_files(corner.maps, "corner.");
  }
  if (pack.mapping.kind == MappingKind::index) result.index_file = "index.png";
  return result;
}

std::string pack_json(const PackDescription& description) {
  const Pack& pack = description.pack;
  const bool edge = coloring_of(pack.tiles) == Coloring::edge;
  JsonValue json;
  json["format"] = "tilepack";
  json["version"] = 1;
  json["generator"] = generator_json(pack.generator);
  json["tile_size"] = size_json(pack.tile_size);
  json["coloring"] = name_of(coloring_of(pack.tiles));
  json["colors"] = edge
                       ? JsonValue{{"horizontal", pack.colors.horizontal}, {"vertical", pack.colors.vertical}}
                       : JsonValue{{"corner", pack.colors.corner}};
  if (pack.colors.variants > 1) json["variants"] = pack.colors.variants;
  if (!pack.materials.empty()) json["materials"] = pack.materials;
  json["tiles"] = tiles_json(pack.tiles);
  json["layout"] = layout_json(pack.layout, pack.tile_size);
  json["maps"] = maps_json(pack.maps, description.map_files);
  json["mapping"] = mapping_json(pack.mapping, description.index_file);
  if (pack.corner_pack)
    json["corner_pack"] = {{"columns", pack.corner_pack->columns},
                           {"rows", pack.corner_pack->rows},
                           {"width", pack.corner_pack->width},
                           {"maps", maps_json(pack.corner_pack->maps, description.corner_files)}};
  json["mips"] = mips_json(pack);
  if (pack.synthesis) json["synthesis"] = synthesis_json(*pack.synthesis);
  return filled_json_text(json);
}

} // namespace tilepack
