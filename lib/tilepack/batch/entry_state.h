#pragma once

#include "tilepack/batch/build_record.h"
#include "tilepack/batch/manifest.h"

#include <optional>
#include <string>
#include <vector>

namespace tilepack {

/// A file that decides an output, and what messages call it.
struct EntryInput {
  std::string name; ///< "sample", "map normal", "tile 3", "pack color_0.png"
  std::string file;
};

/// Every file whose content decides the output of an entry: maps, tiles, meshes, all files of a pack. A preset
/// is no such file: what it says is among the options. Throws as maps_of() does, and Error (cannot_read) for a
/// pack that is not there.
std::vector<EntryInput> inputs_of(const Manifest& manifest, const BatchEntry& entry);

/// All of inputs_of(), the preset if it is a file, and the folders whose list of files had a say.
std::vector<std::string> looked_at(const BatchEntry& entry, const std::vector<EntryInput>& inputs);

/// Options in the one form that stands for all ways to write them.
std::string canonical_options_of(const Manifest& manifest, const BatchEntry& entry);

/// How an output stands to what would be made now.
struct EntryState {
  BuildInputs inputs;
  std::vector<EntryInput> input_files;
  std::optional<BuildRecord> record; ///< of what is there
  std::vector<std::string> reasons;  ///< why it must be made; empty: it is current
};

/// Reads every input and every output. Throws Error where the entry can't be built: a missing input, a bad option.
EntryState state_of(const Manifest& manifest, const BatchEntry& entry);

/// The files of an output that has been made, with their hashes: those of a pack, pack.json last, or the one file.
std::vector<HashedFile> made_files(const BatchEntry& entry);

/// Writes the side file of an output that was just made. Throws Error (cannot_write).
void write_record(const BatchEntry& entry, const BuildRecord& record);

/// The folder that names of outputs are relative to.
std::string folder_of_output(const BatchEntry& entry);

/// Removes what killed writers of a pack left in it and of its folder. To be called with its lock held.
void remove_left_overs(const BatchEntry& entry);

/// Takes away what is left of a pack whose pack.json is gone or broken, if all of it was made by a batch: a pack
/// is not written over files of others, which these would be taken for. Leaves everything else alone.
void clear_broken_pack(const BatchEntry& entry);

} // namespace tilepack
