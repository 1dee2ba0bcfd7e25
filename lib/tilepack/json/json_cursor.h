#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A place in a JSON document, for reading files that may be wrong or hostile: every getter checks type and
/// range, and its message names the place ("maps[0].levels[2].size[0]"), the value and what is allowed.
///
/// All errors are Error (invalid_content) with `where` = "FILE: PLACE". Cheap to copy; shares the document.
class JsonCursor {
public:
  /// Parses `text`; `file` is how messages name it. Refused: syntax errors, an object that has a name twice,
  /// nesting deeper than 32, numbers beyond the range of double.
  static JsonCursor parse(std::string_view text, const std::string& file);

  /// Objects. member() is required to be there, find() is not; only() refuses names outside `known`, with
  /// the nearest one as a hint. names() lists all of them in alphabetical order.
  JsonCursor member(std::string_view name) const;
  std::optional<JsonCursor> find(std::string_view name) const;
  void only(std::span<const std::string> known) const;
  void only(std::initializer_list<std::string> known) const { only({known.begin(), known.size()}); }
  std::vector<std::string> names() const;

  /// Arrays, of lowest..highest entries.
  std::size_t array(std::size_t lowest, std::size_t highest) const;
  JsonCursor item(std::size_t index) const;

  /// Values. Integers must be written without fraction or exponent.
  std::int64_t integer(std::int64_t lowest, std::int64_t highest) const;
  int small_integer(int lowest, int highest) const;
  double number(double lowest, double highest) const;
  bool boolean() const;
  std::string text(std::size_t longest = 256) const;
  /// The index of a text among `choices`.
  std::size_t one_of(std::span<const std::string> choices) const;
  std::size_t one_of(std::initializer_list<std::string> choices) const {
    return one_of({choices.begin(), choices.size()});
  }

  bool is_object() const;
  bool is_array() const;
  bool is_text() const;
  bool is_boolean() const;
  bool is_integer() const;
  bool is_null() const;

  /// The value as JSON, shortened, for messages; never longer than about 50 characters.
  std::string shown() const;
  [[noreturn]] void fail(const std::string& what) const;

private:
  struct Document;
  JsonCursor(std::shared_ptr<const Document> owner, const void* place, std::string path_to_it)
      : document(std::move(owner)), node(place), path(std::move(path_to_it)) {}

  std::shared_ptr<const Document> document;
  const void* node; // a nlohmann::json, which stays out of the headers
  std::string path;
};

} // namespace tilepack
