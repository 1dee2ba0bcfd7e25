#pragma once

#include "tilepack/json/json_cursor.h"
#include "tilepack/numeric/enum_names.h"

namespace tilepack {

/// The enumerator whose name stands at `value`; any other text fails there, with the names that are allowed.
template <NamedEnum Enum>
Enum named(const JsonCursor& value) {
  return enum_names<Enum>[value.one_of(names_of<Enum>())].value;
}

} // namespace tilepack
