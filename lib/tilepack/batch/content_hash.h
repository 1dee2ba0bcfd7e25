#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace tilepack {

/// 128 bits that stand for a content: two that differ have different hashes but for a chance of 2^-128, unless
/// someone made them to collide. xxHash3 (XXH3_128bits); the same on every
/// machine.
struct ContentHash {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  bool operator==(const ContentHash&) const = default;
  auto operator<=>(const ContentHash&) const = default;
};

/// 32 hexadecimal digits, the high half first.
std::string hex(const ContentHash& hash);

/// What hex() wrote; none if `text` is anything else.
std::optional<ContentHash> parsed_hash(std::string_view text);

/// The hash of bytes that come piece by piece: of all of them in a row, however they were cut.
class ContentHasher {
public:
  ContentHasher();
  ~ContentHasher();
  ContentHasher(const ContentHasher&) = delete;
  ContentHasher& operator=(const ContentHasher&) = delete;

  void add(std::string_view bytes);
  /// The length too, so that what follows can't be taken for a part of it.
  void add_field(std::string_view bytes);
  void add_number(std::uint64_t number);
  ContentHash value() const;

private:
  struct State;
  std::unique_ptr<State> state;
};

ContentHash hash_of(std::string_view bytes);

/// Of what a file holds. Throws Error (cannot_read).
ContentHash hash_of_file(const std::string& file);

/// The same; none if there is no plain file that can be read.
std::optional<ContentHash> hash_if_there(const std::string& file);

} // namespace tilepack
