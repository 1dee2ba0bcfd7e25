#pragma once

#include "tilepack/batch/content_hash.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A file by what it is called, not by where it lies, and the hash of its content.
struct HashedFile {
  std::string
      name; ///< of inputs "sample", "map normal", "pack color_0.png"; of outputs relative to their folder
  ContentHash hash;
  bool operator==(const HashedFile&) const = default;
};

/// What decides the bytes of an output.
struct BuildInputs {
  std::string options; ///< lines "KEY=VALUE\n": canonical_options() of a bake, the like of other verbs
  std::vector<HashedFile> files;
  bool operator==(const BuildInputs&) const = default;
};

/// One hash of all of them: the same inputs make the same output, wherever they lie.
ContentHash key_of(const BuildInputs& inputs);

/// What an output was made from and what it was when it was made. Kept in its side file: the one of
/// `packs/rock/pack.json` is `packs/rock/.pack.json.build`, that of `view.png` is `.view.png.build`.
struct BuildRecord {
  BuildInputs inputs;
  std::vector<HashedFile> outputs;
  bool operator==(const BuildRecord&) const = default;
};

/// The file whose side file this is: `output` itself, or the pack.json in it.
std::string side_file_of(const std::string& output, bool is_pack);

std::string record_text(const BuildRecord& record);

/// None if it is no record, or a damaged one.
std::optional<BuildRecord> parsed_record(std::string_view text);

/// None if there is none, or a damaged one.
std::optional<BuildRecord> read_record(const std::string& side_file);

/// Of a list of reasons the first three, and how many there are more: a pack has many files, which mostly change
/// together.
void shorten(std::vector<std::string>& reasons);

/// Why an output with `record` (none: never made) is not what `now` would make, a line each: "sample changed",
/// "option seed: 0 → 3", "tilepack 0.1.0 → 0.2.0". Empty if it is.
std::vector<std::string> differences(const std::optional<BuildRecord>& record, const BuildInputs& now);

} // namespace tilepack
