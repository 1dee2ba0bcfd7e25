#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// The line, counted from 1, on which the value at `place` begins in a JSON document: the place as JsonCursor
/// names it, "jobs[3].options.seed". Where the place leads nowhere, the line of what encloses it; of a member
/// that stands twice, the first. The document must be one that can be parsed; for others it is some line of it.
int json_line(std::string_view document, std::string_view place);

/// The same for many places of one document, each found without walking over all that stands before it: where the
/// members of the document and the items of lists among them begin is noted when the first place is asked for.
class JsonLines {
public:
  explicit JsonLines(std::string document) : text(std::move(document)) {}

  /// Safe to be called by several threads.
  int line(std::string_view place) const;

private:
  struct Begin {
    std::size_t at = 0;
    int line = 1;
  };
  struct Member {
    Begin value;
    std::vector<Begin> items; ///< of a list
  };
  void note_members() const;

  std::string text;
  mutable std::once_flag noted;
  mutable std::map<std::string, Member, std::less<>> members;
};

} // namespace tilepack
