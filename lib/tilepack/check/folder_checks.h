#pragma once

#include "tilepack/check/check_report.h"
#include "tilepack/error/progress.h"
#include "tilepack/pack/pack_folder.h"

#include <filesystem>
#include <string>

namespace tilepack {

/// Checks a pack on disk, from its text to its texels, and lists all that is wrong in one go: what one fault
/// makes meaningless is left out, everything else is still looked at.
///
///   1. pack.json is JSON and keeps its schema                     TP101-105
///   2. its fields agree with each other (the reader of packs)      TP106, TP206
///   3. every file it names is there, whole, and as announced       TP201-208, TP401
///   4. the pack as a value keeps all promises: structure_checks.h  TP3xx-6xx
///
/// Throws Error only if there is nothing to check: no pack.json, or it can't be read (cannot_read).
/// A pack that is replaced meanwhile is checked as it was or as it is (PackFolder).
Report check_folder(const std::filesystem::path& folder_or_json, const Progress& progress = {});

/// The same of a folder that is held open, within reading_pack(); the report calls it `called`.
Report check_folder(const PackFolder& folder, const std::string& called, const Progress& progress = {});

} // namespace tilepack
