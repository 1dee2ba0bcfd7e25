#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tilepack {

/// Waits for files to be saved: written and closed, renamed into place, made or removed. What is watched are the
/// folders that they lie in, for editors put a new file in the place of the old one. Linux's inotify, which sees
/// what this machine does: not what others do to a share.
class FileWatch {
public:
  /// `paths`: files, which need not exist, and folders, any change of whose list of files counts. `apart`: files
  /// whose changes don't count, such as those that a build writes. Changes count from now on. Throws Error
  /// (cannot_read) if the system watches no more.
  FileWatch(const std::vector<std::string>& paths, const std::vector<std::string>& apart = {});
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// Returns once something changed and then nothing more for `quiet`: the paths, in order. `meanwhile` is called
  /// several times a second, and may throw to end it.
  std::vector<std::string> wait(std::chrono::milliseconds quiet, const std::function<void()>& meanwhile);

private:
  struct Folder {
    std::string path;
    std::set<std::string> names; // that count
    bool all = false;            // every name counts
  };
  void watch(const std::string& folder, const std::string& name);
  bool take_events(std::set<std::string>& changed);

  int descriptor = -1;
  std::map<int, Folder> folders; // by the number of their watch
  std::set<std::string> passed_over;
};

} // namespace tilepack
