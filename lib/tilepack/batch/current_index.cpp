#include "tilepack/batch/current_index.h"

#include "tilepack/bake/text_file.h"
#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <set>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace tilepack {
namespace {

constexpr std::string_view index_magic = "tilepack-index-1\n";
constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t margin = second / 10; // coarser than the times of any file system in use but FAT

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * second + time.tv_nsec;
}

void put(std::string& text, std::string_view field) {
  text += fmt::format("{}:", field.size());
  text += field;
}

// The next field of `text`, taken off it; false if there is none.
bool take(std::string_view& text, std::string_view& field) {
  std::size_t size = 0, digits = 0;
  while (digits < text.size() && digits < 9 && text[digits] >= '0' && text[digits] <= '9')
    size = size * 10 + static_cast<std::size_t>(text[digits++] - '0');
  if (digits == 0 || digits >= text.size() || text[digits] != ':' || size > text.size() - digits - 1)
    return false;
  field = text.substr(digits + 1, size);
  text.remove_prefix(digits + 1 + size);
  return true;
}

struct FilesState {
  ContentHash hash;
  std::int64_t newest = 0;
};

// Of a list that put() made; none if one of them is not there.
std::optional<FilesState> state_of_files(std::string_view files) {
  FilesState state;
  std::vector<std::uint64_t> numbers;
  std::string file;
  for (std::string_view name; take(files, name);) {
    file = name;
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) return std::nullopt;
    const std::int64_t modified = nanoseconds(status.st_mtim), changed = nanoseconds(status.st_ctim);
    for (const auto number :
         {static_cast<std::uint64_t>(status.st_dev), static_cast<std::uint64_t>(status.st_ino),
          static_cast<std::uint64_t>(status.st_size), static_cast<std::uint64_t>(modified),
          static_cast<std::uint64_t>(changed)})
      numbers.push_back(number);
    state.newest = std::max({state.newest, modified, changed});
  }
  state.hash = hash_of({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(numbers[0])});
  return state;
}

// The time of a new file beside `file`; 0 where none can be made, and then no file is old enough.
std::int64_t time_beside(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  const std::string place = folder.empty() ? "." : folder.string();
  int descriptor =
      ::open(place.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600); // has no name to be left behind
  if (descriptor < 0) { // file systems without such files, NFS among them
    std::string name = place + "/.tilepack-clock-" + std::string(6, 'X');
    descriptor = ::mkstemp(name.data());
    if (descriptor >= 0) ::unlink(name.c_str());
  }
  if (descriptor < 0) return 0;
  struct stat status {};
  const bool good = ::fstat(descriptor, &status) == 0;
  ::close(descriptor);
  return good ? nanoseconds(status.st_mtim) : 0;
}

bool take_hash(std::string_view& text, ContentHash& hash) {
  std::string_view field;
  if (!take(text, field)) return false;
  const auto parsed = parsed_hash(field);
  if (parsed) hash = *parsed;
  return parsed.has_value();
}

// Of so many outputs and no more: where a note was lost, not all of them are known.
ContentHash request_for_all(const ContentHash& request, std::size_t count) {
  ContentHasher hasher;
  hasher.add_number(request.high);
  hasher.add_number(request.low);
  hasher.add_number(count);
  return hasher.value();
}

} // namespace

CurrentIndex::CurrentIndex(std::string name) : file(std::move(name)) {
  began = time_beside(file);
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream ? static_cast<std::streamoff>(stream.tellg()) : 0;
  if (size <= 0) return;
  std::string text(static_cast<std::size_t>(size), '\0');
  stream.seekg(0);
  if (stream.read(text.data(), size)) read(text);
}

void CurrentIndex::read(std::string_view bytes) {
  std::string_view text = bytes;
  ContentHash whole;
  if (!text.starts_with(index_magic)) return;
  text.remove_prefix(index_magic.size());
  if (!take_hash(text, whole) || whole != hash_of(text)) return;
  for (std::string_view output; take(text, output);) {
    Note note;
    std::string_view files;
    if (!take_hash(text, note.request) || !take_hash(text, note.state) || !take(text, files)) return;
    note.files = files;
    notes.insert_or_assign(notes.end(), std::string(output), std::move(note));
  }
}

std::string CurrentIndex::text() const {
  std::string body;
  for (const auto& [output, note] : notes) {
    put(body, output);
    put(body, hex(note.request));
    put(body, hex(note.state));
    put(body, note.files);
  }
  std::string text(index_magic);
  put(text, hex(hash_of(body)));
  return text + body;
}

bool CurrentIndex::holds(const std::string& output, const ContentHash& request) const {
  const Note* note = nullptr; // stays where it is, and only its own entry replaces it
  {
    const std::scoped_lock lock(mutex);
    const auto found = notes.find(output);
    if (found == notes.end() || found->second.request != request) return false;
    note = &found->second;
  }
  return holds(*note);
}

bool CurrentIndex::holds(const Note& note) const {
  const auto now = state_of_files(note.files);
  return now && now->hash == note.state;
}

void CurrentIndex::note_all(const ContentHash& request, const std::vector<std::string>& outputs,
                            const std::vector<std::string>& folders) {
  const auto has_note = [&](const std::string& output) { return notes.contains(output); };
  const ContentHash all = request_for_all(request, outputs.size());
  if (std::all_of(outputs.begin(), outputs.end(), has_note) && !holds("", all)) note("", all, folders);
}

std::optional<std::size_t> CurrentIndex::all_hold(const ContentHash& request) const {
  if (notes.empty() || !holds("", request_for_all(request, notes.size() - 1))) return std::nullopt;
  std::vector<const Note*> list;
  for (const auto& [output, note] : notes)
    if (!output.empty()) list.push_back(&note);
  // Two threads are what a disk's cache in memory serves; a pool that has to be woken takes longer than this.
  std::atomic<bool> all = true;
  const auto look = [&](std::size_t first) {
    for (std::size_t i = first; i < list.size() && all; i += 2)
      if (!holds(*list[i])) all = false;
  };
  {
    const std::jthread odd([&] { look(1); });
    look(0);
  }
  return all ? std::optional(list.size()) : std::nullopt;
}

void CurrentIndex::note(const std::string& output, const ContentHash& request,
                        const std::vector<std::string>& files) {
  std::string list;
  for (const std::string& one : files) put(list, one);
  const auto now = state_of_files(list);
  const std::scoped_lock lock(mutex);
  if (now && now->newest < began - margin) {
    notes.insert_or_assign(output, Note{request, std::move(list), now->hash});
    changed = true;
  } else {
    changed |= notes.erase(output) > 0;
  }
}

void CurrentIndex::store(const std::vector<std::string>& outputs) {
  const std::set<std::string_view> known(outputs.begin(), outputs.end());
  if (std::erase_if(notes, [&](const auto& note) { return !known.contains(note.first); }) > 0) changed = true;
  if (!changed) return;
  try {
    write_text_file(file, text());
  } catch (const Error&) { // it saves time and no more
  }
}

std::string index_file_of(const std::string& manifest) {
  const std::filesystem::path file(manifest);
  return (file.parent_path() / fmt::format(".{}.index", file.filename().string())).string();
}

} // namespace tilepack
