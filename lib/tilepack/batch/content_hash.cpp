#include "tilepack/batch/content_hash.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace tilepack {
namespace {

constexpr std::size_t bytes_at_a_time = std::size_t{256} << 10;

ContentHash from(XXH128_hash_t hash) {
  return {hash.high64, hash.low64};
}

// The reason in errno if it fails.
bool add_file(ContentHasher& hasher, const std::string& file) {
  const int descriptor =
      ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); // a pipe would wait for ever
  if (descriptor < 0) return false;
  struct stat status {};
  bool good = ::fstat(descriptor, &status) == 0;
  if (good && !S_ISREG(status.st_mode)) {
    errno = S_ISDIR(status.st_mode) ? EISDIR : EINVAL;
    good = false;
  }
  thread_local std::vector<char> buffer(bytes_at_a_time);
  while (good) {
    const ssize_t read = ::read(descriptor, buffer.data(), buffer.size());
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) {
      good = read == 0;
      break;
    }
    hasher.add({buffer.data(), static_cast<std::size_t>(read)});
  }
  const int reason = errno;
  ::close(descriptor);
  errno = reason;
  return good;
}

} // namespace

struct ContentHasher::State {
  XXH3_state_t* xxh = XXH3_createState();
  ~State() { XXH3_freeState(xxh); }
};

ContentHasher::ContentHasher() : state(std::make_unique<State>()) {
  XXH3_128bits_reset(state->xxh);
}

ContentHasher::~ContentHasher() = default;

void ContentHasher::add(std::string_view bytes) {
  XXH3_128bits_update(state->xxh, bytes.data(), bytes.size());
}

void ContentHasher::add_field(std::string_view bytes) {
  add_number(bytes.size());
  add(bytes);
}

void ContentHasher::add_number(std::uint64_t number) {
  std::array<char, 8> bytes{}; // least byte first, on every machine
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(number >> (8 * i) & 0xFF);
  add({bytes.data(), bytes.size()});
}

ContentHash ContentHasher::value() const {
  return from(XXH3_128bits_digest(state->xxh));
}

std::string hex(const ContentHash& hash) {
  return fmt::format("{:016x}{:016x}", hash.high, hash.low);
}

std::optional<ContentHash> parsed_hash(std::string_view text) {
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (text.size() != 32 || !std::all_of(text.begin(), text.end(), is_digit)) return std::nullopt;
  ContentHash hash;
  for (const auto& [half, at] : {std::pair{&hash.high, 0}, std::pair{&hash.low, 16}}) {
    const auto [end, fault] = std::from_chars(text.data() + at, text.data() + at + 16, *half, 16);
    if (fault != std::errc() || end != text.data() + at + 16) return std::nullopt;
  }
  return hash;
}

ContentHash hash_of(std::string_view bytes) {
  return from(XXH3_128bits(bytes.data(), bytes.size()));
}

ContentHash hash_of_file(const std::string& file) {
  ContentHasher hasher;
  if (!add_file(hasher, file)) throw Error(ErrorKind::cannot_read, file, std::strerror(errno));
  return hasher.value();
}

std::optional<ContentHash> hash_if_there(const std::string& file) {
  ContentHasher hasher;
  if (!add_file(hasher, file)) return std::nullopt;
  return hasher.value();
}

} // namespace tilepack
