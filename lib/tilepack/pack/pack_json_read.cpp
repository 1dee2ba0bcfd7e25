#include "tilepack/error/error.h"
#include "tilepack/json/json_cursor.h"
#include "tilepack/layout/array_layout.h"
#include "tilepack/layout/rotated_lattice.h"
#include "tilepack/layout/surroundings.h"
#include "tilepack/mapping/even_pattern.h"
#include "tilepack/mip/far_levels.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/pack/file_name.h"
#include "tilepack/pack/json_enum.h"
#include "tilepack/pack/map_meaning.h"
#include "tilepack/pack/pack_json.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace tilepack {
namespace {

using LevelFiles = std::vector<TextureFile>;

Size read_size(const JsonCursor& value, int largest) {
  value.array(2, 2);
  return {value.item(0).small_integer(1, largest), value.item(1).small_integer(1, largest)};
}

Generator read_generator(const JsonCursor& value) {
  value.only({"name", "version", "options", "seed"});
  Generator generator;
  generator.name = value.member("name").text();
  generator.version = value.member("version").text();
  const JsonCursor options = value.member("options");
  for (const std::string& name : options.names())
    generator.options.emplace_back(name, options.member(name).text());
  generator.seed =
      static_cast<std::uint64_t>(value.member("seed").integer(0, static_cast<std::int64_t>(largest_seed)));
  return generator;
}

ColorCounts read_colors(const JsonCursor& value, Coloring coloring) {
  if (coloring == Coloring::corner) {
    value.only({"corner"});
    return {0, 0, value.member("corner").small_integer(1, limits::most_corner_colors)};
  }
  value.only({"horizontal", "vertical"});
  return {value.member("horizontal").small_integer(1, limits::most_edge_colors),
          value.member("vertical").small_integer(1, limits::most_edge_colors), 0};
}

TileColors read_tiles(const JsonCursor& list, Coloring coloring, const ColorCounts& colors) {
  const std::size_t count = list.array(1, limits::most_tiles);
  std::vector<EdgeTile> edge;
  std::vector<CornerTile> corner;
  for (std::size_t i = 0; i < count; ++i) {
    const JsonCursor tile = list.item(i);
    tile.member("id").integer(static_cast<int>(i), static_cast<int>(i));
    const auto color = [&](const char* name, int number) {
      return tile.member(name).small_integer(0, number - 1);
    };
    if (coloring == Coloring::edge) {
      tile.only({"id", "north", "east", "south", "west"});
      edge.push_back({color("north", colors.horizontal), color("east", colors.vertical),
                      color("south", colors.horizontal), color("west", colors.vertical)});
    } else {
      tile.only({"id", "nw", "ne", "sw", "se"});
      corner.push_back({color("nw", colors.corner), color("ne", colors.corner), color("sw", colors.corner),
                        color("se", colors.corner)});
    }
  }
  if (coloring == Coloring::edge) return edge;
  return corner;
}

// Cells stand in the order of the tiles' ids, each tile once: Layout relies on it.
template <typename ReadCell>
void read_cells(const JsonCursor& cells, int tiles, ReadCell&& read_cell) {
  cells.array(static_cast<std::size_t>(tiles), static_cast<std::size_t>(tiles));
  for (int i = 0; i < tiles; ++i) {
    const JsonCursor cell = cells.item(static_cast<std::size_t>(i));
    cell.member("tile").small_integer(i, i);
    read_cell(i, cell);
  }
}

Layout read_grid(const JsonCursor& value, LayoutKind kind, int tiles) {
  value.only({"kind", "columns", "rows", "cells"});
  Layout layout;
  layout.kind = kind;
  layout.columns = value.member("columns").small_integer(1, limits::most_tiles);
  layout.rows = value.member("rows").small_integer(1, limits::most_tiles);
  read_cells(value.member("cells"), tiles, [&](int tile, const JsonCursor& cell) {
    cell.only({"tile", "column", "row"});
    layout.cells.push_back({tile, cell.member("column").small_integer(0, layout.columns - 1),
                            cell.member("row").small_integer(0, layout.rows - 1)});
  });
  return layout;
}

Layout read_array(const JsonCursor& value, int tiles, Size tile_size) {
  value.only({"kind", "layers", "border", "cells"});
  value.member("layers").integer(tiles, tiles);
  const JsonCursor border = value.member("border");
  const int half = std::min(tile_size.width, tile_size.height) / 2;
  const int texels = border.small_integer(0, half);
  if ((texels & (texels - 1)) != 0) border.fail(fmt::format("{} is not 0 or a power of two", texels));
  Layout layout = array_layout(tiles, tile_size, texels);
  read_cells(value.member("cells"), tiles, [&](int tile, const JsonCursor& cell) {
    cell.only({"tile", "layer"});
    layout.cells[static_cast<std::size_t>(tile)].row = cell.member("layer").small_integer(0, tiles - 1);
  });
  return layout;
}

// Origin and angle follow from the scheme; a file where they differ was not written for this sampler.
Layout read_rotated(const JsonCursor& value, const TileColors& colors, Size tile_size) {
  const int tiles = tile_count(colors);
  value.only({"kind", "n", "k", "squares", "gutter", "size", "matching", "cells"});
  RotatedScheme scheme;
  scheme.n = value.member("n").small_integer(1, limits::largest_scheme_n);
  scheme.k = value.member("k").small_integer(0, scheme.n);
  scheme.squares = value.member("squares").small_integer(1, 2);
  if (tile_count(scheme) != tiles)
    value.fail(fmt::format("{} is a scheme for {} tiles, and the pack has {}", formula(scheme),
                           tile_count(scheme), tiles));
  if (tile_size.width != tile_size.height)
    value.fail(fmt::format("tiles of {} x {} texels can't be turned; they must be square", tile_size.width,
                           tile_size.height));
  const RotatedLattice lattice(scheme);
  Layout layout;
  layout.kind = LayoutKind::rotated;
  layout.columns = lattice.columns();
  layout.rows = lattice.rows();
  layout.rotated = {scheme, value.member("gutter").small_integer(0, tile_size.width),
                    read_size(value.member("size"), limits::longest_texture_side), Matching::not_found};
  layout.cells.push_back({0, 0, 0});
  const Size size = layout.rotated.size;
  // The corner of the tile in a cell at (0, 0): what the gutter adds to every origin.
  const Placement::Vector inset = placement(layout, 0, tile_size, 0).origin;
  layout.cells.clear();
  read_cells(value.member("cells"), tiles, [&](int tile, const JsonCursor& cell) {
    cell.only({"tile", "origin", "angle"});
    const JsonCursor angle = cell.member("angle");
    if (std::fabs(angle.number(0, 45) - angle_in_degrees(scheme)) > 1e-6)
      angle.fail(fmt::format("{} is not {}, the angle of {}", angle.shown(), angle_in_degrees(scheme),
                             formula(scheme)));
    const JsonCursor origin = cell.member("origin");
    origin.array(2, 2);
    const auto steps = [](double fraction, double inset_fraction, int count) {
      const double exact = (fraction - inset_fraction) * count;
      const double whole = std::floor(exact + 0.5);
      return std::fabs(exact - whole) > 1e-6 ? -1 : wrapped(static_cast<int>(whole), count);
    };
    const int column = steps(origin.item(0).number(0, 1), inset.x / size.width, layout.columns);
    const int row = steps(origin.item(1).number(0, 1), inset.y / size.height, layout.rows);
    if (lattice.site_with(column, row) < 0)
      origin.fail(fmt::format("{} is no place of the scheme {}", origin.shown(), formula(scheme)));
    layout.cells.push_back({tile, column, row});
  });
  if (const auto matching = value.find("matching"))
    layout.rotated.matching = named<Matching>(*matching);
  else if (colors_match(colors, packed_surroundings(layout))) // packs of before the field was written
    layout.rotated.matching = Matching::found;
  return layout;
}

Layout read_layout(const JsonCursor& value, const TileColors& colors, Size tile_size) {
  const int tiles = tile_count(colors);
  const auto kind = named<LayoutKind>(value.member("kind"));
  if (kind == LayoutKind::rotated) return read_rotated(value, colors, tile_size);
  if (kind == LayoutKind::array) return read_array(value, tiles, tile_size);
  return read_grid(value, kind, tiles);
}

// The textures of one map: how its tiles lie in them, and how many there are.
struct Textures {
  Layout layout;
  Size tile_size;
  int levels;
  bool full_chain; // far levels follow
};

LevelFiles read_levels(const JsonCursor& list, const Textures& textures, std::set<std::string>& used) {
  std::vector<Size> sizes;
  for (int l = 0; l < textures.levels; ++l)
    sizes.push_back(texture_size(textures.layout, textures.tile_size, l));
  if (textures.full_chain)
    for (const Size size : far_level_sizes(textures.layout, textures.tile_size, textures.levels))
      sizes.push_back(size);
  list.array(sizes.size(), sizes.size());
  LevelFiles levels;
  for (std::size_t l = 0; l < sizes.size(); ++l) {
    const JsonCursor level = list.item(l);
    level.only({"file", "size"});
    const JsonCursor file = level.member("file");
    const std::string name = file.text();
    if (const std::string fault = file_name_fault(name); !fault.empty())
      file.fail(fmt::format("{} {}; files are named relative to pack.json and lie in its folder",
                            file.shown(), fault));
    if (!used.insert(name).second) file.fail(fmt::format("{} is named twice", file.shown()));
    const JsonCursor size_field = level.member("size");
    const Size size = read_size(size_field, INT32_MAX);
    const Size needed = sizes[l];
    if (size != needed && l >= static_cast<std::size_t>(textures.levels))
      size_field.fail(fmt::format("[{}, {}] is not [{}, {}], half the size of the level before", size.width,
                                  size.height, needed.width, needed.height));
    if (size != needed)
      size_field.fail(
          fmt::format("[{}, {}] is not [{}, {}], the size of the layout with tiles of {} x {} texels",
                      size.width, size.height, needed.width, needed.height, textures.tile_size.width >> l,
                      textures.tile_size.height >> l));
    if (std::int64_t{size.width} * size.height > most_texels_a_level)
      size_field.fail(
          fmt::format("[{}, {}] is more than {} texels", size.width, size.height, most_texels_a_level));
    levels.push_back({name, {size}});
  }
  return levels;
}

std::vector<RoundTrip> read_round_trips(const JsonCursor& value) {
  std::vector<RoundTrip> trips;
  std::vector<std::string> known;
  for (const ResampleFilter filter :
       {ResampleFilter::bilinear, ResampleFilter::bicubic, ResampleFilter::lanczos}) {
    known.emplace_back(name_of(filter));
    const JsonCursor psnr = value.member(known.back());
    trips.push_back({filter, std::nullopt});
    if (!psnr.is_null()) trips.back().psnr = psnr.number(-1000, 1000);
  }
  value.only(known);
  return trips;
}

std::vector<PackedMap> read_maps(const JsonCursor& list, const Textures& textures,
                                 std::vector<LevelFiles>& files, std::set<std::string>& used) {
  std::vector<PackedMap> maps;
  std::set<std::string> names;
  const std::size_t count = list.array(1, limits::most_maps);
  for (std::size_t m = 0; m < count; ++m) {
    const JsonCursor value = list.item(m);
    PackedMap map;
    std::vector<std::string> known{"name",   "role",     "encoding", "depth", "channels",
                                   "levels", "contents", "normal_y", "range"};
    if (textures.layout.kind == LayoutKind::rotated) {
      known.emplace_back("round_trip_psnr");
      if (const auto trips = value.find("round_trip_psnr")) map.round_trips = read_round_trips(*trips);
    }
    value.only(known);
    const JsonCursor name = value.member("name");
    map.name = name.text();
    if (!is_map_name(map.name))
      name.fail(fmt::format("{} is no name of a map: 1 to {} letters, digits, '-' and '_'", name.shown(),
                            limits::longest_map_name));
    if (!names.insert(map.name).second) name.fail(fmt::format("{} stands twice", name.shown()));
    map.role = named<Role>(value.member("role"));
    map.encoding = named<Encoding>(value.member("encoding"));
    map.depth = named<Depth>(value.member("depth"));
    map.channels = value.member("channels").small_integer(1, limits::most_map_channels);
    read_meaning(value, map, map.channels);
    files.push_back(read_levels(value.member("levels"), textures, used));
    maps.push_back(std::move(map));
  }
  return maps;
}

// Rows of digits 0..values-1, one a corner or a cell.
std::vector<int> read_pattern(const JsonCursor& value, int values, const char* of) {
  std::vector<int> pattern;
  value.array(even_pattern_side, even_pattern_side);
  for (std::size_t row = 0; row < even_pattern_side; ++row) {
    const std::string digits = value.item(row).text();
    const auto legal = [&](char digit) { return digit >= '0' && digit < '0' + values; };
    if (digits.size() != even_pattern_side || !std::all_of(digits.begin(), digits.end(), legal))
      value.item(row).fail(fmt::format("{}; a row is {} digits of 0 to {}, one a {}; bake the pack again",
                                       value.item(row).shown(), even_pattern_side, values - 1, of));
    for (const char digit : digits) pattern.push_back(digit - '0');
  }
  return pattern;
}

Mapping read_mapping(const JsonCursor& value, const ColorCounts& colors, std::string& index_file,
                     std::set<std::string>& used) {
  Mapping mapping;
  mapping.kind = named<MappingKind>(value.member("kind"));
  const bool stored = mapping.kind == MappingKind::index;
  const JsonCursor size = value.member("virtual_size");
  const std::int64_t largest = stored ? limits::longest_index_side : limits::longest_virtual_side;
  size.array(2, 2);
  mapping.size = {size.item(0).integer(1, largest), size.item(1).integer(1, largest)};
  switch (mapping.kind) {
  case MappingKind::permutation: {
    value.only({"kind", "virtual_size", "table"});
    const JsonCursor table = value.member("table");
    const std::size_t length = table.array(1, limits::longest_table);
    for (std::size_t i = 0; i < length; ++i)
      mapping.table.push_back(table.item(i).small_integer(0, static_cast<int>(length) - 1));
    break;
  }
  case MappingKind::mix:
    value.only({"kind", "virtual_size", "seed"});
    mapping.seed =
        static_cast<std::uint64_t>(value.member("seed").integer(0, static_cast<std::int64_t>(largest_seed)));
    break;
  case MappingKind::even:
    value.only({"kind", "virtual_size", "seed", "pattern", "variants"});
    mapping.seed =
        static_cast<std::uint64_t>(value.member("seed").integer(0, static_cast<std::int64_t>(largest_seed)));
    if (colors.corner == 0)
      value.member("pattern").fail("of corner colors, but the tiles have edge colors; bake the pack again");
    mapping.table = read_pattern(value.member("pattern"), colors.corner, "corner");
    if (const auto variants = value.find("variants"); variants && colors.variants == 1)
      variants->fail("is there, but each combination of colors has one tile; remove the field");
    if (colors.variants > 1)
      mapping.variants = read_pattern(value.member("variants"), colors.variants, "cell");
    break;
  case MappingKind::index: {
    value.only({"kind", "virtual_size", "file"});
    if (mapping.size.width * mapping.size.height > limits::most_index_cells)
      size.fail(fmt::format("{} x {} cells; an index map has at most {}", mapping.size.width,
                            mapping.size.height, limits::most_index_cells));
    const JsonCursor file = value.member("file");
    index_file = file.text();
    if (const std::string fault = file_name_fault(index_file); !fault.empty())
      file.fail(fmt::format("{} {}; files are named relative to pack.json and lie in its folder",
                            file.shown(), fault));
    if (!used.insert(index_file).second) file.fail(fmt::format("{} is named twice", file.shown()));
    break;
  }
  }
  return mapping;
}

// The hashes answer with colors, and the id follows from them only in a complete set in its usual order.
void check_complete(const JsonCursor& list, const TileColors& tiles, const ColorCounts& colors) {
  const TileColors complete = complete_set(colors);
  if (tiles != complete)
    list.fail(
        fmt::format("holds {} tiles that are not the {} of the complete set in lexicographic order{}; only "
                    "an index mapping can do with others",
                    tile_count(tiles), tile_count(complete),
                    colors.variants > 1 ? ", its variants one after the other" : ""));
}

void read_mips(const JsonCursor& value, Pack& pack) {
  value.only({"filter", "sanitize", "jump_weight", "guard", "tile_levels", "full_chain"});
  const bool box = value.member("filter").one_of({"none", "box"}) == 1;
  const JsonCursor sanitize = value.member("sanitize");
  const std::size_t mode = sanitize.one_of({"none", "edges", "corners", "least-squares"});
  if (!box && mode != 0) sanitize.fail(fmt::format("is {} though \"filter\" is \"none\"", sanitize.shown()));
  pack.mip_mode = box ? static_cast<MipMode>(mode + 1) : MipMode::none;
  if (const auto weight = value.find("jump_weight")) {
    if (pack.mip_mode != MipMode::least_squares)
      weight->fail(fmt::format("is there though \"sanitize\" is {}", sanitize.shown()));
    pack.jump_weight = weight->small_integer(0, limits::most_jump_weight);
  }
  pack.guard = value.member("guard").small_integer(0, std::max(pack.tile_size.width, pack.tile_size.height));
  pack.tile_levels =
      value.member("tile_levels")
          .small_integer(1, box ? levels_held(pack.layout, pack.tile_size, level_count(pack.tile_size)) : 1);
  const auto full = value.find("full_chain");
  pack.full_chain = full && full->boolean();
  if (!box && pack.full_chain) full->fail("is true though \"filter\" is \"none\"");
}

// The corner pack is looked up with the number of a map of the pack, so both hold the same maps.
CornerPack read_corner_pack(const JsonCursor& value, const Pack& pack, std::vector<LevelFiles>& files,
                            std::set<std::string>& used) {
  value.only({"columns", "rows", "width", "maps"});
  if (coloring_of(pack.tiles) == Coloring::corner)
    value.fail("is there, but corner-colored tiles need none; remove the field");
  CornerPack packed;
  const int columns = pack.colors.horizontal * pack.colors.horizontal;
  const int rows = pack.colors.vertical * pack.colors.vertical;
  packed.columns = value.member("columns").small_integer(columns, columns);
  packed.rows = value.member("rows").small_integer(rows, rows);
  const auto width = value.find("width");
  if (!width)
    value.fail("the field \"width\" is missing: how far the pack holds was not measured; bake it again");
  packed.width = width->number(0, 0.5 * std::min(pack.tile_size.width, pack.tile_size.height));
  Layout grid;
  grid.columns = columns;
  grid.rows = rows;
  const JsonCursor maps = value.member("maps");
  maps.array(pack.maps.size(), pack.maps.size());
  packed.maps = read_maps(maps, {grid, pack.tile_size, pack.tile_levels, pack.full_chain}, files, used);
  for (std::size_t m = 0; m < packed.maps.size(); ++m) {
    const PackedMap& here = packed.maps[m];
    const PackedMap& there = pack.maps[m];
    if (static_cast<const MapFormat&>(here) != there || here.channels != there.channels)
      maps.item(m).fail(fmt::format("differs from maps[{}] in name, role, encoding, depth, channels or what "
                                    "its values stand for",
                                    m));
  }
  return packed;
}

// A name a corner color.
std::vector<std::string> read_materials(const JsonCursor& value, const ColorCounts& colors) {
  if (colors.corner < 2)
    value.fail(fmt::format("is there, but materials are corner colors, and there {}; remove the field",
                           colors.corner == 1 ? "is one" : "are none"));
  std::vector<std::string> names;
  const auto count = static_cast<std::size_t>(colors.corner);
  value.array(count, count);
  for (std::size_t i = 0; i < count; ++i) {
    const JsonCursor item = value.item(i);
    const std::string name = item.text();
    if (!is_map_name(name))
      item.fail(fmt::format("{} is no name of a material: 1 to {} letters, digits, '-' and '_'", item.shown(),
                            limits::longest_map_name));
    if (std::find(names.begin(), names.end(), name) != names.end() && names.back() != name)
      item.fail(fmt::format(
          "{} stands apart from where it stood; the colors of a material follow one another", item.shown()));
    names.push_back(name);
  }
  const auto colors_of = [&](const std::string& name) {
    return std::count(names.begin(), names.end(), name);
  };
  for (const std::string& name : names)
    if (colors_of(name) != colors_of(names.front()))
      value.fail(fmt::format("gives {} {} and {} {} of the corner colors; all materials have as many",
                             names.front(), colors_of(names.front()), name, colors_of(name)));
  if (names.front() == names.back()) value.fail("names one material alone, and a transition has several");
  return names;
}

SetFigures read_synthesis(const JsonCursor& value) {
  std::vector<std::string> known;
  SetFigures figures;
  for (const SetFigureField& field : set_figure_fields) {
    known.emplace_back(field.name);
    figures.*field.value = value.member(field.name).number(0, field.most);
  }
  value.only(known);
  return figures;
}

} // namespace

