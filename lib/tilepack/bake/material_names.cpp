#include "tilepack/bake/material_names.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace tilepack {
namespace {

struct Word {
  std::string text;
  std::size_t start = 0; // in the name
  std::size_t end = 0;
  bool apart = true; // something that is no letter or digit stands before it
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}
bool is_small(char c) {
  return c >= 'a' && c <= 'z';
}
// Bytes of other letters than these count as letters.
bool is_part(char c) {
  return is_digit(c) || is_capital(c) || is_small(c) || static_cast<unsigned char>(c) >= 0x80;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (is_capital(c)) c = static_cast<char>(c - 'A' + 'a');
  return result;
}

bool is_number(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

// A capital begins a word behind a small letter, and before one: "rockAlbedo", "GLNormal", "01Albedo", not "2K".
bool begins_word(std::string_view name, std::size_t at) {
  if (!is_capital(name[at])) return false;
  const bool small_next = at + 1 < name.size() && is_small(name[at + 1]);
  return is_small(name[at - 1]) || ((is_capital(name[at - 1]) || is_digit(name[at - 1])) && small_next);
}

std::vector<Word> words_of(std::string_view name) {
  std::vector<Word> words;
  for (std::size_t at = 0; at < name.size(); ++at) {
    if (!is_part(name[at])) continue;
    const bool apart = at == 0 || !is_part(name[at - 1]);
    const bool after_one_letter = // "sRGB"
        !words.empty() && words.back().end - words.back().start == 1 && is_small(name[words.back().start]);
    if (words.empty() || apart || (begins_word(name, at) && !after_one_letter))
      words.push_back({"", at, at, apart});
    words.back().end = at + 1;
  }
  for (Word& word : words) word.text = lower(name.substr(word.start, word.end - word.start));
  return words;
}

int number(std::string_view digits) {
  int value = 0;
  for (const char c : digits.substr(0, 6)) value = 10 * value + (c - '0');
  return value;
}

// Texels of the side that "2k", "2048", "2048px" or "2048x1024" stands for; 0 if it is no resolution.
int side_in(std::string_view word) {
  const std::size_t digits = std::min(word.find_first_not_of("0123456789"), word.size());
  const std::string_view rest = word.substr(digits);
  if (digits == 0 || digits > 5) return 0;
  const int value = number(word.substr(0, digits));
  if (rest == "k") return value >= 1 && value <= 64 ? 1024 * value : 0;
  const bool power_of_two = value >= 128 && value <= 16384 && (value & (value - 1)) == 0;
  if (rest.empty() || rest == "px") return power_of_two ? value : 0;
  if (rest.front() == 'x' && is_number(rest.substr(1)) && value >= 16) return value;
  return 0;
}

template <std::size_t count>
bool is_one_of(std::string_view word, const std::string_view (&list)[count]) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

constexpr std::string_view readable[] = {"png", "jpg",  "jpeg", "jpe", "tif", "tiff", "exr", "tga", "targa",
                                         "bmp", "webp", "hdr",  "jp2", "j2k", "j2c",  "dds", "psd"};
constexpr std::string_view unreadable[] = {
    "gif", "svg",  "xcf",  "kra",     "psb", "heic", "heif", "avif", "jxl", "ktx", "ktx2", "basis",
    "crn", "pvr",  "astc", "pcx",     "ppm", "pgm",  "pbm",  "pnm",  "pfm", "iff", "sgi",  "rgb",
    "ico", "clip", "ora",  "afphoto", "tx",  "rat",  "vtf",  "dng",  "cr2", "nef", "arw",  "raw"};
// Preferred in this order where a map is there twice: what loses least first.
constexpr std::string_view lossless[] = {"exr", "tif", "tiff", "png", "psd", "tga", "bmp"};
constexpr std::string_view says_nothing[] = {"png",  "jpg", "jpeg",   "exr",      "tif",
                                             "tiff", "tga", "webp",   "bmp",      "srgb",
                                             "raw",  "lin", "linear", "seamless", "tileable"};

int bits_in(std::string_view word) {
  for (const std::string_view bits : {"8", "16", "32"})
    if (word.starts_with(bits) && (word.substr(bits.size()) == "bit" || word.substr(bits.size()) == "bits"))
      return number(bits);
  return 0;
}

bool is_numbered(std::string_view word, std::string_view name) {
  return word.starts_with(name) && is_number(word.substr(name.size()));
}

// Tells nothing of the material, wherever it stands.
bool is_technical(std::string_view word) {
  return side_in(word) > 0 || is_one_of(word, says_nothing) || bits_in(word) > 0 ||
         is_numbered(word, std::string_view("lod0").substr(0, 3));
}

std::string_view stem_of(std::string_view file_name) {
  const std::size_t dot = file_name.rfind('.');
  return dot == std::string_view::npos ? file_name : file_name.substr(0, dot);
}

std::string extension_of(std::string_view file_name) {
  const std::size_t dot = file_name.rfind('.');
  return dot == std::string_view::npos ? "" : lower(file_name.substr(dot + 1));
}

// What stands behind the ending, taken off the words.
struct Tail {
  std::string numbers; // belong to the material: "rock_albedo_02"
  int copy = 0;
  int variant = 0;
  int bits = 0;
};

Tail taken_tail(std::string_view stem, std::vector<Word>& words) {
  Tail tail;
  while (words.size() > 1) {
    const Word& word = words.back();
    const bool bracketed = word.start > 0 && stem[word.start - 1] == '(';
    if (is_technical(word.text)) {
      tail.bits = std::max(tail.bits, bits_in(word.text));
    } else if (word.text == "copy" || (bracketed && is_number(word.text))) {
      tail.copy = 1;
    } else if (is_numbered(word.text, "var")) {
      tail.variant = number(std::string_view(word.text).substr(3));
    } else if (is_numbered(word.text, "v")) {
      tail.variant = -number(std::string_view(word.text).substr(1)); // the latest version
    } else if (is_number(word.text)) {
      tail.numbers.insert(0, word.text);
    } else {
      break;
    }
    words.pop_back();
  }
  return tail;
}

std::string joined(const std::vector<Word>& words, std::size_t from, std::size_t to) {
  std::string text;
  for (std::size_t i = from; i < to; ++i) text += words[i].text;
  return text;
}

std::string key_of(const std::vector<Word>& words, std::size_t from, std::size_t to) {
  std::string key;
  for (std::size_t i = from; i < to; ++i)
    if (!is_technical(words[i].text)) key += words[i].text;
  return key;
}

// "nrm16" is "nrm".
std::optional<KindNamed> kind_with_bits(const std::string& word, int& bits) {
  if (const auto kind = kind_called(word)) return kind;
  for (const std::string_view suffix : {"16", "32", "8"}) {
    if (!word.ends_with(suffix) || word.size() < suffix.size() + 2) continue;
    if (const auto kind = kind_called(word.substr(0, word.size() - suffix.size()))) {
      bits = number(suffix);
      return kind;
    }
  }
  return std::nullopt;
}

int resolution_side(std::string_view resolution) {
  return resolution.empty() ? 0 : side_in(resolution);
}

} // namespace

std::vector<std::string> material_words(std::string_view name) {
  std::vector<std::string> list;
  for (const Word& word : words_of(name))
    if (!is_technical(word.text)) list.push_back(word.text);
  return list;
}

std::string material_key(std::string_view name) {
  const std::vector<Word> words = words_of(name);
  return key_of(words, 0, words.size());
}

std::string resolution_in(std::string_view name) {
  for (const Word& word : words_of(name))
    if (side_in(word.text) > 0) return word.text;
  return "";
}

std::vector<NameReading> readings_of(std::string_view file_name) {
  if (file_name.empty() || file_name.front() == '.') return {};
  const std::string_view stem = stem_of(file_name);
  std::vector<Word> words = words_of(stem);
  if (words.empty()) return {};
  const std::string resolution = resolution_in(stem);
  const Tail tail = taken_tail(stem, words);
  const auto* const format = std::find(std::begin(lossless), std::end(lossless), extension_of(file_name));

  std::vector<NameReading> readings;
  const auto add = [&](const KindNamed& kind, std::string key, std::string_view shown, int bits, bool weak,
                       bool one_letter) {
    NameReading reading{std::move(key) + tail.numbers,
                        tail.numbers,
                        std::string(shown),
                        kind,
                        resolution,
                        weak,
                        one_letter,
                        {}};
    if (!tail.numbers.empty()) reading.shown += " " + tail.numbers;
    reading.preference = {kind.rank,
                          tail.copy,
                          tail.variant,
                          -std::max(bits, tail.bits),
                          -resolution_side(resolution),
                          static_cast<int>(format - std::begin(lossless))};
    readings.push_back(std::move(reading));
  };
  // The name up to a word, without what separates the two.
  const auto before = [&](std::size_t word) {
    return word == 0 ? std::string_view() : stem.substr(words[0].start, words[word - 1].end - words[0].start);
  };

  constexpr std::size_t most_words = 4; // of an ending: "Ambient Occlusion"
  const std::size_t count = words.size();
  for (std::size_t taken = std::min(most_words, count); taken > 0; --taken) {
    const std::size_t from = count - taken;
    const std::string word = joined(words, from, count);
    const bool one_letter = word.size() == 1;
    if (one_letter && (!words[from].apart || from == 0)) continue;
    int bits = 0;
    if (const auto kind = kind_with_bits(word, bits))
      add(*kind, key_of(words, 0, from), before(from), bits, false, one_letter);
  }
  if (!readings.empty()) return readings;

  constexpr std::size_t shortest = 6; // of an ending without a separator: "albedo"
  const std::string& last = words.back().text;
  for (std::size_t at = 1; at + shortest <= last.size(); ++at)
    if (const auto kind = kind_called(last.substr(at))) {
      add(*kind, key_of(words, 0, count - 1) + last.substr(0, at),
          stem.substr(words[0].start, words.back().start + at - words[0].start), 0, true, false);
      break;
    }
  constexpr std::size_t shortest_first = 3;
  for (std::size_t taken = std::min(most_words, count - 1); taken > 0 && readings.empty(); --taken) {
    const std::string word = joined(words, 0, taken);
    if (word.size() < shortest_first) continue;
    if (const auto kind = kind_called(word))
      add(*kind, key_of(words, taken, count),
          stem.substr(words[taken].start, words[count - 1].end - words[taken].start), 0, true, false);
  }
  return readings;
}

bool has_readable_ending(std::string_view file_name) {
  return is_one_of(extension_of(file_name), readable);
}

bool has_other_image_ending(std::string_view file_name) {
  return is_one_of(extension_of(file_name), unreadable);
}

} // namespace tilepack
