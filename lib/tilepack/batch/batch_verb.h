#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// What a verb makes of the path "output".
enum class BatchOutput {
  pack,    ///< a folder with a pack.json
  file,    ///< a file that the verb itself writes
  printed, ///< a file with what the verb prints on stdout
};

/// One of the things that a verb works from, as the command line's positionals name them.
struct BatchSource {
  std::string_view key; ///< in a manifest: "sample"
  std::string_view
      pattern;          ///< the key with which it is a pattern, one entry for each match: "samples"; or empty
  bool is_pack = false; ///< a pack, which another entry may make
  bool is_list = false; ///< any number of files, in the order given, patterns among them
};

/// A verb that manifests may ask for: what of its arguments is a file. All else of an entry goes to the verb as
/// it would on the command line, so a new verb is a new row here.
struct BatchVerb {
  std::string_view name;
  BatchOutput output = BatchOutput::file;
  std::vector<BatchSource> sources;
  std::vector<std::string_view> files_read = {};    ///< options whose value is a file that is read
  std::vector<std::string_view> files_written = {}; ///< options whose value is a further file that is written
};

std::span<const BatchVerb> batch_verbs();

/// Null if there is none.
const BatchVerb* batch_verb_called(std::string_view name);

/// The names of all, for messages.
std::vector<std::string> batch_verb_names();

/// Options that have no say in the bytes of an output: how many threads, what else is told.
bool is_beside_the_output(std::string_view option);

} // namespace tilepack