PackDescription parsed_pack_json(std::string_view text, const std::string& file) {
  const JsonCursor root = JsonCursor::parse(text, file);
  const JsonCursor format = root.member("format");
  if (format.is_text() && format.text() == "tilepack-scene")
    format.fail("is \"tilepack-scene\": this is a scene, not a pack; compose draws it");
  format.one_of({"tilepack"});
  const JsonCursor version = root.member("version");
  if (version.is_integer() && version.number(-HUGE_VAL, HUGE_VAL) > 1)
    version.fail(
        fmt::format("is {}, and this program reads 1; read the pack with a newer tilepack, or bake it again",
                    version.shown()));
  version.integer(1, 1);
  root.only({"format", "version", "generator", "tile_size", "coloring", "colors", "variants", "materials",
             "tiles", "layout", "maps", "mapping", "corner_pack", "mips", "synthesis"});
  PackDescription result;
  Pack& pack = result.pack;
  pack.generator = read_generator(root.member("generator"));
  pack.tile_size = read_size(root.member("tile_size"), limits::largest_tile_side);
  const auto coloring = named<Coloring>(root.member("coloring"));
  pack.colors = read_colors(root.member("colors"), coloring);
  if (const auto variants = root.find("variants"))
    pack.colors.variants = variants->small_integer(2, limits::most_variants);
  if (const auto materials = root.find("materials")) pack.materials = read_materials(*materials, pack.colors);
  pack.tiles = read_tiles(root.member("tiles"), coloring, pack.colors);
  pack.layout = read_layout(root.member("layout"), pack.tiles, pack.tile_size);
  read_mips(root.member("mips"), pack);
  std::set<std::string> used{"pack.json"};
  pack.maps = read_maps(root.member("maps"), {pack.layout, pack.tile_size, pack.tile_levels, pack.full_chain},
                        result.map_files, used);
  pack.mapping = read_mapping(root.member("mapping"), pack.colors, result.index_file, used);
  if (pack.mapping.kind != MappingKind::index || pack.colors.variants > 1)
    check_complete(root.member("tiles"), pack.tiles, pack.colors);
  if (const auto corner = root.find("corner_pack"))
    pack.corner_pack = read_corner_pack(*corner, pack, result.corner_files, used);
  if (const auto synthesis = root.find("synthesis")) pack.synthesis = read_synthesis(*synthesis);
  return result;
}

} // namespace tilepack
