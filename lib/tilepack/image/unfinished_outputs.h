#pragma once

#include <filesystem>
#include <mutex>

namespace tilepack {

/// A file or folder that lies on disk for the time being: a temporary one of an output that isn't finished.
/// While this lives, abandon_unfinished_outputs() removes it.
class UnfinishedOutput {
public:
  UnfinishedOutput() = default;
  /// Whose a folder's content is: of one that was made on the way, others may make use as well, and it is removed
  /// only if it is empty.
  enum class Content { ours, anybodys };

  /// Of something that this process made: under the same StepOnDisk.
  explicit UnfinishedOutput(std::filesystem::path path, Content content = Content::ours);
  ~UnfinishedOutput();
  UnfinishedOutput(UnfinishedOutput&& from) noexcept;
  UnfinishedOutput& operator=(UnfinishedOutput&& from) noexcept;

  const std::filesystem::path& path() const { return on_disk; } ///< empty: none

  /// It has become what it was to be, or was removed.
  void forget();

private:
  std::filesystem::path on_disk;
};

/// Held for a step that is not to be stopped half-way: making what is unfinished, giving names to what is
/// finished. Short, and of one thread.
class StepOnDisk {
public:
  StepOnDisk();

  /// From now on something of what this process makes is where it belongs.
  void puts_in_place();

private:
  std::lock_guard<std::recursive_mutex> guard;
};

/// For a program that has to end at once while threads of it are at work: waits for the end of the step on disk
/// that is being taken, removes all that is unfinished, and lets nobody take such a step again: who tries waits for ever. Says whether outputs had been put in place
/// before.
bool abandon_unfinished_outputs() noexcept;

} // namespace tilepack
