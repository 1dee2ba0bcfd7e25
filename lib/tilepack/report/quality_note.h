#pragma once

#include "tilepack/check/check_report.h"
#include "tilepack/pack/pack.h"

namespace tilepack {

/// Adds what the pack's own figures say (Pack::synthesis) to the report on a pack that keeps its promises: a note
/// (TP701) for each thing that is poor. Packs of hand-drawn tiles hold no figures.
void note_quality(const Pack& pack, Report& report);

} // namespace tilepack
