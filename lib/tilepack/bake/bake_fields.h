#pragma once

#include "tilepack/bake/field_value.h"
#include "tilepack/error/error.h"

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tilepack {

/// What a field has a say in.
enum class FieldScope {
  tiles,    ///< how tiles are made from a sample
  packing,  ///< how finished tiles are packed, whoever made them
  material, ///< how coarser levels of one map follow another of the material
};

/// One option of bake: an option of the command line, a key of presets and manifests, an entry of
/// generator.options. All of them, the help and the messages are made from this table, so they can't disagree.
struct BakeField : FieldValue {
  std::string name; ///< "tile-size"
  FieldScope scope;
  std::string help; ///< one line: meaning, unit, range

  BakeField(std::string called, FieldScope concerns, FieldValue access, std::string text)
      : FieldValue(std::move(access)), name(std::move(called)), scope(concerns), help(std::move(text)) {}
};

/// All fields, in the order in which they are set: coloring before what depends on it.
std::span<const BakeField> bake_fields();

/// Those of scope packing: all that tiles drawn by hand have use for.
std::vector<BakeField> packing_fields();

/// The names of all fields, for suggestions.
std::vector<std::string> bake_field_names();

/// The name that a field has now: "image-format" for "format", as it was called; any other name is its own.
/// Settings under either name are one field's.
std::string_view field_name_now(std::string_view name);

/// A value that someone gave for a field.
struct BakeSetting {
  std::string field; ///< a name from bake_fields()
  std::string value; ///< as on the command line
  std::string where; ///< where it stands, for messages: field("guard"), "wall.json: \"guard\""
  ErrorKind kind = ErrorKind::usage; ///< of the error if the value is no good
};

/// The setting that holds for `field`, the last one; null if there is none.
const BakeSetting* setting_of(std::span<const BakeSetting> settings, std::string_view field);

/// `error`, and if it blames a field that was set, then with the place and kind of that setting in place of the
/// field's name.
Error blamed(const Error& error, std::span<const BakeSetting> settings);

/// The same of a bake that is told of at `place`, "FILE:LINE" of a manifest: fields that no setting names are blamed on it.
/// Empty: there is none, and they are as they were.
Error blamed(const Error& error, std::string_view place, std::span<const BakeSetting> settings);

/// Options with the given settings, of those for one field the last; the rest are defaults. Colors are those
/// of corners unless told otherwise or something is asked for that only edge-colored tiles have (layout
/// tile-index, a corner pack, a sequential set, quilted insides, HxV or more than 4 colors). Defaults follow
/// the coloring: corner-colored packs have 2 colors and the de Bruijn layout, edge-colored ones 2 x 2 and the
/// tile-index layout. Tiles have the size that suits the sample unless one is set. Throws Error, blamed on the
/// setting.
BakeOptions bake_options(std::span<const BakeSetting> settings);

/// Every set one of `fields` as (name, value), as it would stand on the command line; the seed is left out.
std::vector<std::pair<std::string, std::string>>
recorded_options(const BakeOptions& options, std::span<const BakeField> fields = bake_fields());

} // namespace tilepack
