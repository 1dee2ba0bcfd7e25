#include "tilepack/json/json_line.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>

namespace tilepack {
namespace {

// Walks over the text of a document without keeping anything of it.
class JsonWalk {
public:
  explicit JsonWalk(std::string_view document, std::size_t from = 0) : text(document), at(from) {}

  // To the value at `place` within the one that begins here; false where it leads no further.
  bool descend(std::string_view place) {
    while (!place.empty()) {
      blank();
      if (place.front() == '[') {
        std::size_t index = 0;
        const auto [end, fault] = std::from_chars(place.data() + 1, place.data() + place.size(), index);
        if (fault != std::errc() || !item(index)) return false;
        place.remove_prefix(static_cast<std::size_t>(end - place.data()) + 1); // the ']' too
      } else {
        if (place.front() == '.') place.remove_prefix(1);
        if (!member(place)) return false;
      }
    }
    blank();
    return true;
  }

  std::size_t place() const { return at; }

  int lines_since(std::size_t start) const {
    return static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(start),
                                       text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  }

  // Calls `begins` with each name at the place where its value begins, which it may walk over.
  template <typename Begins>
  void each_member(const Begins& begins) {
    blank();
    if (here() != '{') return;
    for (++at, blank(); here() == '"'; blank()) {
      const std::string_view name = quoted();
      blank();
      if (here() != ':') return;
      ++at;
      blank();
      const std::size_t start = at;
      begins(name);
      at = start;
      skip();
      blank();
      if (here() != ',') return;
      ++at;
    }
  }

  template <typename Begins>
  void each_item(const Begins& begins) {
    if (here() != '[') return;
    for (++at; more(); ++at) {
      blank();
      if (here() == ']') return;
      begins();
      skip();
      blank();
      if (here() != ',') return;
    }
  }

private:
  bool more() const { return at < text.size(); }
  char here() const { return more() ? text[at] : '\0'; }

  void blank() {
    while (more() && (here() == ' ' || here() == '\t' || here() == '\n' || here() == '\r')) ++at;
  }

  // A member whose name begins `place`, the longest such name, for names may hold dots; takes it off the place.
  bool member(std::string_view& place) {
    if (here() != '{') return false;
    const std::size_t start = at;
    std::size_t best = 0, best_at = 0;
    bool found = false;
    for (++at, blank(); here() == '"'; blank()) {
      const std::string_view name = quoted();
      blank();
      if (here() != ':') break;
      ++at;
      blank();
      const bool fits = place.starts_with(name) && (name.size() == place.size() ||
                                                    place[name.size()] == '.' || place[name.size()] == '[');
      if (fits && (!found || name.size() > best)) {
        found = true;
        best = name.size();
        best_at = at;
      }
      skip();
      blank();
      if (here() != ',') break;
      ++at;
    }
    at = found ? best_at : start;
    if (found) place.remove_prefix(best);
    return found;
  }

  bool item(std::size_t index) {
    if (here() != '[') return false;
    const std::size_t start = at;
    ++at;
    for (std::size_t i = 0; more(); ++i) {
      blank();
      if (here() == ']') break;
      if (i == index) return true;
      skip();
      blank();
      if (here() != ',') break;
      ++at;
    }
    at = start;
    return false;
  }

  std::string_view quoted() {
    const std::size_t start = ++at;
    while (more() && here() != '"') at += here() == '\\' ? 2 : 1;
    at = std::min(at, text.size());
    const std::string_view inside = text.substr(start, at - start);
    if (more()) ++at;
    return inside;
  }

  // Over one value: brackets outside of texts tell where it ends.
  void skip() {
    std::size_t depth = 0;
    const std::size_t start = at;
    while (more()) {
      const char c = here();
      if (depth == 0 && at > start && (c == ',' || c == '}' || c == ']')) return;
      if (c == '"') {
        quoted();
      } else {
        if (c == '{' || c == '[') ++depth;
        ++at;
        if (c == '}' || c == ']') --depth;
      }
      if (depth == 0 && (c == '"' || c == '}' || c == ']')) return;
    }
  }

  std::string_view text;
  std::size_t at = 0;
};

} // namespace

int json_line(std::string_view document, std::string_view place) {
  JsonWalk walk(document);
  walk.descend(place);
  return 1 + walk.lines_since(0);
}

void JsonLines::note_members() const {
  JsonWalk walk(text);
  Begin last;
  const auto here = [&] {
    last.line += walk.lines_since(last.at);
    last.at = walk.place();
    return last;
  };
  walk.each_member([&](std::string_view name) {
    if (members.contains(name)) return; // of one that stands twice, the first
    Member& member = members[std::string(name)];
    member.value = here();
    walk.each_item([&] { member.items.push_back(here()); });
  });
}

int JsonLines::line(std::string_view place) const {
  std::call_once(noted, [&] { note_members(); });
  const std::size_t end = std::min(place.find_first_of(".["), place.size());
  const auto found = members.find(place.substr(0, end));
  if (found == members.end()) return json_line(text, place);
  Begin begin = found->second.value;
  place.remove_prefix(end);
  std::size_t index = 0;
  if (place.starts_with('[')) {
    const auto [rest, fault] = std::from_chars(place.data() + 1, place.data() + place.size(), index);
    if (fault == std::errc() && index < found->second.items.size() && rest != place.data() + place.size()) {
      begin = found->second.items[index];
      place.remove_prefix(static_cast<std::size_t>(rest - place.data()) + 1);
    }
  }
  JsonWalk walk(text, begin.at);
  walk.descend(place);
  return begin.line + walk.lines_since(begin.at);
}

} // namespace tilepack
