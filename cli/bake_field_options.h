#pragma once

#include "options.h"

#include "tilepack/bake/bake_fields.h"

#include <map>
#include <string>

namespace tilepack::cli {

/// A flag or option for `field`, whose value as text goes into `values` under the field's name. Values are
/// checked by bake_options, later; only what --format was meant to be instead is told here. `values` must
/// outlive the parsing.
void add_field_option(Options& options, const BakeField& field, std::map<std::string, std::string>& values);

} // namespace tilepack::cli
