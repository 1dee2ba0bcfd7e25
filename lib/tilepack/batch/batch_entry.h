#pragma once

#include "tilepack/bake/material_files.h"
#include "tilepack/batch/batch_verb.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tilepack {

/// An option of an entry, as the command line would have it.
struct BatchOption {
  std::string name;                ///< "tile-size"
  std::vector<std::string> values; ///< one, or several of an option that may be repeated; paths are resolved
  bool is_flag = false;            ///< on or off: its value is "true" or "false"
  std::string at;                  ///< in the manifest: "jobs[3].options.tile-size"
};

/// One output to be made, as a manifest asks for it, patterns put in place of what they match. Paths are resolved:
/// relative ones of the manifest stand behind its folder.
struct BatchEntry {
  std::string name; ///< unique
  const BatchVerb* verb = nullptr;
  std::vector<std::string> sources; ///< the positionals of the verb, in order
  bool is_transition = false;       ///< a bake whose sources are materials, which its tiles lead between
  std::vector<MaterialFile> maps;   ///< of a bake
  std::string preset;               ///< of a bake; empty: none
  std::vector<BatchOption> options; ///< those of "defaults" that the entry does not override, then its own
  std::string output;
  std::string at;                 ///< in the manifest: "jobs[3]"
  std::vector<std::size_t> after; ///< entries, by number, whose outputs this one works from
};

/// Whether what it works from is a scene, whose packs and pictures are read too: of compose always, of verbs that work
/// from a pack where there is a scene on disk in its place.
bool shows_scene(const BatchEntry& entry);

} // namespace tilepack
