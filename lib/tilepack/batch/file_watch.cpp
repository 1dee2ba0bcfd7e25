#include "tilepack/batch/file_watch.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t what_counts = IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_CREATE | IN_DELETE |
                                      IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR;
constexpr int between_calls = 50; // milliseconds

std::string absolute(const std::string& path) {
  std::error_code fault;
  return fs::absolute(path, fault).lexically_normal().string();
}

// What is written before it gets its name, by editors and by us.
bool is_passing(const std::string& name) {
  return name.ends_with("~") || name.ends_with(".swp") || name.ends_with(".part") || name.starts_with(".#");
}

} // namespace

FileWatch::FileWatch(const std::vector<std::string>& paths, const std::vector<std::string>& apart)
    : descriptor(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
  if (descriptor < 0)
    throw Error(ErrorKind::cannot_read, "", fmt::format("files can't be watched: {}", std::strerror(errno)));
  for (const std::string& path : apart) passed_over.insert(absolute(path));
  for (const std::string& path : paths) {
    std::error_code fault;
    if (fs::is_directory(path, fault)) watch(absolute(path), "");
    const fs::path whole = absolute(path);
    watch(whole.parent_path().string(), whole.filename().string());
  }
}

FileWatch::~FileWatch() {
  ::close(descriptor);
}

// Where the folder is missing, the next one above that is there is watched for it to come.
void FileWatch::watch(const std::string& folder, const std::string& name) {
  fs::path at = folder;
  std::string wanted = name;
  std::error_code fault;
  while (!fs::is_directory(at, fault) && at.has_parent_path() && at != at.parent_path()) {
    wanted = at.filename().string();
    at = at.parent_path();
  }
  const int number = ::inotify_add_watch(descriptor, at.c_str(), what_counts);
  if (number < 0) {
    if (errno == ENOENT || errno == EACCES) return;
    throw Error(ErrorKind::cannot_read, at.string(),
                fmt::format("can't be watched: {}", std::strerror(errno)));
  }
  Folder& watched = folders[number];
  watched.path = at.string();
  if (wanted.empty())
    watched.all = true;
  else
    watched.names.insert(wanted);
}

bool FileWatch::take_events(std::set<std::string>& changed) {
  alignas(inotify_event) std::array<char, 16384> buffer;
  bool any = false;
  for (ssize_t length = 0; (length = ::read(descriptor, buffer.data(), buffer.size())) > 0;) {
    for (const char* at = buffer.data(); at < buffer.data() + length;) {
      const auto* event = reinterpret_cast<const inotify_event*>(at);
      at += sizeof(inotify_event) + event->len;
      const std::string name = event->len > 0 ? std::string(event->name) : "";
      if ((event->mask & IN_Q_OVERFLOW) != 0) { // too many to be told: all may have changed
        changed.insert("");
        any = true;
        continue;
      }
      const auto found = folders.find(event->wd);
      if (found == folders.end() || (event->mask & IN_IGNORED) != 0) continue;
      const Folder& folder = found->second;
      const std::string path = name.empty() ? folder.path : (fs::path(folder.path) / name).string();
      const bool is_named = folder.names.contains(name);
      if (!is_named && (!folder.all || is_passing(name))) continue;
      if (passed_over.contains(path)) continue;
      // A new file counts once it is written; a new folder at once.
      if ((event->mask & IN_CREATE) != 0 && (event->mask & IN_ISDIR) == 0) continue;
      changed.insert(path);
      any = true;
    }
  }
  return any;
}

std::vector<std::string> FileWatch::wait(std::chrono::milliseconds quiet,
                                         const std::function<void()>& meanwhile) {
  std::set<std::string> changed;
  auto last = std::chrono::steady_clock::now();
  while (true) {
    meanwhile();
    pollfd ready{descriptor, POLLIN, 0};
    ::poll(&ready, 1, between_calls);
    if (take_events(changed)) last = std::chrono::steady_clock::now();
    if (!changed.empty() && std::chrono::steady_clock::now() - last >= quiet) break;
  }
  return {changed.begin(), changed.end()};
}

} // namespace tilepack
