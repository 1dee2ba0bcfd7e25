#pragma once

#include "tilepack/bake/bake_options.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace tilepack {

/// The shapes of values, as a preset writes them in JSON and a command line as text.
enum class BakeFieldType {
  integer, ///< 5
  extent,  ///< 5 or "5x7"; a few fields know words besides
  choice,  ///< one of a list of words
  flag,    ///< true or false
};

/// How a text becomes a value of the options, and the value a text.
struct FieldValue {
  BakeFieldType type = BakeFieldType::integer;
  std::string value; ///< what help shows in place of a value: "N|WxH|auto"

  /// Sets the field from text, or throws Error(usage, "", "'TEXT' is not allowed; it must be …").
  std::function<void(BakeOptions& options, const std::string& text)> set;

  /// The text that `set` turns back into the present value. Empty: unset, and left out of generator.options.
  std::function<std::string(const BakeOptions& options)> get;
};

/// Throws the error of `set`.
[[noreturn]] void refuse_value(const std::string& text, const std::string& allowed);

/// Whether `text` is a whole number from `lowest` to `highest` in digits alone: no sign, no blank, no
/// fraction. Then `value` is it; else its content is undefined.
bool parse_whole(std::string_view text, std::int64_t lowest, std::int64_t highest, std::int64_t& value);

/// The number, or refuse_value.
std::int64_t parsed_whole(const std::string& text, std::int64_t lowest, std::int64_t highest);

struct Extent {
  std::int64_t width = 0;
  std::int64_t height = 0;
};

/// "5" or "5x7", or refuse_value: "it must be N or `form` with `lowest` to `highest``note`".
Extent parsed_extent(const std::string& text, std::int64_t lowest, std::int64_t highest,
                     const std::string& note = "", const char* form = "WxH");

/// "5" where both are equal, else "5x7".
std::string extent_text(std::int64_t width, std::int64_t height);

/// "true" or "false", or refuse_value.
bool parsed_flag(const std::string& text);

} // namespace tilepack
