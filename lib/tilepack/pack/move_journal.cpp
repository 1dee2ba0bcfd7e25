#include "tilepack/pack/move_journal.h"

#include "tilepack/pack/file_name.h"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

constexpr const char* journal_name = "moves";

bool is_there(const fs::path& path) {
  std::error_code unused;
  return fs::exists(fs::symlink_status(path, unused));
}

// True if nothing is left to do.
bool move_back(const fs::path& from, const fs::path& to) {
  if (!is_there(from) || is_there(to)) return true;
  std::error_code fault;
  fs::rename(from, to, fault);
  return !fault;
}

} // namespace

// Names, each ended by a zero: the old ones, an empty one, the new ones.
void MoveJournal::write() const {
  std::ofstream stream(container / journal_name, std::ios::binary);
  for (const std::string& name : old_files) stream << name << '\0';
  stream << '\0';
  for (const std::string& name : new_files) stream << name << '\0';
  stream.close();
  if (!stream)
    throw fs::filesystem_error("journal", container / journal_name,
                               std::error_code(EIO, std::system_category()));
}

MoveJournal MoveJournal::read(const fs::path& folder, const fs::path& container) {
  MoveJournal journal{folder, container, {}, {}};
  std::ifstream stream(container / journal_name, std::ios::binary);
  std::string name;
  bool old = true;
  while (std::getline(stream, name, '\0')) {
    if (old && name.empty()) {
      old = false;
    } else if (file_name_fault(name).empty()) { // whoever wrote it
      (old ? journal.old_files : journal.new_files).push_back(name);
    }
  }
  return journal;
}

bool MoveJournal::roll_back() const {
  bool all = true;
  for (auto name = new_files.rbegin(); name != new_files.rend(); ++name)
    all = move_back(folder / *name, staged(*name)) && all;
  for (std::size_t i = old_files.size(); i-- > 0;) all = move_back(retired(i), folder / old_files[i]) && all;
  return all;
}

void MoveJournal::remove() const {
  std::error_code unused;
  fs::remove(container / journal_name, unused);
}

} // namespace tilepack
