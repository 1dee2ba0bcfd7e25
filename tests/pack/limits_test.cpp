#include "tilepack/image/image_file.h"
#include "tilepack/pack/pack_schema.h"
#include "tilepack/sampler/render.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>
#include <fstream>
#include <regex>
#include <sstream>

using namespace tilepack;
using nlohmann::json;

namespace {

const json& schema() {
  static const json parsed = json::parse(pack_schema());
  return parsed;
}

std::string format_page() {
  std::ifstream file(TILEPACK_SOURCE_DIR "/lib/tilepack/pack/FORMAT.md");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The number that `pattern` finds in the page, its one group: 123, 2^31, 2^53 − 1, 1e9.
std::int64_t said(const std::string& page, const std::string& pattern) {
  std::smatch found;
  INFO(pattern);
  REQUIRE(std::regex_search(page, found, std::regex(pattern)));
  const std::string number = found[1];
  const bool power = number.rfind("2^", 0) == 0;
  const std::int64_t value = power ? std::int64_t{1} << std::stoi(number.substr(2)) : std::stoll(number);
  return number.find("\u2212 1") != std::string::npos ? value - 1 : value;
}

int levels_of(int side) {
  int levels = 1;
  for (; side % 2 == 0; side /= 2) ++levels;
  return levels;
}

} // namespace

TEST_CASE("the schema's numbers are the limits of the library", "[pack]") {
  struct Row {
    const char* place;
    std::int64_t limit;
  };
  using namespace limits;
  for (const Row& row : std::vector<Row>{
           {"/$defs/tile_size/items/maximum", largest_tile_side},
           {"/$defs/color_count/maximum", most_edge_colors},
           {"/$defs/color/maximum", most_edge_colors - 1},
           {"/$defs/corner_colors/properties/corner/maximum", most_corner_colors},
           {"/$defs/corner_color/maximum", most_corner_colors - 1},
           {"/properties/variants/maximum", most_variants},
           {"/properties/tiles/maxItems", most_tiles},
           {"/$defs/edge_tile/properties/id/maximum", most_tiles - 1},
           {"/$defs/corner_tile/properties/id/maximum", most_tiles - 1},
           {"/$defs/tile_id/maximum", most_tiles - 1},
           {"/$defs/grid_layout/properties/columns/maximum", most_tiles},
           {"/$defs/grid_layout/properties/rows/maximum", most_tiles},
           {"/$defs/grid_layout/properties/cells/maxItems", most_tiles},
           {"/$defs/grid_layout/properties/cells/items/properties/column/maximum", most_tiles - 1},
           {"/$defs/grid_layout/properties/cells/items/properties/row/maximum", most_tiles - 1},
           {"/$defs/array_layout/properties/layers/maximum", most_tiles},
           {"/$defs/array_layout/properties/border/maximum", largest_layer_border},
           {"/$defs/array_layout/properties/cells/maxItems", most_tiles},
           {"/$defs/array_layout/properties/cells/items/properties/layer/maximum", most_tiles - 1},
           {"/$defs/rotated_layout/properties/n/maximum", largest_scheme_n},
           {"/$defs/rotated_layout/properties/k/maximum", largest_scheme_n},
           {"/$defs/rotated_layout/properties/gutter/maximum", largest_gutter},
           {"/$defs/rotated_layout/properties/cells/maxItems", most_tiles},
           {"/$defs/maps/maxItems", most_maps},
           {"/$defs/maps/items/properties/channels/maximum", most_map_channels},
           {"/$defs/maps/items/properties/levels/maxItems", most_chain_levels},
           {"/$defs/mips/properties/tile_levels/maximum", most_levels},
           {"/$defs/mips/properties/guard/maximum", largest_tile_side},
           {"/$defs/mips/properties/jump_weight/maximum", most_jump_weight},
           {"/$defs/virtual_size/items/maximum", longest_virtual_side},
           {"/$defs/index/properties/virtual_size/items/maximum", longest_index_side},
           {"/$defs/permutation/properties/table/maxItems", longest_table},
           {"/$defs/permutation/properties/table/items/maximum", longest_table - 1},
           {"/$defs/seed/maximum", static_cast<std::int64_t>(largest_seed)},
           {"/$defs/corner_pack/properties/columns/maximum", most_color_pairs},
           {"/$defs/corner_pack/properties/rows/maximum", most_color_pairs},
           {"/$defs/corner_pack/properties/width/maximum", largest_tile_side / 2},
           {"/$defs/synthesis/properties/distinct_tiles/maximum", most_tiles},
       }) {
    INFO(row.place);
    REQUIRE(schema().contains(json::json_pointer(row.place)));
    CHECK(schema()[json::json_pointer(row.place)].get<std::int64_t>() == row.limit);
  }
  CHECK(schema()[json::json_pointer("/$defs/maps/items/properties/name/pattern")] ==
        fmt::format("^[A-Za-z0-9_-]{{1,{}}}$", longest_map_name));
  CHECK(schema()[json::json_pointer("/$defs/even/properties/pattern/items/pattern")] ==
        fmt::format("^[0-{}]{{64}}$", most_corner_colors - 1));
  CHECK(schema()[json::json_pointer("/$defs/even/properties/variants/items/pattern")] ==
        fmt::format("^[0-{}]{{64}}$", most_variants - 1));
}

TEST_CASE("FORMAT.md tells the limits of the library", "[pack]") {
  using namespace limits;
  const std::string page = format_page();
  const std::string number = "(2\\^[0-9]+(?: \u2212 1)?|[0-9]+)";
  CHECK(said(page, "virtual texture of up to " + number + " ") == longest_virtual_side);
  CHECK(said(page, "generator.seed` \\| 0 to " + number) == static_cast<std::int64_t>(largest_seed));
  CHECK(said(page, "`tile_size` \\| two of 1 to " + number) == largest_tile_side);
  CHECK(said(page, "horizontal, vertical\\}`, 1 to " + number) == most_edge_colors);
  CHECK(said(page, "`\\{corner\\}`, 1 to " + number) == most_corner_colors);
  CHECK(said(page, "`variants` \\| 2 to " + number) == most_variants);
  CHECK(said(page, "`tiles` \\| 1 to " + number) == most_tiles);
  CHECK(said(page, "`maps` \\| 1 to " + number) == most_maps);
  CHECK(said(page, "`name` \\| 1 to " + number) == longest_map_name);
  CHECK(said(page, "`channels` \\| 1 to " + number) == most_map_channels);
  CHECK(said(page, "2\\^level\\), at most " + number + " texels") == most_texels_a_level);
  CHECK(said(page, "texels and " + number + " a side") == longest_texture_side);
  CHECK(said(page, "`virtual_size` in tiles, 1 to " + number) == longest_virtual_side);
  CHECK(said(page, "`index`: " + number) == longest_index_side);
  CHECK(said(page, "P of n = 1 to " + number + " entries") == longest_table);
  CHECK(said(page, "`seed`, 0 to " + number) == static_cast<std::int64_t>(largest_seed));
  CHECK(said(page, "`even`, for 2 to " + number + " corner colors") == most_corner_colors);
  CHECK(said(page, "of `virtual_size` texels, at most " + number) == most_index_cells);
  CHECK(said(page, "`jump_weight` \\| 0 to " + number) == most_jump_weight);
  CHECK(said(page, "`tile_levels` \\| 1 to " + number) == most_levels);
  CHECK(said(page, "`distinct_tiles` \\| 0 to " + number) == most_tiles);
}

TEST_CASE("limits that follow from one another do", "[pack]") {
  CHECK(levels_of(limits::largest_tile_side) == limits::most_levels);
  CHECK(limits::largest_scheme_n * limits::largest_scheme_n == limits::most_tiles);
  CHECK(limits::longest_texture_side == max_image_side);
  CHECK(limits::longest_texture_side == max_render_side);
  CHECK(limits::longest_table >= 2 * limits::longest_permutation_side_made + limits::most_edge_colors * 7);
}
