#include "tilepack/image/file_swap.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tilepack {
namespace {

constexpr std::size_t longest_name = 255;

// FNV-1a, to tell long names apart.
std::uint64_t digest(std::string_view text) {
  std::uint64_t value = 0xcbf29ce484222325;
  for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return value;
}

bool rename_with(const FileSwap& swap, unsigned flags) {
  return ::renameat2(AT_FDCWD, swap.part.c_str(), AT_FDCWD, swap.target.c_str(), flags) == 0;
}

} // namespace

std::optional<FileId> file_id(const std::filesystem::path& file) {
  struct stat status {};
  if (::lstat(file.c_str(), &status) != 0) return {};
  return FileId{status.st_dev, status.st_ino};
}

bool current_folder_was_removed() {
  std::error_code fault;
  return std::filesystem::current_path(fault).empty() || fault;
}

void put_in_place(const FileSwap& swap, const std::string& shown) {
  struct stat there {};
  if (::lstat(swap.target.c_str(), &there) == 0 && S_ISDIR(there.st_mode)) // which could be exchanged as well
    throw Error(ErrorKind::cannot_write, shown, "has become a folder meanwhile; name another file");
  bool done = swap.replaces ? rename_with(swap, RENAME_EXCHANGE) : rename_with(swap, RENAME_NOREPLACE);
  // Not every file system can do either, and the older file may have come or gone meanwhile.
  if (!done) done = ::rename(swap.part.c_str(), swap.target.c_str()) == 0;
  if (!done)
    throw Error(ErrorKind::cannot_write, shown,
                fmt::format("the finished file cannot get this name: {}", std::strerror(errno)));
}

void take_back(const FileSwap& swap) noexcept {
  if (file_id(swap.target) != swap.id) return;
  if (file_id(swap.part))
    ::rename(swap.part.c_str(), swap.target.c_str());
  else if (!swap.replaces)
    ::unlink(swap.target.c_str());
}

void drop_part(const FileSwap& swap) noexcept {
  ::unlink(swap.part.c_str());
}

std::string hidden_name(const std::string& name, std::string_view suffix) {
  std::string hidden = fmt::format(".{}.{}", name, suffix);
  if (hidden.size() <= longest_name) return hidden;
  constexpr std::size_t kept = 160;
  return fmt::format(".{}-{:016x}.{}", name.substr(0, kept), digest(name), suffix);
}

std::string part_name(const std::string& name, int number) {
  return hidden_name(name, fmt::format("{}.part", number));
}

} // namespace tilepack
