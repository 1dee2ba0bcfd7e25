#include "tilepack/pack/move_journal.h"

#include "tilepack/pack/file_name.h"

#include <cerrno>
#include <charconv>
#include <fstream>
#include <string_view>
#include <system_error>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

constexpr const char* journal_name = "moves";

bool is_something(const fs::path& path) {
  std::error_code unused;
  return fs::exists(fs::symlink_status(path, unused));
}

// True if nothing is left to do.
bool move_back(const fs::path& from, const fs::path& to) {
  if (!is_something(from) || is_something(to)) return true;
  std::error_code fault;
  fs::rename(from, to, fault);
  return !fault;
}

std::string text_of(const FileId& id) {
  return std::to_string(id.device) + ":" + std::to_string(id.number);
}

std::optional<FileId> parsed_id(std::string_view text) {
  FileId id;
  const char* const end = text.data() + text.size();
  const auto [colon, fault] = std::from_chars(text.data(), end, id.device);
  if (fault != std::errc() || colon == end || *colon != ':') return {};
  const auto [rest, wrong] = std::from_chars(colon + 1, end, id.number);
  if (wrong != std::errc() || rest != end) return {};
  return id;
}

// A pack from elsewhere may bring a journal that was made to lead to somebody's files: a temporary file is called
// as ours are, and lies beside its target.
bool is_part(const FileSwap& swap) {
  const std::string name = swap.part.filename().string(), target = swap.target.filename().string();
  for (int number = 0; number <= most_parts; ++number)
    if (name == part_name(target, number))
      return swap.target.is_absolute() && swap.part.parent_path() == swap.target.parent_path();
  return false;
}

bool next(std::ifstream& stream, std::string& entry) {
  return static_cast<bool>(std::getline(stream, entry, '\0'));
}

} // namespace

// Entries, each ended by a zero. The first character of an entry says what it is; a file beside takes four.
void MoveJournal::write() const {
  const fs::path draft = container / "moves.part";
  std::ofstream stream(draft, std::ios::binary);
  for (const FileSwap& swap : beside)
    stream << 's' << swap.target.string() << '\0' << swap.part.string() << '\0' << text_of(swap.id) << '\0'
           << (swap.replaces ? "replaces" : "new") << '\0';
  for (const std::string& name : old_files) stream << 'o' << name << '\0';
  for (const std::string& name : new_files) stream << 'n' << name << '\0';
  if (whole) stream << 'f' << text_of(*whole) << '\0';
  stream.close();
  if (!stream) throw fs::filesystem_error("journal", draft, std::error_code(EIO, std::system_category()));
  fs::rename(draft, container / journal_name); // so that nobody reads half of it
}

MoveJournal MoveJournal::read(const fs::path& folder, const fs::path& container) {
  MoveJournal journal{folder, container, {}, {}};
  std::ifstream stream(container / journal_name, std::ios::binary);
  std::string entry;
  while (next(stream, entry)) {
    if (entry.empty()) continue;
    const std::string name = entry.substr(1);
    const bool is_name = file_name_fault(name).empty(); // whoever wrote it
    if (entry[0] == 'o' && is_name) journal.old_files.push_back(name);
    if (entry[0] == 'n' && is_name) journal.new_files.push_back(name);
    if (entry[0] == 'f') journal.whole = parsed_id(name);
    std::string part, id, kind;
    if (entry[0] != 's' || !next(stream, part) || !next(stream, id) || !next(stream, kind)) continue;
    FileSwap swap{name, part, parsed_id(id).value_or(FileId{}), kind == "replaces"};
    if (is_part(swap)) journal.beside.push_back(std::move(swap));
  }
  return journal;
}

bool MoveJournal::is_there(const fs::path& container) {
  return is_something(container / journal_name);
}

// pack.json, the last of both, goes first and comes last, and not without the others.
bool MoveJournal::roll_back() const {
  bool all = true;
  for (auto name = new_files.rbegin(); name != new_files.rend(); ++name)
    all = move_back(folder / *name, staged(*name)) && all;
  for (std::size_t i = 0; i < old_files.size(); ++i)
    if (all || i + 1 < old_files.size()) all = move_back(retired(i), folder / old_files[i]) && all;
  for (auto swap = beside.rbegin(); swap != beside.rend(); ++swap) take_back(*swap);
  return all;
}

void MoveJournal::drop_parts() const {
  for (const FileSwap& swap : beside) drop_part(swap);
}

void MoveJournal::remove() const {
  std::error_code unused;
  fs::remove(container / journal_name, unused);
}

} // namespace tilepack
