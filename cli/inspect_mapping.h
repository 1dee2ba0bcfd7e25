#pragma once

#include "console.h"

#include "tilepack/pack/pack.h"
#include "tilepack/report/vector_drawing.h"

#include <string>

namespace tilepack::cli {

/// What `tilepack inspect --mapping` shows: the statistics of the pack's mapping beside those of tables of 8
/// to 4096 entries and of the mixing hash, as text or JSON.
std::string mapping_report(const Pack& pack, const std::string& format);

/// The same as pictures, a pixel block a cell, each tile its own color: the pack's own first, then the others
/// in the order of the report. Tables have their number of entries below.
VectorDrawing mapping_drawing(const Pack& pack);

} // namespace tilepack::cli
