#include "tilepack/image/unfinished_outputs.h"

#include <system_error>
#include <utility>
#include <vector>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

struct Entry {
  fs::path path;
  UnfinishedOutput::Content content;
};

// What the process has on disk is one thing for all of it, as the disk is.
struct Registry {
  std::recursive_mutex mutex;
  std::vector<Entry> entries; // in the order they were made
  bool something_is_in_place = false;
};

Registry& registry() {
  static auto* const only = new Registry; // outlives every thread
  return *only;
}

void remove_for_good(const Entry& entry) {
  std::error_code fault;
  if (entry.content == UnfinishedOutput::Content::anybodys) {
    fs::remove(entry.path, fault);
    return;
  }
  // Threads may be making files in it meanwhile.
  constexpr int most_attempts = 50;
  for (int i = 0; i < most_attempts && fs::exists(fs::symlink_status(entry.path, fault)); ++i)
    fs::remove_all(entry.path, fault);
}

} // namespace

UnfinishedOutput::UnfinishedOutput(fs::path path, Content content) : on_disk(std::move(path)) {
  const std::lock_guard guard(registry().mutex);
  std::error_code fault;
  if (fs::path whole = fs::absolute(on_disk, fault); !fault) on_disk = std::move(whole);
  registry().entries.push_back({on_disk, content});
}

UnfinishedOutput::~UnfinishedOutput() {
  forget();
}

UnfinishedOutput::UnfinishedOutput(UnfinishedOutput&& from) noexcept
    : on_disk(std::exchange(from.on_disk, {})) {}

UnfinishedOutput& UnfinishedOutput::operator=(UnfinishedOutput&& from) noexcept {
  if (this == &from) return *this;
  forget();
  on_disk = std::exchange(from.on_disk, {});
  return *this;
}

void UnfinishedOutput::forget() {
  if (on_disk.empty()) return;
  const std::lock_guard guard(registry().mutex);
  std::erase_if(registry().entries, [&](const Entry& entry) { return entry.path == on_disk; });
  on_disk.clear();
}

StepOnDisk::StepOnDisk() : guard(registry().mutex) {}

void StepOnDisk::puts_in_place() {
  registry().something_is_in_place = true;
}

bool abandon_unfinished_outputs() noexcept {
  Registry& all = registry();
  all.mutex.lock(); // and never unlocked
  for (auto entry = all.entries.rbegin(); entry != all.entries.rend(); ++entry) remove_for_good(*entry);
  return all.something_is_in_place;
}

} // namespace tilepack
