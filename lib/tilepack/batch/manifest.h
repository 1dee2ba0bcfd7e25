#pragma once

#include "tilepack/bake/bake_job.h"
#include "tilepack/batch/batch_entry.h"
#include "tilepack/json/json_line.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A file that lists what is to be made:
///
///   { "format": "tilepack-manifest", "version": 1,
///     "defaults": { "preset": "terrain", "options": {"tile-size": 64}, "verbs": {"render": {"scale": 0.5}} },
///     "jobs": [
///       { "name": "gravel", "sample": "gravel.png", "maps": {"normal": "gravel_n.png"}, "output": "packs/gravel" },
///       { "samples": "textures/*.png", "options": {"seed": 7}, "output": "packs/{stem}" },
///       { "transition": ["sand.png", "grass.png"], "output": "packs/shore" },
///       { "verb": "render", "packs": "packs/*", "output": "previews/{stem}.png" } ] }
///
/// manifest.schema.json describes it field by field. "verb" is "bake" unless given; the preset and the options of
/// "defaults" are for bakes, those of its "verbs" for each verb. An entry without a name is called like its output
/// as written. With a pattern, an entry stands for one entry a match: {stem} is the name of what matched without
/// its ending, {folder} that of the folder that it lies in. Patterns of packs match the outputs of other entries
/// and, where none does, packs on disk.
struct Manifest {
  std::string file;
  std::string text;
  std::vector<BatchEntry> entries;
  std::vector<std::string> folders;       ///< that patterns looked through
  std::shared_ptr<const JsonLines> lines; ///< of the text
};

/// Reads and expands. Throws Error: cannot_read for a missing file or a pattern without a match, invalid_content
/// for what breaks a rule, with `where` = "FILE:LINE: PLACE". Whether options are good is not looked at.
Manifest read_manifest(const std::string& file);

/// The same of a text, for `file`, whose folder is what paths are relative to.
Manifest parsed_manifest(std::string text, const std::string& file);

/// "FILE:LINE" of a place such as BatchEntry::at.
std::string place_in(const Manifest& manifest, std::string_view at);

/// The bake that an entry of that verb asks for, its settings with their places. Throws Error (invalid_content)
/// for an option that bakes don't have.
BakeJob bake_job_of(const Manifest& manifest, const BatchEntry& entry);

} // namespace tilepack
