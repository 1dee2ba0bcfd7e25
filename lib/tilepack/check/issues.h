#pragma once

#include "tilepack/numeric/enum_names.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

enum class Severity {
  error,   ///< the pack breaks a promise: sampling it gives wrong texels, or can't be done
  warning, ///< the pack works, but not as well as it could
  note,    ///< worth knowing
};

template <>
inline constexpr auto enum_names<Severity> =
    std::array{EnumName{Severity::error, "error"}, EnumName{Severity::warning, "warning"},
               EnumName{Severity::note, "note"}};

/// What can be wrong with a pack or a scene. The numbers are stable: they are printed as TP101 and so on, scripts may
/// rely on them, and a number that goes out of use is never given to another rule.
///
/// 1xx pack.json · 2xx files · 3xx tiles and their places · 4xx texels · 5xx mapping · 6xx levels · 7xx quality ·
/// 8xx scenes
enum class Rule : int {
  not_json = 101,
  field_missing = 102,
  field_unknown = 103,
  field_type = 104,
  field_range = 105,
  fields_disagree = 106,

  file_missing = 201,
  file_unreadable = 202,
  file_size = 203,
  file_channels = 204,
  file_depth = 205,
  file_outside = 206,
  file_shared = 207,
  file_stray = 208,

  color_range = 301,
  tile_repeated = 302,
  set_incomplete = 303,
  tile_not_placed = 304,
  cell_taken_twice = 305,
  cell_outside = 306,
  cell_empty = 307,
  border_colors = 308,
  cell_formula = 309,
  tile_order = 310,

  not_finite = 401,
  not_representable = 402,
  edge_texels = 403,
  guard_texels = 404,
  sanitized_edges = 405,
  sanitized_corners = 406,
  edge_texels_unpromised = 407,
  layer_border = 408,
  fitted_border = 409,

  table_not_permutation = 501,
  table_repeats_rows = 502,
  table_biased = 503,
  index_size = 504,
  index_id = 505,
  index_colors = 506,
  virtual_size = 507,

  levels_missing = 601,
  level_size = 602,
  level_stale = 603,

  set_poor = 701,

  scene_not_json = 801,
  scene_field = 802,
  scene_block = 803,
  scene_node = 804,
  scene_kind = 805,
  scene_circle = 806,
  scene_size = 807,
  scene_probability = 808,
  scene_index = 809,
  scene_stored = 810,
  scene_file = 811,
  scene_file_kind = 812,
  scene_unused = 813,
};

/// All there is to say about a rule without looking at a pack.
struct RuleText {
  Rule rule = Rule::not_json;
  Severity severity = Severity::error;
  std::string_view summary; ///< what is wrong, one clause
  std::string_view why;     ///< what the user would see
  std::string remedy;       ///< the way out; options as marked fields (error/field.h)
};

/// Every rule, in the order of their numbers: the one table that reports, `--list-rules` and the
/// documentation are made from.
std::span<const RuleText> rules();

const RuleText& text_of(Rule rule);
std::string code_of(Rule rule); ///< "TP101"

/// One finding.
struct Issue {
  Rule rule = Rule::not_json;
  std::string where;    ///< file, JSON path, tile, cell or texel
  std::string found;    ///< the offending value
  std::string expected; ///< the value or range that would do
  bool operator==(const Issue&) const = default;
};

struct IssueCounts {
  int errors = 0;
  int warnings = 0;
  int notes = 0;
};

IssueCounts count(std::span<const Issue> issues);

} // namespace tilepack
