#pragma once

#include "tilepack/batch/current_index.h"
#include "tilepack/batch/entry_state.h"
#include "tilepack/batch/manifest.h"
#include "tilepack/batch/output_lock.h"
#include "tilepack/error/error.h"
#include "tilepack/error/progress.h"
#include "tilepack/numeric/enum_names.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// What a batch is to do beyond its manifest.
struct BatchSettings {
  int jobs = 0;                ///< threads of all entries together; 0: as many as the machine has
  std::int64_t memory = 0;     ///< bytes of all entries that run beside each other; 0: no limit
  std::string cache = {};      ///< folder of finished outputs; empty: none
  std::int64_t cache_size = 0; ///< bytes that the cache may hold at the end; 0: no limit
  bool all = false;            ///< make current outputs too
  WhenBusy when_busy = WhenBusy::wait;
};

enum class EntryEnd {
  current,  ///< there was nothing to do
  built,    ///< it was made
  restored, ///< it came from the cache
  failed,
  skipped, ///< something that it is made from failed
};

template <>
inline constexpr auto enum_names<EntryEnd> =
    std::array{EnumName{EntryEnd::current, "current"}, EnumName{EntryEnd::built, "built"},
               EnumName{EntryEnd::restored, "restored"}, EnumName{EntryEnd::failed, "failed"},
               EnumName{EntryEnd::skipped, "skipped"}};

/// What there is to say of an output that was made.
struct EntryStory {
  std::string verdict = {};              ///< on a bake: "good", "fair" or "poor"; else empty
  std::vector<std::string> remarks = {}; ///< why it is not good, the worst first, fields marked
  std::vector<std::string> notes = {};   ///< that the verb made, fields marked
};

/// How an entry came out.
struct EntryResult {
  std::size_t entry = 0; ///< its number in the manifest
  EntryEnd end = EntryEnd::current;
  std::vector<std::string> reasons;     ///< why it was to be made
  std::string message;                  ///< of a failure, with marked fields
  ErrorKind kind = ErrorKind::internal; ///< of a failure
  EntryStory story;                     ///< if it was built
  double seconds = 0;
  std::int64_t peak_memory = 0; ///< bytes that the process has held at most until then
};

/// Who does the work that the library has no function for, and who wants to know how a batch gets on. Calls come
/// from several threads at a time.
struct BatchWatch {
  /// Makes the output of an entry, all or nothing; throws where it can't.
  std::function<EntryStory(const Manifest& manifest, const BatchEntry& entry, const Progress& progress)> make;

  std::function<void(std::size_t entry, const std::vector<std::string>& reasons)> started = {};
  /// May throw to end the batch: what runs is undone, nothing more begins.
  std::function<void(std::size_t entry, std::string_view stage, double done)> progress = {};
  std::function<void(const EntryResult& result)> ended = {};
  std::function<void(std::size_t entry, std::string_view message)> warned =
      {}; ///< no failure: a cache on a full disk
};

/// Thrown by a watch to end a batch; not an Error, since nothing went wrong.
struct BatchCancelled {};

/// How many entries a manifest has, if a run found all of them current and nothing changed since; found out without
/// reading what it says. Throws Error (cannot_read).
std::optional<std::size_t> entries_if_all_current(const std::string& manifest);

/// Makes those of `chosen` entries, and of those that they are made from, whose outputs are not current: whose
/// inputs, options or outputs have another content than when they were made, or that were made by another version.
/// Goes on after a failure with all that does not hang on it. Results are in the order of the manifest, of all
/// that was looked at. Throws what `watch` throws, and before anything is made what check_written_files() throws.
std::vector<EntryResult> run_batch(const Manifest& manifest, const std::vector<std::size_t>& chosen,
                                   const BatchSettings& settings, const BatchWatch& watch);

/// What run_batch would do, without doing it: results with reasons, `built` for what would be made. What is made
/// from something that would be made counts too ("pack packs/a is made again").
std::vector<EntryResult> planned_batch(const Manifest& manifest, const std::vector<std::size_t>& chosen,
                                       const BatchSettings& settings);

/// Every file that the entries read, each once, and the folders whose list of files counts. Those of entries that
/// can't be looked through are left out.
std::vector<std::string> files_read(const Manifest& manifest, const std::vector<std::size_t>& chosen);

} // namespace tilepack
