#include "tilepack/batch/cache_head.h"

#include "tilepack/pack/file_name.h"

#include <fmt/format.h>

#include <charconv>

namespace tilepack {
namespace {

constexpr std::string_view cache_magic = "tilepack-cache-1\n";
constexpr std::size_t most_cached_files = 65536;

// A line, taken off `text` without its end.
bool take_line(std::string_view& text, std::string_view& line) {
  const std::size_t end = text.find('\n');
  if (end == text.npos) return false;
  line = text.substr(0, end);
  text.remove_prefix(end + 1);
  return true;
}

// As `cache_head_text` writes it and no other way: 06 is damage, not 6.
bool parsed_number(std::string_view text, std::uint64_t& number) {
  if (text.size() > 1 && text.front() == '0') return false;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc() && end == text.data() + text.size() && !text.empty();
}

} // namespace

std::string cache_head_text(const std::vector<CachedOutput::File>& files) {
  std::string list = fmt::format("{}\n", files.size());
  for (const CachedOutput::File& file : files)
    list += fmt::format("{}\n{}\n{}\n", file.name, file.size, hex(file.hash));
  return fmt::format("{}{}\n{}\n{}", cache_magic, hex(hash_of(list)), list.size(), list);
}

std::optional<CachedOutput> parsed_cache_head(std::string_view bytes) {
  std::string_view text = bytes, hash, line;
  if (!text.starts_with(cache_magic)) return std::nullopt;
  text.remove_prefix(cache_magic.size());
  std::uint64_t size = 0, count = 0;
  if (!take_line(text, hash) || !take_line(text, line) || !parsed_number(line, size) || size > text.size())
    return std::nullopt;
  CachedOutput head;
  head.head_size = bytes.size() - text.size() + size;
  text = text.substr(0, size);
  if (parsed_hash(hash) != hash_of(text) || !take_line(text, line) || !parsed_number(line, count) ||
      count < 1 || count > most_cached_files)
    return std::nullopt;
  for (std::uint64_t i = 0; i < count; ++i) {
    CachedOutput::File file;
    std::string_view digits, value;
    if (!take_line(text, line) || !take_line(text, digits) || !take_line(text, value)) return std::nullopt;
    const auto parsed = parsed_hash(value);
    if (!parsed || !parsed_number(digits, file.size) || file.size > (std::uint64_t{1} << 50))
      return std::nullopt;
    file.name = line;
    file.hash = *parsed;
    if (!file.name.empty() && !file_name_fault(file.name).empty()) return std::nullopt;
    head.files.push_back(std::move(file));
  }
  return text.empty() ? std::optional(std::move(head)) : std::nullopt;
}

} // namespace tilepack
