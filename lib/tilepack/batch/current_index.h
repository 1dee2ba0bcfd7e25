#pragma once

#include "tilepack/batch/content_hash.h"

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// Which outputs were found to be current, and the state of the files that this was seen in: so that a batch of
/// which nothing changed looks at files without reading them.
///
/// Nothing is decided by time. A note holds while inode, size and both times of change of every file are what they
/// were, of which the kernel sets the last itself; whenever one differs, contents are read and compared. A file
/// that changed shortly before or while it was read is not noted at all, for it could change again without a
/// difference in its times (the race of git's index).
///
/// Kept in a file beside the manifest that may be deleted at any time; a damaged one is taken for none.
class CurrentIndex {
public:
  /// `file` need not exist, and its folder not be writable.
  explicit CurrentIndex(std::string file);

  /// Whether `output`, asked for by a request with that hash, was current and no file changed since. Safe to be
  /// called by several threads.
  bool holds(const std::string& output, const ContentHash& request) const;

  /// Notes that it is current, as `files` are now; forgets it if that can't be relied on. They were read after
  /// this index was made, and not changed by us since. Safe to be called by several threads.
  void note(const std::string& output, const ContentHash& request, const std::vector<std::string>& files);

  /// Notes that a manifest, asked for as a whole by a request with that hash, comes to `outputs` as long as the
  /// files in `folders` stay the same ones. Only if each of them has a note.
  void note_all(const ContentHash& request, const std::vector<std::string>& outputs,
                const std::vector<std::string>& folders);

  /// How many outputs it comes to, if all of them are current and nothing changed since.
  std::optional<std::size_t> all_hold(const ContentHash& request) const;

  /// Forgets the outputs that are not in `outputs`, and stores the rest if something changed. Where the file can't
  /// be written nothing is kept.
  void store(const std::vector<std::string>& outputs);

private:
  struct Note {
    ContentHash request;
    std::string files; // as they stand in the file of the index
    ContentHash state; // of all of them together
  };
  bool holds(const Note& note) const;
  std::string text() const;
  void read(std::string_view bytes);

  std::string file;
  std::map<std::string, Note, std::less<>> notes; // by output; without one, that of all of them
  std::int64_t began = 0;                         // nanoseconds by the clock of the file system
  bool changed = false;
  mutable std::mutex mutex;
};

/// Where the index of a manifest lies.
std::string index_file_of(const std::string& manifest);

} // namespace tilepack
