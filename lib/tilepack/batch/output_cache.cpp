#include "tilepack/batch/output_cache.h"

#include "tilepack/batch/cache_head.h"
#include "tilepack/batch/entry_state.h"
#include "tilepack/error/error.h"
#include "tilepack/image/staged_file.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/pack_write.h"
#include "tilepack/pack/staged_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <sys/stat.h>
#include <tuple>
#include <unistd.h>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_head = std::size_t{16} << 20;
constexpr std::size_t copied_at_a_time = std::size_t{128} << 10;
constexpr std::int64_t unfinished_seconds = 3600; // nobody writes one output for so long

class Descriptor {
public:
  explicit Descriptor(int opened) : number(opened) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return number; }
  int release() { return std::exchange(number, -1); }

private:
  int number;
};

// As many bytes as there are, up to those asked for; -1 if they can't be read, for which errno has the reason.
ssize_t read_some(int descriptor, char* to, std::size_t bytes) {
  std::size_t had = 0;
  while (had < bytes) {
    const ssize_t n = ::read(descriptor, to + had, bytes - had);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return -1;
    if (n == 0) break;
    had += static_cast<std::size_t>(n);
  }
  return static_cast<ssize_t>(had);
}

bool write_all(int descriptor, const char* from, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t n = ::write(descriptor, from, bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    from += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

Error failed(const std::string& file) {
  return Error(ErrorKind::cannot_write, file,
               fmt::format("{}; check its permissions and the free space", std::strerror(errno)));
}

std::vector<char>& buffer() {
  thread_local std::vector<char> bytes(copied_at_a_time);
  return bytes;
}

// A share that failed, or on which another machine replaced the file meanwhile: that is no damage.
struct Unreadable {};

// Reads one file of an archive and hands its pieces on. False if the archive is damaged or cut short. Throws
// Unreadable.
bool copy_checked(int from, const CachedOutput::File& file,
                  const std::function<void(std::string_view)>& onward) {
  ContentHasher hasher;
  for (std::uint64_t left = file.size; left > 0;) {
    const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(left, copied_at_a_time));
    const ssize_t had = read_some(from, buffer().data(), piece);
    if (had < 0) throw Unreadable();
    if (had != static_cast<ssize_t>(piece)) return false;
    hasher.add({buffer().data(), piece});
    onward({buffer().data(), piece});
    left -= piece;
  }
  return hasher.value() == file.hash;
}

// The side file comes with the pack, in one step.
bool restore_pack(int from, const CachedOutput& head, const BatchEntry& entry, const BuildRecord& record) {
  std::error_code fault;
  const std::string side = fs::path(side_file_of(entry.output, true)).filename().string();
  if (fs::exists(entry.output, fault)) check_pack_folder(entry.output); // refuses folders of others
  std::vector<std::string> old_files, new_files{side};
  if (fs::exists(fs::path(entry.output) / side, fault)) old_files.push_back(side);
  if (fs::exists(fs::path(entry.output) / "pack.json", fault)) {
    for (std::string& name : read_pack_description(entry.output).all_files()) old_files.push_back(name);
    old_files.emplace_back("pack.json");
  }
  StagedFolder staged(entry.output);
  for (const CachedOutput::File& file : head.files) {
    const fs::path path = staged.path() / file.name;
    if (file.name.find('/') != std::string::npos) fs::create_directories(path.parent_path(), fault);
    const Descriptor to(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (to.get() < 0) throw failed(entry.output);
    const bool good = copy_checked(from, file, [&](std::string_view bytes) {
      if (!write_all(to.get(), bytes.data(), bytes.size())) throw failed(entry.output);
    });
    if (!good) return false;
    new_files.push_back(file.name);
  }
  const Descriptor to(::open((staged.path() / side).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  const std::string text = record_text(record);
  if (to.get() < 0 || !write_all(to.get(), text.data(), text.size())) throw failed(entry.output);
  staged.commit(new_files, old_files);
  return true;
}

bool restore_file(int from, const CachedOutput& head, const BatchEntry& entry) {
  fs::create_directories(fs::absolute(entry.output).parent_path());
  StagedFile staged(entry.output);
  std::uint64_t at = 0;
  const bool good = copy_checked(from, head.files.front(), [&](std::string_view bytes) {
    staged.write(at, std::as_bytes(std::span(bytes.data(), bytes.size())));
    staged.check();
    at += bytes.size();
  });
  if (good) staged.commit();
  return good;
}

bool fits(const CachedOutput& head, const BatchEntry& entry) {
  if (entry.verb->output == BatchOutput::pack) return head.files.back().name == "pack.json";
  return head.files.size() == 1 && head.files.front().name == fs::path(entry.output).extension().string();
}

// More of the archive's start, up to `size` bytes. Throws Unreadable.
void read_start(int from, std::string& start, std::size_t size) {
  const std::size_t had = start.size();
  start.resize(size);
  const ssize_t more = read_some(from, start.data() + had, size - had);
  if (more < 0) throw Unreadable();
  start.resize(had + static_cast<std::size_t>(more));
}

// False if the archive is damaged. Throws Unreadable, and Error (cannot_write).
bool restore_output(int from, const BatchEntry& entry, const BuildInputs& inputs) {
  // The head is small: most are found within the first piece.
  constexpr std::size_t most_heads = std::size_t{64} << 10;
  std::string start;
  read_start(from, start, most_heads);
  std::optional<CachedOutput> head = parsed_cache_head(start);
  if (!head && start.size() == most_heads) {
    read_start(from, start, longest_head);
    head = parsed_cache_head(start);
  }
  if (!head || !fits(*head, entry) || ::lseek(from, static_cast<off_t>(head->head_size), SEEK_SET) < 0)
    return false;
  BuildRecord record{inputs, {}};
  for (const CachedOutput::File& one : head->files) record.outputs.push_back({one.name, one.hash});
  if (entry.verb->output == BatchOutput::pack) return restore_pack(from, *head, entry, record);
  record.outputs.front().name = fs::path(entry.output).filename().string();
  if (!restore_file(from, *head, entry)) return false;
  write_record(entry, record);
  return true;
}

} // namespace

std::string OutputCache::file_of(const ContentHash& key) const {
  const std::string name = hex(key);
  return fmt::format("{}/{}/{}", root, name.substr(0, 2), name);
}

bool OutputCache::restore(const ContentHash& key, const BatchEntry& entry, const BuildInputs& inputs) const {
  const std::string file = file_of(key);
  const Descriptor from(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (from.get() < 0) return false;
  try {
    if (restore_output(from.get(), entry, inputs)) {
      ::futimens(from.get(), nullptr); // used just now
      return true;
    }
  } catch (const Unreadable&) {
    return false;
  }
  ::unlink(file.c_str()); // to be made again
  return false;
}

void OutputCache::keep(const ContentHash& key, const BatchEntry& entry,
                       const std::vector<HashedFile>& files) const {
  const std::string file = file_of(key);
  const fs::path folder = fs::path(file).parent_path();
  std::error_code fault;
  fs::create_directories(folder, fault);
  std::string temporary = (folder / ".unfinished-").string() + std::string(6, 'X');
  Descriptor to(::mkstemp(temporary.data()));
  if (to.get() < 0) throw failed(folder.string());
  try {
    std::vector<CachedOutput::File> list;
    for (const HashedFile& one : files) {
      const fs::path path = fs::path(folder_of_output(entry)) / one.name;
      // Of a single file the ending alone, so that another entry may call it differently.
      const bool is_pack = entry.verb->output == BatchOutput::pack;
      list.push_back({is_pack ? one.name : path.extension().string(), fs::file_size(path), one.hash});
    }
    const std::string head = cache_head_text(list);
    if (!write_all(to.get(), head.data(), head.size())) throw failed(folder.string());
    for (const HashedFile& one : files) {
      const Descriptor from(
          ::open((fs::path(folder_of_output(entry)) / one.name).c_str(), O_RDONLY | O_CLOEXEC));
      if (from.get() < 0) throw failed(one.name);
      for (ssize_t n = 1; n > 0;) {
        n = read_some(from.get(), buffer().data(), buffer().size());
        if (n < 0 || !write_all(to.get(), buffer().data(), static_cast<std::size_t>(n)))
          throw failed(folder.string());
      }
    }
    if (::fchmod(to.get(), 0644) != 0 || ::fsync(to.get()) != 0 || ::close(to.release()) != 0 ||
        ::rename(temporary.c_str(), file.c_str()) != 0)
      throw failed(file);
    const Descriptor place(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (place.get() >= 0) ::fsync(place.get());
  } catch (const fs::filesystem_error& error) {
    ::unlink(temporary.c_str());
    throw Error(ErrorKind::cannot_write, folder.string(), error.code().message());
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

void OutputCache::shrink_to(std::int64_t most_bytes) const {
  struct Kept {
    std::int64_t used, bytes; // nanoseconds, by the clock of the file system
    std::string file;
  };
  std::vector<Kept> kept;
  std::vector<Kept> unfinished;
  std::int64_t total = 0, newest = 0;
  std::error_code fault;
  for (fs::recursive_directory_iterator at(root, fault), end; !fault && at != end; at.increment(fault)) {
    struct stat status {};
    if (::lstat(at->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
    const std::string name = at->path().filename().string();
    const Kept one{std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec,
                   std::int64_t{status.st_size}, at->path().string()};
    newest = std::max(newest, one.used);
    if (name.starts_with(".unfinished-")) unfinished.push_back(one);
    if (!parsed_hash(name)) continue;
    total += one.bytes;
    kept.push_back(one);
  }
  for (const Kept& one : unfinished)
    if (one.used < newest - unfinished_seconds * 1'000'000'000) ::unlink(one.file.c_str());
  std::sort(kept.begin(), kept.end(),
            [](const Kept& a, const Kept& b) { return std::tie(a.used, a.file) < std::tie(b.used, b.file); });
  for (const Kept& one : kept) {
    if (total <= most_bytes) break;
    if (::unlink(one.file.c_str()) == 0) total -= one.bytes;
  }
}

} // namespace tilepack
