#pragma once

#include "tilepack/bake/bake_job.h"
#include "tilepack/pack/pack_json.h"
#include "tilepack/report/bake_page.h"

#include <string>

namespace tilepack::cli {

/// "pebbles.png", or "pebbles.png to sand.png".
std::string title_of(const BakeJob& job);

/// What bake and pack print on stdout when they are done: what was made, where, and of a synthesized set how
/// good it is. No times, so that it repeats. Text leaves out what is good.
std::string bake_report_text(const PackDescription& made, const std::string& folder,
                             const BakeFacts* facts = nullptr);

/// The lines of it about how good a set is.
std::string verdict_text(const BakeFacts& facts);

} // namespace tilepack::cli
