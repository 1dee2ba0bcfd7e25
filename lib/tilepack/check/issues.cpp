#include "tilepack/check/issues.h"

#include "tilepack/error/field.h"

#include <algorithm>
#include <array>

namespace tilepack {
namespace {

using enum Severity;

constexpr const char* bake_again = "Bake the pack again.";
constexpr const char* not_drawn = "The scene can't be drawn.";
constexpr const char* restore = "Restore the file from the bake, or bake the pack again.";

// Made when first asked for: remedies name options as marked fields.
const auto& rule_table() {
  static const std::array table{
      RuleText{Rule::not_json, error, "pack.json is no JSON", "Nothing can be read from the pack.",
               "Undo the last edit at the place named, or bake the pack again."},
      RuleText{Rule::field_missing, error, "a field is missing", "Programs can't read the pack.",
               "Add the field, or bake the pack again."},
      RuleText{Rule::field_unknown, error, "a field is unknown",
               "A misspelt field would be ignored in silence, so none is allowed.",
               "Correct the name or remove the field."},
      RuleText{Rule::field_type, error, "a field has the wrong type", "Programs can't read the pack.",
               "Write a value of the type named."},
      RuleText{Rule::field_range, error, "a field's value is out of range", "Programs can't read the pack.",
               "Write a value within the range named."},
      RuleText{Rule::fields_disagree, error, "fields contradict each other", "Programs can't read the pack.",
               "Change one of the two to agree with the other."},

      RuleText{Rule::file_missing, error, "a file of the pack is missing", "The level can't be sampled.",
               restore},
      RuleText{Rule::file_unreadable, error, "a file is damaged or no image", "The level can't be sampled.",
               restore},
      RuleText{Rule::file_size, error, "an image has another size than announced",
               "Tiles would be cut at the wrong places.", restore},
      RuleText{Rule::file_channels, error, "an image has another number of channels than announced",
               "Shaders would read the wrong channels.", restore},
      RuleText{Rule::file_depth, error, "an image has another depth than announced",
               "The values are coarser, or the memory is more, than the pack says.", restore},
      RuleText{Rule::file_outside, error, "a file name leads out of the pack's folder",
               "A pack from elsewhere could read files it has no business with.",
               "Use a plain file name inside the folder."},
      RuleText{Rule::file_shared, error, "two levels name the same file",
               "One of them shows the wrong image.", "Give each level its own file."},
      RuleText{Rule::file_stray, note, "a file in the folder is not part of the pack", "It is ignored.",
               "Remove it if it was left by mistake."},

      RuleText{Rule::color_range, error, "a tile has a color that is not among the pack's",
               "No cell of the virtual texture asks for the tile.",
               "Correct the tile's colors or the color counts."},
      RuleText{Rule::tile_repeated, error, "two tiles have the same colors",
               "A hash finds one tile for a set of colors; the other is never seen.",
               "Give each combination of colors to one tile."},
      RuleText{Rule::set_incomplete, error, "a combination of colors has no tile",
               "Cells that ask for it can't be drawn.",
               "Add the tile, or use an index map without such cells."},
      RuleText{Rule::tile_not_placed, error, "a tile is not in the layout exactly once",
               "The tile can't be found in the texture.", bake_again},
      RuleText{Rule::cell_taken_twice, error, "two tiles share a cell",
               "One of them shows the other's image.", bake_again},
      RuleText{Rule::cell_outside, error, "a cell lies outside the layout's grid",
               "The tile can't be found in the texture.", bake_again},
      RuleText{Rule::cell_empty, error, "a cell of the layout holds no tile",
               "Filters that reach into the cell read nothing of the texture.", bake_again},
      RuleText{Rule::border_colors, error,
               "neighbours in the packed texture differ in the color between them",
               "Bilinear filtering shows a seam along the tile's border.",
               "Place the tiles so that shared borders have one color (layout tile-index does)."},
      RuleText{Rule::cell_formula, error, "a tile is not in the cell its colors give",
               "A sampler that computes the cell from the colors fetches another tile.", bake_again},
      RuleText{Rule::tile_order, error, "a tile's id is not the one its colors give in the complete set",
               "A hash computes the id from the colors and fetches another tile.", bake_again},

      RuleText{Rule::not_finite, error, "a texel is NaN or infinite",
               "It spreads over its surroundings when filtered.", "Mend the sample and bake again."},
      RuleText{Rule::not_representable, error, "a texel's value can't be stored at the pack's depth",
               "It would change when written.", "Round the values to the depth."},
      RuleText{Rule::edge_texels, error, "tiles of one edge color differ along that edge",
               "A seam shows where such tiles meet.",
               "Undo the edit of that tile; edit all tiles of the color alike, or bake again."},
      RuleText{Rule::guard_texels, error, "tiles of one edge color differ inside the promised guard band",
               "Filtering is wrong near the border at the levels the guard should cover.",
               "Undo the edit of that tile, or bake again."},
      RuleText{Rule::sanitized_edges, error,
               "at a coarser level, tiles of one edge color differ along that edge",
               "The border pops or shows a seam from a distance.",
               "Build the levels again with " + field("mips", "edges") + "."},
      RuleText{Rule::sanitized_corners, error, "at a coarser level, corner texels differ",
               "Corners flicker from a distance.",
               "Build the levels again with " + field("mips", "corners") + "."},
      RuleText{Rule::edge_texels_unpromised, warning,
               "tiles of one edge color differ along that edge, and no guard is promised",
               "Filtering across the border reads texels of another tile; the pack promises no guard band.",
               "Bake with " + field("guard", "1") + " or more."},
      RuleText{Rule::layer_border, error,
               "the texels round a layer are not those of tiles that may lie there",
               "Filters show a seam along the tile's border.",
               "Undo the edit of that layer or of the tiles beside it, or bake again."},
      RuleText{Rule::fitted_border, error, "at a coarser level, border texels are not the fitted ones",
               "A line between tiles shows from a distance.",
               "Undo the edit of that level, or pack the tiles again with " + field("mips", "least-squares") +
                   "."},

      RuleText{Rule::table_not_permutation, error, "the hash table is no permutation of 0 to n-1",
               "Some colors come up too often, others never.", bake_again},
      RuleText{Rule::table_repeats_rows, warning, "rows of vertical edges repeat within the virtual texture",
               "2y mod n has period n/2 for even n [Wei04, Eq. 2], so the pattern can be seen to repeat.",
               "Use a longer table (twice the height), an odd length, or " + field("mapping", "mix") + "."},
      RuleText{Rule::table_biased, note, "the table's length is no multiple of the number of colors",
               "Some colors come up slightly more often.", "Use a length that is a multiple."},
      RuleText{Rule::index_size, error, "the index map has another size than the virtual texture",
               "Cells have no tile.", bake_again},
      RuleText{Rule::index_id, error, "the index map names a tile that does not exist",
               "The cell can't be drawn.", "Use ids of the pack's tiles."},
      RuleText{Rule::index_colors, error, "neighbours in the index map differ in the color between them",
               "A seam shows between the two cells.", "Choose tiles whose colors agree."},
      RuleText{Rule::virtual_size, error, "the virtual texture's size is out of range",
               "Cells can't be addressed.", "Use sides of 1 to 2^31 tiles."},

      RuleText{Rule::levels_missing, error, "a map has not the levels the pack announces",
               "From a distance the texture aliases, or can't be sampled.", bake_again},
      RuleText{Rule::level_size, error, "a level has not the size of the grid times the tile at that level",
               "Tiles would be cut at the wrong places.", bake_again},
      RuleText{
          Rule::level_stale, warning, "a level does not follow from the finer one",
          "The texture changes as one moves away: a level was edited and the others were not built again.",
          "Build the levels again from level 0."},

      RuleText{Rule::set_poor, Severity::note,
               "the figures of the tiles, found when they were made, are poor",
               "Cuts, borders or repeats of parts can be seen, though all is stored as it should be.",
               "Bake again with what the finding names, or with " + field("apply-advice") + "."},

      RuleText{Rule::scene_not_json, error, "the scene is no JSON", not_drawn,
               "Undo the last edit at the place named."},
      RuleText{Rule::scene_field, error,
               "a field or input is missing, unknown, of the wrong type or out of range", not_drawn,
               "Write what the finding names; SCENES.md has a table a block."},
      RuleText{Rule::scene_block, error, "a block is none that there is", not_drawn,
               "Correct the name; SCENES.md lists the blocks."},
      RuleText{Rule::scene_node, error, "a name is none that the scene has", not_drawn,
               "Correct the name, or add what it names."},
      RuleText{Rule::scene_kind, error, "a node gives another kind of value than the input takes", not_drawn,
               "Name a node of the kind that the finding names."},
      RuleText{Rule::scene_circle, error, "a node is made from itself", not_drawn,
               "Take one of the nodes out of the circle."},
      RuleText{Rule::scene_size, error, "sizes don't divide each other",
               "Cells would begin between texels, or not repeat with the texture.",
               "Change one of the sizes that the finding names."},
      RuleText{Rule::scene_probability, error, "probabilities don't sum to 1",
               "Numbers would come up more or less often than was meant.", "Change one of them."},
      RuleText{Rule::scene_index, error, "numbers go beyond what they choose from",
               "Cells would show nothing.", "Add what is missing, or let the numbers be fewer."},
      RuleText{Rule::scene_stored, error, "a grid is too large to be stored", not_drawn,
               "Take a block that computes its numbers, or a coarser grid."},
      RuleText{Rule::scene_file, error, "a file of the scene is missing or can't be read", not_drawn,
               "Correct the path, which is meant from the folder of the scene, or make the file."},
      RuleText{Rule::scene_file_kind, error, "a file is of another kind than the input takes", not_drawn,
               "Name a file as the finding says, or save it so."},
      RuleText{Rule::scene_unused, Severity::note, "nothing that is shown is made from a node",
               "It is passed over, and its files are not read.", "Remove it if it was left by mistake."},
  };
  return table;
}

} // namespace

std::span<const RuleText> rules() {
  return rule_table();
}

const RuleText& text_of(Rule rule) {
  return *std::find_if(rule_table().begin(), rule_table().end(),
                       [rule](const RuleText& text) { return text.rule == rule; });
}

std::string code_of(Rule rule) {
  return "TP" + std::to_string(static_cast<int>(rule));
}

IssueCounts count(std::span<const Issue> issues) {
  IssueCounts counts;
  for (const Issue& issue : issues) {
    switch (text_of(issue.rule).severity) {
    case Severity::error:
      ++counts.errors;
      break;
    case Severity::warning:
      ++counts.warnings;
      break;
    case Severity::note:
      ++counts.notes;
      break;
    }
  }
  return counts;
}

} // namespace tilepack
