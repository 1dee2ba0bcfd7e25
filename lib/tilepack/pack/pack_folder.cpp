#include "tilepack/pack/pack_folder.h"

#include "tilepack/pack/file_name.h"
#include "tilepack/pack/staging_container.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

constexpr off_t largest_json = off_t{16} << 20;

// A writer that moves files one by one does nothing else in between; one that exchanges folders needs no wait.
constexpr int most_openings = 400;
constexpr std::chrono::milliseconds between_openings{10};

FileId id_of(const struct stat& status) {
  return {status.st_dev, status.st_ino};
}

bool same_time(const timespec& a, const timespec& b) {
  return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

// The way to an open file that doesn't depend on its name.
fs::path path_of(const FileDescriptor& file) {
  return fmt::format("/proc/self/fd/{}", file.get());
}

bool has_descriptor_paths() {
  static const bool there = ::access("/proc/self/fd", X_OK) == 0;
  return there;
}

// Some are left for whoever reads the files, and for libraries that are loaded.
bool may_hold(std::size_t files) {
  rlimit limit{};
  return has_descriptor_paths() && ::getrlimit(RLIMIT_NOFILE, &limit) == 0 && files < limit.rlim_cur / 2;
}

std::string read_all(const FileDescriptor& file, const fs::path& json, off_t size) {
  std::string content(static_cast<std::size_t>(size), '\0');
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t n =
        ::pread(file.get(), content.data() + done, content.size() - done, static_cast<off_t>(done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      throw Error(ErrorKind::cannot_read, json.string(),
                  n < 0 ? fmt::format("can't be read: {}", std::strerror(errno))
                        : "became shorter while it was read");
    done += static_cast<std::size_t>(n);
  }
  return content;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

} // namespace

fs::path pack_json_of(const fs::path& folder_or_json) {
  std::error_code unused;
  return fs::is_directory(folder_or_json, unused) ? folder_or_json / "pack.json" : folder_or_json;
}

fs::path folder_of(const fs::path& pack_json) {
  return pack_json.has_parent_path() ? pack_json.parent_path() : fs::path(".");
}

std::string pack_name(const fs::path& folder_or_json) {
  return fs::absolute(pack_json_of(folder_or_json)).lexically_normal().parent_path().filename().string();
}

void throw_replaced_again_and_again(const fs::path& folder) {
  throw Error(ErrorKind::cannot_read, folder.string(),
              "is being replaced by another process again and again; try again when that has ended");
}

PackFolder::PackFolder(const fs::path& folder_or_json)
    : json(pack_json_of(folder_or_json)), folder(folder_of(json)) {
  std::error_code unknown;
  if (json.extension() != ".json" && fs::is_regular_file(json, unknown))
    throw Error(ErrorKind::cannot_read, json.string(), "is no pack; name the pack's folder or its pack.json");
  for (int attempt = 1; !open(); ++attempt) {
    if (attempt == most_openings) throw_replaced_again_and_again(folder);
    std::this_thread::sleep_for(between_openings);
  }
}

// False if the pack was replaced meanwhile.
bool PackFolder::open() {
  std::error_code unknown;
  const fs::path whole = fs::weakly_canonical(fs::absolute(folder, unknown), unknown);
  if (!unknown && settle(whole) == FolderState::in_between) return false;
  opened = FileDescriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const int no_folder = errno;
  if (!opened && no_folder != ENOENT && no_folder != ENOTDIR)
    throw Error(ErrorKind::cannot_read, json.string(),
                fmt::format("can't be opened: {}", std::strerror(no_folder)));
  // Not blocking: opening a pipe must not wait for a writer.
  if (opened)
    opened_json =
        FileDescriptor(::openat(opened.get(), json.filename().c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  const int no_json = errno;
  if (!opened || !opened_json) {
    const auto is_moving = [&] { return !unknown && settle(whole) == FolderState::in_between; };
    // A writer that moved pack.json away may have ended since, and another begun.
    const auto is_there = [&] { return ::faccessat(opened.get(), json.filename().c_str(), F_OK, 0) == 0; };
    if (opened && (leads_elsewhere() || is_moving() || (no_json == ENOENT && (is_there() || is_moving()))))
      return false;
    const bool missing = !opened || no_json == ENOENT || no_json == ENOTDIR;
    throw Error(ErrorKind::cannot_read, json.string(),
                missing ? "there is no such file; a pack is a folder with a pack.json"
                        : fmt::format("can't be opened: {}", std::strerror(no_json)));
  }
  struct stat status {};
  if (::fstat(opened_json.get(), &status) != 0 || !S_ISREG(status.st_mode))
    throw Error(ErrorKind::cannot_read, json.string(), "is no plain file");
  if (status.st_size > largest_json)
    throw Error(ErrorKind::invalid_content, json.string(),
                fmt::format("is {} bytes long; a pack.json has at most {}", status.st_size, largest_json));
  text = read_all(opened_json, json, status.st_size);
  described_pack.reset();
  fault.reset();
  try {
    described_pack = parsed_pack_json(text, json.string());
    hold(described_pack->all_files());
  } catch (const Error& error) {
    fault = error;
  }
  // A folder that another took the place of loses files, but gets none.
  const bool complete = holds_all && described_pack && held.size() == described_pack->all_files().size();
  return !json_was_moved() && (complete || !leads_elsewhere());
}

// Opens every file of the pack. What is missing or no file is left to file().
void PackFolder::hold(const std::vector<std::string>& names) {
  held.clear();
  holds_all = may_hold(names.size());
  for (std::size_t i = 0; i < names.size() && holds_all; ++i) {
    constexpr int flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK;
    const std::string& name = names[i];
    // A plain name that is no link can't lead out of the folder.
    const bool plain = name.find('/') == std::string::npos;
    FileDescriptor file(plain ? ::openat(opened.get(), name.c_str(), flags | O_NOFOLLOW) : -1);
    if (!file && (!plain || errno == ELOOP)) {
      try {
        file = FileDescriptor(::open(inside_folder(root(), name).c_str(), flags));
      } catch (const Error&) {
        continue;
      }
    }
    struct stat status {};
    if (file && ::fstat(file.get(), &status) == 0 && S_ISREG(status.st_mode))
      held.emplace(name, std::move(file));
    if (!file && (errno == EMFILE || errno == ENFILE)) holds_all = false;
  }
  if (!holds_all) held.clear();
}

// Another folder has the name now.
bool PackFolder::leads_elsewhere() const {
  struct stat mine {
  }, now{};
  return ::fstat(opened.get(), &mine) != 0 || ::stat(folder.c_str(), &now) != 0 || id_of(mine) != id_of(now);
}

// Of files that are moved one by one, pack.json is the first to go and the last to come. The time of its last
// change tells of one that went and came back.
bool PackFolder::json_was_moved() const {
  struct stat mine {
  }, now{};
  if (leads_elsewhere()) return false;
  return ::fstat(opened_json.get(), &mine) != 0 ||
         ::fstatat(opened.get(), json.filename().c_str(), &now, 0) != 0 || id_of(mine) != id_of(now) ||
         !same_time(mine.st_ctim, now.st_ctim);
}

bool PackFolder::is_stale() const {
  return !holds_all && (leads_elsewhere() || json_was_moved());
}

const PackDescription& PackFolder::description() const {
  if (fault) throw *fault;
  return *described_pack;
}

fs::path PackFolder::root() const {
  return has_descriptor_paths() ? path_of(opened) : folder;
}

fs::path PackFolder::file(const std::string& name) const {
  if (const auto found = held.find(name); found != held.end()) return path_of(found->second);
  try {
    return inside_folder(root(), name);
  } catch (const Error& error) {
    throw named(error, name);
  }
}

Error PackFolder::named(const Error& error, const std::string& name) const {
  std::string where = error.where(), what = error.what_happened();
  const auto found = held.find(name);
  for (std::string* const said : {&where, &what}) {
    if (found != held.end()) replace_all(*said, path_of(found->second).string(), (folder / name).string());
    replace_all(*said, (root() / "").string(), (folder / "").string());
  }
  return Error(error.kind(), where, what);
}

std::vector<std::string> PackFolder::entries() const {
  std::vector<std::string> names;
  std::error_code unreadable;
  for (fs::directory_iterator entry(root(), unreadable), end; !unreadable && entry != end;
       entry.increment(unreadable)) {
    std::error_code unknown;
    names.push_back(entry->path().filename().string() + (entry->is_directory(unknown) ? "/" : ""));
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::map<std::string, std::uint64_t> PackFolder::bytes_of(std::span<const std::string> files) const {
  std::map<std::string, std::uint64_t> bytes;
  for (const std::string& name : files) {
    struct stat status {};
    const auto found = held.find(name);
    const bool known = found != held.end() ? ::fstat(found->second.get(), &status) == 0
                                           : ::fstatat(opened.get(), name.c_str(), &status, 0) == 0;
    if (known && S_ISREG(status.st_mode)) bytes[name] = static_cast<std::uint64_t>(status.st_size);
  }
  return bytes;
}

} // namespace tilepack
