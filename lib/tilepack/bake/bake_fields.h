#pragma once

#include "tilepack/bake/bake_options.h"
#include "tilepack/error/error.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tilepack {

/// The shapes of values, as a preset writes them in JSON and a command line as text.
enum class BakeFieldType {
  integer, ///< 5
  extent,  ///< 5 or "5x7"; a few fields know words besides
  choice,  ///< one of a list of words
  flag,    ///< true or false
};

/// One option of bake: a flag of the command line ("--" + name), a key of presets, an entry of
/// generator.options. All three, the help and the messages are made from this table, so they can't disagree.
struct BakeField {
  std::string name; ///< "tile-size"
  BakeFieldType type = BakeFieldType::integer;
  std::string value; ///< what help shows in place of a value: "N|WxH|auto"
  std::string help;  ///< one line: meaning, unit, range

  /// Sets the field from text, or throws Error(usage, "", "VALUE is …; it must be …").
  void (*set)(BakeOptions& options, const std::string& text);

  /// The text that `set` turns back into the present value. Empty: unset, and left out of generator.options.
  std::string (*get)(const BakeOptions& options);
};

/// All fields, in the order in which they are set: coloring before what depends on it.
std::span<const BakeField> bake_fields();

/// The names of all fields, for suggestions.
std::vector<std::string> bake_field_names();

/// A value that someone gave for a field.
struct BakeSetting {
  std::string field;                  ///< a name from bake_fields()
  std::string value;                  ///< as on the command line
  std::string where;                  ///< who is to blame in messages: "--guard", "wall.json: guard"
  ErrorKind blame = ErrorKind::usage; ///< kind of the error if the value is no good
};

/// Options with the given settings, of those for one field the last; the rest are defaults. Colors are those
/// of corners unless told otherwise or something is asked for that only edge-colored tiles have (layout
/// tile-index, a corner pack, a sequential set, quilted insides, HxV or more than 4 colors). Defaults follow
/// the coloring: corner-colored packs have 2 colors and the de Bruijn layout, edge-colored ones 2 x 2 and the
/// tile-index layout.
BakeOptions bake_options(std::span<const BakeSetting> settings);

/// Every set field as (name, value), as it would stand on the command line; the seed is left out.
std::vector<std::pair<std::string, std::string>> recorded_options(const BakeOptions& options);

} // namespace tilepack
