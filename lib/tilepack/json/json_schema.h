#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A place in a JSON document that breaks its schema.
struct SchemaProblem {
  enum class Kind {
    no_json, ///< the text can't be parsed; the only problem then
    missing,
    unknown,
    type,
    range, ///< of a number or of the length of an array or text, or none of the values allowed
  };
  Kind kind = Kind::no_json;
  std::string where; ///< "maps[0].levels[2].size"; empty for the document itself
  std::string found; ///< the value, shortened
  std::string expected;
  bool operator==(const SchemaProblem&) const = default;
};

/// All places where `document` breaks `schema`, in the order of the document, at most 1000.
///
/// A JSON Schema of these keywords: type, const, enum, required, properties, additionalProperties, items,
/// minItems, maxItems, minimum, maximum, minLength, maxLength, oneOf, allOf, if/then/else and $ref within the
/// schema; others are passed over (a test checks that pack.schema.json has none but `pattern`, which the
/// reader of packs has its own words for). Of oneOf the alternative with the fewest problems speaks.
///
/// Our own, and not Valijson's, which Debian packages and which knows more keywords: it names the place and the
/// rule, but neither the value found nor the values allowed ("Failed to match against any enum values"), takes
/// every alternative of a oneOf to task, and repeats each problem at every level above it.
///
/// The schema must be sound: it is the library's own. The document may hold anything.
std::vector<SchemaProblem> schema_problems(std::string_view document, std::string_view schema);

} // namespace tilepack
